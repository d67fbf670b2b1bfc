#include "dem/wall/bed_facets.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/input_error.h"

namespace repose::dem {
namespace {

constexpr int kMostCells = 512;

void check(const SphereBed& bed) {
  if (bed.spheres.empty()) throw base::InputError({.value = "a bed of spheres has none"});
  for (std::size_t k = 0; k < bed.spheres.size(); ++k) {
    const FixedSphere& sphere = bed.spheres[k];
    if (sphere.radius > 0 && 4 * sphere.radius < bed.tile && sphere.centre.allFinite()) continue;
    throw base::InputError(
        {.value = fmt::format("a bed's sphere {} has a radius of {:g} m", k, sphere.radius),
         .rule = fmt::format("above 0, and less than a quarter of the tile, {:g} m", bed.tile),
         .fix = "a larger tile."});
  }
}

}  // namespace

BedFacets::BedFacets(const SphereBed& bed) : bed_(bed) {
  check(bed);
  top_ = -kEndless;
  for (const FixedSphere& sphere : bed_.spheres) {
    top_ = std::max(top_, sphere.centre.z() + sphere.radius);
    widest_ = std::max(widest_, sphere.radius);
  }
  cells_ = std::clamp(static_cast<int>(bed_.tile / (2 * widest_)), 1, kMostCells);
  spheres_in_.resize(static_cast<std::size_t>(cells_) * static_cast<std::size_t>(cells_));
  for (int k = 0; k < static_cast<int>(bed_.spheres.size()); ++k) {
    const Vector& centre = sphere(k).centre;
    spheres_in_[cell_at(cell_of(centre.x()), cell_of(centre.y()))].push_back(k);
  }
}

int BedFacets::cell_of(double coordinate) const {
  const double turns = coordinate / bed_.tile;
  const int cell = static_cast<int>((turns - std::floor(turns)) * cells_);
  return std::min(cell, cells_ - 1);
}

Vector BedFacets::from_centre(int facet, const Vector& point) const {
  Vector away = point - sphere(facet).centre;
  away.x() -= bed_.tile * std::round(away.x() / bed_.tile);
  away.y() -= bed_.tile * std::round(away.y() / bed_.tile);
  return away;
}

void BedFacets::near(const Vector& point, double distance, std::vector<int>& facets) const {
  facets.clear();
  if (point.z() - top_ > distance) return;
  const double far = distance + widest_;
  const int reach = std::min(static_cast<int>(std::ceil(far * cells_ / bed_.tile)), cells_ / 2);
  const int x = cell_of(point.x());
  const int y = cell_of(point.y());
  const int last = std::min(2 * reach + 1, cells_);
  for (int j = 0; j < last; ++j) {
    for (int i = 0; i < last; ++i) {
      const int row = (y - reach + j + cells_) % cells_;
      const int column = (x - reach + i + cells_) % cells_;
      for (const int k : spheres_in_[cell_at(column, row)]) {
        if (closest(k, point).distance < distance) facets.push_back(k);
      }
    }
  }
  std::sort(facets.begin(), facets.end());
}

Closest BedFacets::closest(int facet, const Vector& point) const {
  const Vector away = from_centre(facet, point);
  const double centre_x = point.x() - away.x();
  const double distance = away.norm();
  if (distance == 0 || centre_x < bed_.from_x || centre_x > bed_.to_x) {
    return {.distance = kEndless, .normal = Vector::UnitZ()};
  }
  return {.distance = distance - sphere(facet).radius, .normal = away / distance};
}

}  // namespace repose::dem
