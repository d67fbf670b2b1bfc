#include "render/silhouette/silhouette.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "render/scene/extent.h"
#include "render/scene/surface.h"

namespace repose::render {

namespace {

using dem::Vector;
using vision::Point;

/// Tolerance of the polyhedra drawn for spheres, pixels.
constexpr double kSphereTolerance_px = 0.01;

/// The smallest y (uppermost point) at the centre of each column.
class Columns {
 public:
  explicit Columns(int width)
      : top_(static_cast<std::size_t>(width), std::numeric_limits<double>::infinity()) {}

  void add_edge(Point from, Point to) {
    if (to.x < from.x) std::swap(from, to);
    const double last = static_cast<double>(top_.size()) - 1;
    const double first_column = std::max(0.0, std::ceil(from.x - .5));
    const double last_column = std::min(last, std::floor(to.x - .5));
    for (double column = first_column; column <= last_column; ++column) {
      const double part = to.x > from.x ? (column + .5 - from.x) / (to.x - from.x) : 0;
      double& top = top_[static_cast<std::size_t>(column)];
      top = std::min(top, from.y + part * (to.y - from.y));
    }
  }

  /// Whether something no higher than `y` changes nothing between the two x.
  bool hides(double y, double from_x, double to_x) const {
    const double end = static_cast<double>(top_.size());
    const auto first = static_cast<std::ptrdiff_t>(std::clamp(std::floor(from_x), 0.0, end));
    const auto last = static_cast<std::ptrdiff_t>(std::clamp(std::ceil(to_x), 0.0, end));
    return std::all_of(top_.begin() + first, top_.begin() + last,
                       [y](double top) { return top <= y; });
  }

  std::vector<Point> points() const {
    std::vector<Point> points;
    for (std::size_t k = 0; k < top_.size(); ++k) {
      if (std::isfinite(top_[k])) points.push_back({static_cast<double>(k) + .5, top_[k]});
    }
    return points;
  }

 private:
  std::vector<double> top_;
};

/// Whether a grain at that place lies below the edge so far, whatever its orientation.
bool is_hidden(const Columns& columns, const View& view, const Vector& place, double reach_m) {
  double top = std::numeric_limits<double>::infinity(), left = top, right = -top, bottom = -top;
  for (unsigned corner = 0; corner < 8; ++corner) {
    const Vector way((corner & 1U) != 0 ? 1 : -1, (corner & 2U) != 0 ? 1 : -1,
                     (corner & 4U) != 0 ? 1 : -1);
    const auto point = view.project(place + reach_m * view.axes.transpose() * way);
    if (!point) return false;
    left = std::min(left, point->x);
    right = std::max(right, point->x);
    top = std::min(top, point->y);
    bottom = std::max(bottom, point->y);
  }
  constexpr double kBend = .25;  // far more than lens distortion of a grain's box / its size
  const double slack_px = view.k1 != 0 || view.k2 != 0 ? kBend * (right - left + bottom - top) : 0;
  return columns.hides(top - slack_px, left - slack_px, right + slack_px);
}

/// Highest first, so that most of the others are found to be hidden.
std::vector<PlacedGrain> highest_first(std::vector<PlacedGrain> grains, const View& view) {
  const auto down = [&view](const PlacedGrain& grain) {
    return view.in_camera(grain.pose.position).y();
  };
  std::stable_sort(grains.begin(), grains.end(),
                   [&](const PlacedGrain& a, const PlacedGrain& b) { return down(a) < down(b); });
  return grains;
}

void add_mesh(Columns& columns, const View& view, const PlacedGrain& grain, const dem::Mesh& mesh) {
  std::vector<std::optional<Point>> places;
  places.reserve(mesh.vertices.size());
  for (const Vector& vertex : mesh.vertices) {
    places.push_back(view.project(grain.pose.position + grain.pose.orientation * vertex));
  }
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& from = places[static_cast<std::size_t>(triangle[k])];
      const auto& to = places[static_cast<std::size_t>(triangle[(k + 1) % 3])];
      // Every edge belongs to two triangles: adding it once suffices.
      if (triangle[k] < triangle[(k + 1) % 3] && from && to) columns.add_edge(*from, *to);
    }
  }
}

dem::Mesh mesh_of(const Surface& surface) {
  dem::Mesh mesh;
  for (std::size_t k = 0; k + Surface::kFloats <= surface.vertices.size(); k += Surface::kFloats) {
    mesh.vertices.emplace_back(surface.vertices[k], surface.vertices[k + 1],
                               surface.vertices[k + 2]);
  }
  for (std::size_t k = 0; k + 3 <= surface.corners.size(); k += 3) {
    mesh.triangles.push_back({static_cast<int>(surface.corners[k]),
                              static_cast<int>(surface.corners[k + 1]),
                              static_cast<int>(surface.corners[k + 2])});
  }
  return mesh;
}

}  // namespace

std::vector<Point> upper_edge(const Scene& scene, const View& view, Shown shown) {
  Columns columns(view.size.width);
  std::map<int, dem::Mesh> spheres;  // by shape
  const std::vector<double> reaches_m = reaches_of(scene);
  for (const PlacedGrain& grain : highest_first(scene.grains, view)) {
    const auto kind = static_cast<std::size_t>(grain.shape);
    if (is_hidden(columns, view, grain.pose.position, reaches_m[kind])) continue;
    const dem::ClumpShape& shape = scene.shapes[kind];
    const bool has_mesh = !shape.surface.triangles.empty();
    if (has_mesh && shown != Shown::spheres) add_mesh(columns, view, grain, shape.surface);
    if (has_mesh && shown == Shown::mesh) continue;
    const auto [found, is_new] = spheres.try_emplace(grain.shape);
    if (is_new) {
      const double depth = std::max(view.in_camera(grain.pose.position).z(), 1e-9);
      found->second = mesh_of(
          sphere_surface(shape.spheres, 1e-3 * kSphereTolerance_px * view.mm_per_px(depth)));
    }
    add_mesh(columns, view, grain, found->second);
  }
  return columns.points();
}

namespace {

constexpr std::uint8_t kGroundGrey = 128;

/// Everything below the ground line that shows no grain.
void paint_ground(vision::Picture& picture, const vision::Segment& ground) {
  const double slope = (ground.to.y - ground.from.y) / (ground.to.x - ground.from.x);
  for (int x = 0; x < picture.width; ++x) {
    const double line = ground.from.y + slope * (x + .5 - ground.from.x);
    const int first = static_cast<int>(std::clamp(std::ceil(line - .5), 0.0, 1.0 * picture.height));
    for (int y = first; y < picture.height; ++y) {
      const auto at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                           static_cast<std::size_t>(x));
      for (std::size_t k = at; k < at + 3; ++k) {
        if (picture.bgr[k] != 0) picture.bgr[k] = kGroundGrey;
      }
    }
  }
}

}  // namespace

vision::Picture silhouette_of(const Scene& scene, const View& view, const SilhouetteStyle& style,
                              const std::vector<std::uint8_t>& grain_mask) {
  vision::Picture picture{.width = view.size.width, .height = view.size.height, .bgr = {}};
  picture.bgr.resize(3 * grain_mask.size());
  std::uint8_t* to = picture.bgr.data();
  for (const std::uint8_t grain : grain_mask) {
    to = std::fill_n(to, 3, static_cast<std::uint8_t>(255 - grain));
  }
  if (style.shows_ground) {
    if (const auto ground = ground_in_picture(scene, view)) paint_ground(picture, *ground);
  }
  return picture;
}

}  // namespace repose::render
