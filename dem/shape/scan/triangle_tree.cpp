#include "dem/shape/scan/triangle_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "dem/shape/scan/mesh.h"

namespace repose::dem {
namespace {

constexpr std::size_t kLeafTriangles = 4;

}  // namespace

TrianglePoint nearest_on_triangle(const Vector& point, const Vector& a, const Vector& b,
                                  const Vector& c) {
  using Part = TrianglePoint::Part;
  const Vector ab = b - a, ac = c - a, ap = point - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0) return {a, Part::corner, 0};
  const Vector bp = point - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3) return {b, Part::corner, 1};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) {
    const double length = d1 - d3;
    return {length > 0 ? Vector(a + d1 / length * ab) : a, Part::edge, 0};
  }
  const Vector cp = point - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6) return {c, Part::corner, 2};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) {
    const double length = d2 - d6;
    return {length > 0 ? Vector(a + d2 / length * ac) : a, Part::edge, 2};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
    const double length = (d4 - d3) + (d5 - d6);
    return {length > 0 ? Vector(b + (d4 - d3) / length * (c - b)) : b, Part::edge, 1};
  }
  const double sum = va + vb + vc;
  return {a + vb / sum * ab + vc / sum * ac, Part::face, 0};
}

Bounds bounds_of(const Mesh& mesh, const std::array<int, 3>& triangle) {
  Bounds bounds(corner(mesh, triangle, 0));
  bounds.extend(corner(mesh, triangle, 1));
  bounds.extend(corner(mesh, triangle, 2));
  return bounds;
}

TriangleTree::TriangleTree(const Mesh& mesh) : mesh_(mesh), order_(mesh.triangles.size()) {
  std::vector<Bounds> bounds;
  bounds.reserve(mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) bounds.push_back(bounds_of(mesh, triangle));
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(mesh.triangles.size());
  if (!order_.empty()) build(0, order_.size(), bounds);
}

int TriangleTree::build(std::size_t first, std::size_t last, const std::vector<Bounds>& bounds) {
  const auto index = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  Bounds all, middles;
  for (std::size_t i = first; i < last; ++i) {
    const Bounds& one = bounds[static_cast<std::size_t>(order_[i])];
    all.extend(one);
    middles.extend(one.center());
  }
  nodes_.back().bounds = all;
  if (last - first <= kLeafTriangles) {
    nodes_.back().first = static_cast<int>(first);
    nodes_.back().count = static_cast<int>(last - first);
    return index;
  }
  Eigen::Index axis = 0;
  middles.sizes().maxCoeff(&axis);
  const std::size_t half = first + (last - first) / 2;
  const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(half), at(last), [&](int a, int b) {
    const double place_a = bounds[static_cast<std::size_t>(a)].center()[axis];
    const double place_b = bounds[static_cast<std::size_t>(b)].center()[axis];
    return std::pair(place_a, a) < std::pair(place_b, b);
  });
  build(first, half, bounds);
  const int right = build(half, last, bounds);
  nodes_[static_cast<std::size_t>(index)].first = right;
  return index;
}

TriangleTree::Nearest TriangleTree::nearest(const Vector& point) const {
  Nearest best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  std::vector<std::pair<int, double>> open;
  if (!nodes_.empty()) open.emplace_back(0, nodes_.front().bounds.squaredExteriorDistance(point));
  while (!open.empty()) {
    const auto [index, bound] = open.back();
    open.pop_back();
    if (bound >= best.squared_distance) continue;
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    for (int i = node.first; i < node.first + node.count; ++i) {
      const int t = order_[static_cast<std::size_t>(i)];
      const auto& triangle = mesh_.triangles[static_cast<std::size_t>(t)];
      const TrianglePoint where =
          nearest_on_triangle(point, corner(mesh_, triangle, 0), corner(mesh_, triangle, 1),
                              corner(mesh_, triangle, 2));
      const double squared = (where.point - point).squaredNorm();
      if (squared < best.squared_distance) best = {t, where, squared};
    }
    if (node.count > 0) continue;
    const auto distance_to = [&](int child) {
      return nodes_[static_cast<std::size_t>(child)].bounds.squaredExteriorDistance(point);
    };
    std::pair near(index + 1, distance_to(index + 1)), far(node.first, distance_to(node.first));
    if (far.second < near.second) std::swap(near, far);
    open.push_back(far);
    open.push_back(near);
  }
  return best;
}

void TriangleTree::append_touching(const Bounds& bounds, std::vector<int>& found) const {
  std::vector<int> open;
  if (!nodes_.empty()) open.push_back(0);
  while (!open.empty()) {
    const int index = open.back();
    open.pop_back();
    const Node& node = nodes_[static_cast<std::size_t>(index)];
    if (!node.bounds.intersects(bounds)) continue;
    if (node.count == 0) {
      open.push_back(node.first);
      open.push_back(index + 1);
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i) {
      const int t = order_[static_cast<std::size_t>(i)];
      const auto& triangle = mesh_.triangles[static_cast<std::size_t>(t)];
      if (bounds_of(mesh_, triangle).intersects(bounds)) found.push_back(t);
    }
  }
}

}  // namespace repose::dem
