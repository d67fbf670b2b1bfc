#include "dem/engine/cell_grid.h"

#include <algorithm>

namespace repose::dem {

void CellGrid::choose_cells(const Bodies& bodies) {
  Vector low = Vector::Constant(1e300);
  Vector high = Vector::Constant(-1e300);
  double widest = 0;
  std::size_t present = 0;
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!bodies.is_present(k)) continue;
    ++present;
    low = low.cwiseMin(place_[k].xyz);
    high = high.cwiseMax(place_[k].xyz);
    widest = std::max(widest, place_[k].w);
  }
  if (present == 0) low = high = Vector::Zero();
  corner_ = low;
  cell_size_ = std::max(2 * widest, 1e-12);
  // Stray grains far away must not make for more cells than grains.
  const Vector extent = high - low;
  const double max_cells = 8.0 * static_cast<double>(present) + 64;
  const auto cells_at = [&extent](double size) {
    return ((extent.array() / size).floor() + 1).matrix().eval();
  };
  while (cells_at(cell_size_).prod() > max_cells) cell_size_ *= 1.3;
  cells_ = cells_at(cell_size_).cast<int>();
  cell_bodies_.resize(present);
}

void CellGrid::sort(const Bodies& bodies, const Margins& margins) {
  place_.resize(bodies.size());
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const auto body = static_cast<int>(k);
    place_[k] = {.xyz = margins.position(body).xyz,
                 .w = bodies.bounding_radius[k] + margins.margin_m(body)};
  }
  choose_cells(bodies);
  cell_of_.assign(bodies.size(), -1);
  cell_start_.assign(static_cast<std::size_t>(cells_.prod()) + 1, 0);
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    if (!bodies.is_present(k)) continue;
    const Eigen::Vector3i at =
        ((place_[k].xyz - corner_) / cell_size_).array().floor().cast<int>().matrix();
    cell_of_[k] = (at.z() * cells_.y() + at.y()) * cells_.x() + at.x();
    ++cell_start_[static_cast<std::size_t>(cell_of_[k]) + 1];
  }
  for (std::size_t c = 1; c < cell_start_.size(); ++c) cell_start_[c] += cell_start_[c - 1];
  for (std::size_t k = bodies.size(); k-- > 0;) {
    if (cell_of_[k] < 0) continue;
    auto& end = cell_start_[static_cast<std::size_t>(cell_of_[k]) + 1];
    cell_bodies_[static_cast<std::size_t>(--end)] = static_cast<int>(k);
  }
  // Filled from the back, every entry now holds the start of its own cell, shifted by one.
  cell_start_.erase(cell_start_.begin());
  cell_start_.push_back(static_cast<int>(cell_bodies_.size()));
}

void CellGrid::add_near(int body, std::vector<int>& near) const {
  const auto k = static_cast<std::size_t>(body);
  const int cell = cell_of_[k];
  const int x = cell % cells_.x();
  const int y = cell / cells_.x() % cells_.y();
  const int z = cell / (cells_.x() * cells_.y());
  const int from_x = std::max(x - 1, 0);
  const int to_x = std::min(x + 1, cells_.x() - 1);
  for (int cz = std::max(z - 1, 0); cz <= std::min(z + 1, cells_.z() - 1); ++cz) {
    for (int cy = std::max(y - 1, 0); cy <= std::min(y + 1, cells_.y() - 1); ++cy) {
      const int row = (cz * cells_.y() + cy) * cells_.x();
      const auto first = static_cast<std::size_t>(row) + static_cast<std::size_t>(from_x);
      const auto last = static_cast<std::size_t>(row) + static_cast<std::size_t>(to_x);
      for (int at = cell_start_[first]; at < cell_start_[last + 1]; ++at) {
        const int other = cell_bodies_[static_cast<std::size_t>(at)];
        if (other == body) continue;
        const Row& place = place_[static_cast<std::size_t>(other)];
        const double reach = place_[k].w + place.w;
        if ((place.xyz - place_[k].xyz).squaredNorm() < reach * reach) near.push_back(other);
      }
    }
  }
}

}  // namespace repose::dem
