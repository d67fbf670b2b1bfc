#include "render/gl/scene_uploader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "render/scene/counter_random.h"
#include "render/scene/extent.h"
#include "render/scene/surface.h"

namespace repose::render {
namespace {

using dem::Vector;

/// Maximum distance of removed vertices from the simplified triangles, pixels. The edge of a drawn
/// heap is then accurate to .25 px, .07 px on average (tests/render/detail_test.cpp).
constexpr double kTolerance_px = 0.4;
constexpr std::size_t kMaxKept = 64;
/// Longest edge of a wall's triangles if the lens distorts them, in units of Stage::radius_m.
constexpr double kWallPart = 0.02;
/// Half the side of the slab that stands for an infinite plane, in units of Stage::radius_m.
constexpr double kSlab = 3;

std::uint64_t hash_of(const dem::ClumpShape& shape) {
  std::uint64_t hash = 0;
  const auto add = [&hash](const void* data, std::size_t bytes) {
    const auto* at = static_cast<const unsigned char*>(data);
    for (; bytes > 0; bytes -= std::min(bytes, sizeof(std::uint64_t))) {
      std::uint64_t word = 0;
      std::memcpy(&word, at, std::min(bytes, sizeof word));
      hash = mixed(hash ^ word);
      at += std::min(bytes, sizeof word);
    }
  };
  for (const Vector& vertex : shape.surface.vertices) add(vertex.data(), 3 * sizeof(double));
  for (const auto& triangle : shape.surface.triangles) add(triangle.data(), 3 * sizeof(int));
  for (const dem::ClumpSphere& sphere : shape.spheres) {
    add(sphere.centre.data(), 3 * sizeof(double));
    add(&sphere.radius, sizeof(double));
  }
  return hash;
}

/// Rows of the matrix that places a body on the stage, and four random numbers.
void append_instance(std::vector<float>& instances, const dem::Pose& pose, const Vector& origin,
                     std::uint64_t chance) {
  const Eigen::Matrix3d turn = pose.orientation.toRotationMatrix();
  const Vector place = pose.position - origin;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      instances.push_back(static_cast<float>(turn(row, column)));
    }
    instances.push_back(static_cast<float>(place[row]));
  }
  for (std::uint64_t k = 0; k < 4; ++k) {
    instances.push_back(static_cast<float>(uniform(mixed(chance + k))));
  }
}

/// Along the longest extent, towards the end that is nearer to the centre of mass.
Vector blunt_end_of(const dem::ClumpShape& shape) {
  Vector low = Vector::Zero(), high = Vector::Zero();
  for (const dem::ClumpSphere& sphere : shape.spheres) {
    low = low.cwiseMin((sphere.centre.array() - sphere.radius).matrix());
    high = high.cwiseMax((sphere.centre.array() + sphere.radius).matrix());
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  return (-low[axis] < high[axis] ? low[axis] : high[axis]) * Vector::Unit(axis);
}

/// Metres per pixel at the grain nearest to the camera.
double finest_m_per_px(const Scene& scene, const View& view, double radius_m) {
  if (!view.is_perspective) return 1 / view.scale;
  double nearest = std::numeric_limits<double>::max();
  for (const PlacedGrain& grain : scene.grains) {
    const double depth = view.in_camera(grain.pose.position).z();
    if (depth > 0) nearest = std::min(nearest, depth);
  }
  return std::clamp(nearest, 1e-2 * radius_m, 1e3 * radius_m) / view.scale;
}

}  // namespace

SceneUploader::GrainShape SceneUploader::grain_shape(const dem::ClumpShape& shape, bool as_spheres,
                                                     double tolerance_m) {
  // The tolerance is quantised, so that pictures of nearly the same scale share a surface.
  constexpr double kStepsToDouble = 4;
  const int step = static_cast<int>(std::floor(kStepsToDouble * std::log2(tolerance_m)));
  const double stepped_m = std::exp2(step / kStepsToDouble);
  const Key key{hash_of(shape), as_spheres, step};
  const auto found = saved_.find(key);
  if (found != saved_.end()) return found->second;
  if (saved_.size() >= kMaxKept) saved_.clear();
  auto surface =
      std::make_shared<const Surface>(as_spheres ? sphere_surface(shape.spheres, stepped_m)
                                                 : grain_surface(shape.surface, stepped_m));
  GrainShape made{
      std::make_shared<const gl::Shape>(gl_, surface->vertices, surface->corners, kVertexParts),
      std::move(surface)};
  saved_.emplace(key, made);
  return made;
}

Stage SceneUploader::set(const Scene& scene, const View& view, Shown shown, std::uint64_t seed) {
  const Eigen::AlignedBox3d bounds = grain_bounds(scene, Eigen::Matrix3d::Identity());
  Stage stage{.origin = bounds.center(), .radius_m = .5 * bounds.diagonal().norm()};
  const double tolerance_m = kTolerance_px * finest_m_per_px(scene, view, stage.radius_m);
  for (std::size_t k = 0; k < scene.shapes.size(); ++k) {
    std::vector<float> instances;
    for (const PlacedGrain& grain : scene.grains) {
      if (grain.shape != static_cast<int>(k)) continue;
      const auto number = static_cast<std::uint64_t>(grain.number);
      append_instance(instances, grain.pose, stage.origin, mixed(seed) + 4 * number);
    }
    if (instances.empty()) continue;
    const dem::ClumpShape& shape = scene.shapes[k];
    const bool has_mesh = !shape.surface.triangles.empty();
    const auto add = [&](bool as_spheres) {
      GrainShape drawn = grain_shape(shape, as_spheres, tolerance_m);
      stage.grains.push_back(
          {.kind = as_spheres && has_mesh ? Batch::Kind::spheres : Batch::Kind::grains,
           .shape = std::move(drawn.shape),
           .surface = std::move(drawn.surface),
           .instances = instances,
           .blunt_end = blunt_end_of(shape)});
    };
    if (has_mesh && shown != Shown::spheres) add(false);
    if (!has_mesh || shown != Shown::mesh) add(true);
  }
  const bool is_bent = view.k1 != 0 || view.k2 != 0;
  const double slab_half_m = kSlab * stage.radius_m;
  for (const PlacedWall& wall : scene.walls) {
    if (is_pane(wall)) continue;
    const Vector middle = wall.pose.orientation.conjugate() * (stage.origin - wall.pose.position);
    const Surface surface =
        wall_surface(wall.shape, middle, slab_half_m, is_bent ? kWallPart * stage.radius_m : 1e9);
    Batch batch{.kind = Batch::Kind::wall,
                .shape = std::make_shared<const gl::Shape>(gl_, surface.vertices, surface.corners,
                                                           kVertexParts),
                .is_closed = !std::holds_alternative<dem::MeshSurface>(wall.shape)};
    append_instance(batch.instances, wall.pose, stage.origin, seed);
    stage.walls.push_back(std::move(batch));
  }
  return stage;
}

}  // namespace repose::render
