#pragma once

#include <vector>

#include "dem/engine/bodies.h"
#include "dem/engine/margins.h"

namespace repose::dem {

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

}  // namespace repose::dem
