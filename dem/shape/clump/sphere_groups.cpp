#include "dem/shape/clump/sphere_groups.h"

#include <cstddef>

namespace repose::dem {
namespace {

bool touch(const ClumpSphere& a, const ClumpSphere& b) {
  constexpr double kRounding = 1e-9;
  return (a.centre - b.centre).norm() <= (a.radius + b.radius) * (1 + kRounding);
}

}  // namespace

int sphere_groups(const std::vector<ClumpSphere>& spheres) {
  std::vector<bool> is_reached(spheres.size(), false);
  std::vector<std::size_t> open;
  int groups = 0;
  for (std::size_t start = 0; start < spheres.size(); ++start) {
    if (is_reached[start]) continue;
    ++groups;
    is_reached[start] = true;
    open.push_back(start);
    while (!open.empty()) {
      const std::size_t from = open.back();
      open.pop_back();
      for (std::size_t k = start + 1; k < spheres.size(); ++k) {
        if (is_reached[k] || !touch(spheres[from], spheres[k])) continue;
        is_reached[k] = true;
        open.push_back(k);
      }
    }
  }
  return groups;
}

}  // namespace repose::dem
