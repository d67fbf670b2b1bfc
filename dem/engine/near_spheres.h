#pragma once

#include <vector>

#include "dem/engine/bodies.h"

namespace repose::dem {

/// Two spheres that may touch before the list is made anew. Numbers of `Bodies::spheres`.
struct NearSpheres {
  int a = 0;
  int b = 0;
};

/// All spheres of the bodies, where they were when this was made: an array for each field.
class SphereColumns {
 public:
  void gather(const Bodies& bodies);

  /// Adds the spheres of two bodies that are less than `margin` apart, in order: by a's, then b's.
  void add_near(const Bodies& bodies, int a, int b, double margin,
                std::vector<NearSpheres>& near) const;

 private:
  // Longer than there are spheres: the last ones too can be worked on four at a time.
  VectorArray centre_;
  std::vector<double> radius_;
};

}  // namespace repose::dem
