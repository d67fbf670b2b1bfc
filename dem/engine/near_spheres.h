#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dem/engine/bodies.h"

namespace repose::dem {

/// Where each body was when its neighbours were last listed, and how far its spheres may move from
/// there before they must be listed again. Margins grow with each body's speed, so that a few fast
/// bodies do not slow down the many slow ones.
class Margins {
 public:
  const Row& position(int body) const { return position_[static_cast<std::size_t>(body)]; }
  double margin_m(int body) const { return margin_[static_cast<std::size_t>(body)]; }

  void resize(const Bodies& bodies);
  /// Restarts the margin from the body's current position.
  void renew(const Bodies& bodies, std::size_t body, double timestep_s);

  /// Whether any body has used up its margin.
  bool is_used_up(const Bodies& bodies, int threads) const;
  /// Sets 1 for each body whose margin is half used up, else 0.
  void note_half_used(const Bodies& bodies, std::vector<std::uint8_t>& is_half_used,
                      int threads) const;

 private:
  // Padded beyond the last body, like the arrays of Bodies.
  std::vector<Row> position_;
  std::array<std::vector<double>, 4> orientation_;
  std::vector<double> margin_;
};

/// Bodies sorted into cubic cells by their centre: finds which are near each other.
class CellGrid {
 public:
  /// Sorts all bodies present by the positions of their margins.
  void sort(const Bodies& bodies, const Margins& margins);

  /// Adds the bodies that may touch `body` within their margins, unordered.
  void add_near(int body, std::vector<int>& near) const;

 private:
  void choose_cells(const Bodies& bodies);

  std::vector<Row> place_;  ///< w: radius of the bounding sphere with its margin
  Vector corner_ = Vector::Zero();
  double cell_size_ = 1;
  Eigen::Vector3i cells_ = Eigen::Vector3i::Ones();
  std::vector<int> cell_of_;
  std::vector<int> cell_start_;
  std::vector<int> cell_bodies_;
};

/// Two spheres that may touch before the list is rebuilt. Indices into `Bodies::spheres`.
struct NearSpheres {
  int a = 0;
  int b = 0;
};

/// All spheres of the bodies, relative to their body's centre, as when each body was taken in: one
/// array per field, in single precision, since a few extra neighbours do not matter.
class SphereColumns {
 public:
  void resize(std::size_t spheres);
  void take_in(const Bodies& bodies, std::size_t body);

  /// Adds the pairs of spheres of two bodies that may touch within their margins, ordered by a's
  /// sphere, then b's. Includes some that miss by less than rounding.
  void add_near(const Bodies& bodies, const Margins& margins, int a, int b,
                std::vector<NearSpheres>& near) const;

 private:
  // Padded beyond the last sphere, so that all can be processed sixteen at a time.
  std::array<std::vector<float>, 3> offset_;
  std::vector<float> radius_;
};

}  // namespace repose::dem
