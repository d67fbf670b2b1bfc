#include "calibrate/report/heap_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "calibrate/report/wording.h"

namespace repose::calibrate::report {
namespace {

constexpr std::size_t kMaxGrains = 2500;

/// A triangulated sphere of radius 1: an octahedron whose faces are subdivided `divisions` times.
dem::Mesh unit_sphere(int divisions) {
  dem::Mesh sphere{
      .vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      .triangles = {
          {0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
  for (int k = 0; k < divisions; ++k) {
    std::map<std::array<int, 2>, int> middles;
    const auto middle = [&](int a, int b) {
      const std::array<int, 2> edge = {std::min(a, b), std::max(a, b)};
      const auto [place, is_new] =
          middles.try_emplace(edge, static_cast<int>(sphere.vertices.size()));
      if (is_new) {
        const dem::Vector sum = sphere.vertices[static_cast<std::size_t>(a)] +
                                sphere.vertices[static_cast<std::size_t>(b)];
        sphere.vertices.push_back(sum.normalized());
      }
      return place->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : sphere.triangles) {
      const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    sphere.triangles = std::move(finer);
  }
  return sphere;
}

/// Extent of the shape from its centre in a direction, m: the farthest surface vertex that lies
/// nearly in that direction, otherwise the extent of its spheres.
double radius_along(const dem::ClumpShape& shape, const dem::Vector& direction) {
  constexpr double kNearly = 0.97;
  double radius = 0;
  for (const dem::Vector& corner : shape.surface.vertices) {
    const double along = corner.dot(direction);
    if (along > kNearly * corner.norm()) radius = std::max(radius, along);
  }
  if (radius > 0) return radius;
  for (const dem::ClumpSphere& sphere : shape.spheres) {
    const double along = sphere.centre.dot(direction);
    const double across2 = sphere.centre.squaredNorm() - along * along;
    const double reach2 = sphere.radius * sphere.radius - across2;
    if (reach2 > 0) radius = std::max(radius, along + std::sqrt(reach2));
  }
  return radius;
}

double mm(double length_m) { return 1e3 * length_m; }

void add_shape(DataTable& data, const dem::ClumpShape& shape, int number, const dem::Mesh& sphere) {
  const Cell kind = static_cast<double>(number);
  for (const dem::Vector& direction : sphere.vertices) {
    const dem::Vector corner = radius_along(shape, direction) * direction;
    data.add({std::string("corner"), kind, mm(corner.x()), mm(corner.y()), mm(corner.z())});
  }
  for (const auto& [a, b, c] : sphere.triangles) {
    data.add({std::string("triangle"), kind, static_cast<double>(a), static_cast<double>(b),
              static_cast<double>(c)});
  }
}

/// As many grains as a page can hold: first the highest at every place on the ground, then those
/// below.
std::vector<render::PlacedGrain> seen_first(const render::Scene& scene, double cell_m) {
  std::vector<render::PlacedGrain> grains = scene.grains;
  if (grains.size() <= kMaxGrains) return grains;
  std::stable_sort(grains.begin(), grains.end(), [](const auto& a, const auto& b) {
    return a.pose.position.z() > b.pose.position.z();
  });
  std::map<std::pair<long, long>, int> above;
  std::vector<std::pair<int, std::size_t>> ranked;
  for (std::size_t k = 0; k < grains.size(); ++k) {
    const dem::Vector& place = grains[k].pose.position;
    const auto column = std::pair(std::lround(place.x() / cell_m), std::lround(place.y() / cell_m));
    ranked.emplace_back(above[column]++, k);
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<render::PlacedGrain> seen;
  for (std::size_t k = 0; k < kMaxGrains; ++k) seen.push_back(grains[ranked[k].second]);
  return seen;
}

}  // namespace

Chart heap_model(const render::Scene& scene) {
  constexpr std::size_t kFineHeap = 1000;
  Chart chart{.name = "heap",
              .kind = ChartKind::heap,
              .title = "The simulated heap, drawn by the program",
              .caption = {},
              .x_title = "x [mm]",
              .y_title = "y [mm]",
              .z_title = "height [mm]"};
  chart.data.columns = {
      {.name = "series", .unit = {}}, {.name = "kind", .unit = {}}, {.name = "x", .unit = "mm"},
      {.name = "y", .unit = "mm"},    {.name = "z", .unit = "mm"},  {.name = "qw", .unit = {}},
      {.name = "qx", .unit = {}},     {.name = "qy", .unit = {}},   {.name = "qz", .unit = {}}};
  const dem::Mesh sphere = unit_sphere(scene.grains.size() <= kFineHeap ? 2 : 1);
  double largest_m = 0;
  for (std::size_t k = 0; k < scene.shapes.size(); ++k) {
    add_shape(chart.data, scene.shapes[k], static_cast<int>(k), sphere);
    largest_m = std::max(largest_m, scene.shapes[k].reach_m());
  }
  const std::vector<render::PlacedGrain> grains = seen_first(scene, largest_m);
  for (const render::PlacedGrain& grain : grains) {
    const dem::Vector& place = grain.pose.position;
    const dem::Quaternion& turn = grain.pose.orientation;
    chart.data.add({std::string("grain"), static_cast<double>(grain.shape), mm(place.x()),
                    mm(place.y()), mm(place.z()), turn.w(), turn.x(), turn.y(), turn.z()});
  }
  chart.caption = fmt::format("{} grains; drag to rotate. Each is drawn with few triangles.",
                              scene.grains.size());
  if (grains.size() < scene.grains.size()) {
    chart.caption += fmt::format(" The {} that lie topmost are shown.", grains.size());
  }
  return chart;
}

}  // namespace repose::calibrate::report
