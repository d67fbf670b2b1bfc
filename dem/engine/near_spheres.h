#pragma once

#include <array>
#include <vector>

#include "dem/engine/bodies.h"
#include "dem/engine/margins.h"

namespace repose::dem {

/// Two spheres that may touch before the list is made anew. Numbers of `Bodies::spheres`.
struct NearSpheres {
  int a = 0;
  int b = 0;
};

/// All spheres of the bodies, from their body's centre, where they were when each was taken in: an
/// array for each field, in single precision, since a few more that are near do not matter.
class SphereColumns {
 public:
  void resize(std::size_t spheres);
  void take_in(const Bodies& bodies, std::size_t body);

  /// Adds the spheres of two bodies that may come to touch within their margins, in order: by a's,
  /// then b's. And some that miss that by less than the rounding.
  void add_near(const Bodies& bodies, const Margins& margins, int a, int b,
                std::vector<NearSpheres>& near) const;

 private:
  // Longer than there are spheres: the last ones too can be worked on sixteen at a time.
  std::array<std::vector<float>, 3> offset_;
  std::vector<float> radius_;
};

}  // namespace repose::dem
