#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dem/engine/bodies.h"

namespace repose::dem {

/// Where each body was when what is near it was last listed, and how far its spheres may come from
/// there until that is due again. A margin grows with the body's speed, so that a few fast ones do
/// not cost the many slow ones.
class Margins {
 public:
  const Row& position(int body) const { return position_[static_cast<std::size_t>(body)]; }
  double margin_m(int body) const { return margin_[static_cast<std::size_t>(body)]; }

  void resize(const Bodies& bodies);
  /// From where the body is now.
  void renew(const Bodies& bodies, std::size_t body, double timestep_s);

  /// Whether some body has used up its margin.
  bool is_used_up(const Bodies& bodies, int threads) const;
  /// Notes with a 1 whose margin is half used up, with a 0 whose is not.
  void note_half_used(const Bodies& bodies, std::vector<std::uint8_t>& is_half_used,
                      int threads) const;

 private:
  // Longer than there are bodies, as their own arrays.
  std::vector<Row> position_;
  std::array<std::vector<double>, 4> orientation_;
  std::vector<double> margin_;
};

/// Bodies by the cubic cell that holds their centre: finds which are near each other.
class CellGrid {
 public:
  /// Takes in all that are present, where their margins are.
  void sort(const Bodies& bodies, const Margins& margins);

  /// Adds those that may come near a body within their margins, in no order.
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
