#include <limits>
#include <type_traits>
#include <utility>
#include <variant>

#include "dem/state/setup_arrays.h"

namespace repose::dem {
namespace {

/// Three lengths stand for every plain shape; meshes have arrays of their own.
Vector size_of(const WallShape& shape) {
  if (const auto* box = std::get_if<Box>(&shape)) return box->half_size;
  if (const auto* tube = std::get_if<Tube>(&shape)) {
    return {tube->inner_radius, tube->thickness, tube->height};
  }
  return Vector::Zero();
}

const Mesh* mesh_of(const WallShape& shape) {
  static const Mesh kNone;
  const auto* surface = std::get_if<MeshSurface>(&shape);
  return surface == nullptr ? &kNone : &surface->mesh;
}

/// `shape` counts as WallShape does.
WallShape shape_of(int shape, const Vector& size, Mesh mesh) {
  switch (shape) {
    case 0:
      return Plane{};
    case 1:
      return Box{.half_size = size};
    case 2:
      return Tube{.inner_radius = size.x(), .thickness = size.y(), .height = size.z()};
    default:
      return MeshSurface{.mesh = std::move(mesh)};
  }
}
static_assert(std::is_same_v<WallShape, std::variant<Plane, Box, Tube, MeshSurface>>,
              "shape_of knows these");

void append_motion(std::vector<double>& values, const Motion& motion) {
  append(values, motion.velocity);
  append(values, motion.spin);
  append(values, motion.pivot);
  values.insert(values.end(), {motion.start_s, motion.stop_s});
}

Motion take_motion(NumberStream& numbers) {
  Motion motion;
  motion.velocity = take_vector(numbers);
  motion.spin = take_vector(numbers);
  motion.pivot = take_vector(numbers);
  motion.start_s = numbers.take();
  motion.stop_s = numbers.take();
  return motion;
}

constexpr int kMotionNumbers = 11;

}  // namespace

void add_walls(ArrayWriter& arrays, const std::vector<Wall>& walls) {
  std::vector<std::int64_t> integers;
  std::vector<double> sizes, poses, motions;
  std::vector<const Mesh*> meshes;
  for (const Wall& wall : walls) {
    integers.insert(integers.end(), {static_cast<std::int64_t>(wall.shape.index()), wall.material,
                                     std::ssize(wall.motions), wall.is_present ? 1 : 0});
    append(sizes, size_of(wall.shape));
    append(poses, wall.pose.position);
    append(poses, wall.pose.orientation);
    for (const Motion& motion : wall.motions) append_motion(motions, motion);
    meshes.push_back(mesh_of(wall.shape));
  }
  arrays.integers("wall_shape_material_motions_present", 4, std::move(integers));
  arrays.numbers("wall_size", 3, std::move(sizes));
  arrays.numbers("wall_pose", 7, std::move(poses));
  arrays.numbers("wall_motion", kMotionNumbers, std::move(motions));
  add_meshes(arrays, "wall", meshes);
}

std::vector<Wall> walls_in(const ArrayReader& arrays) {
  IntegerStream integers = arrays.integers("wall_shape_material_motions_present", 4);
  NumberStream sizes = arrays.numbers("wall_size", 3);
  NumberStream poses = arrays.numbers("wall_pose", 7);
  NumberStream motions = arrays.numbers("wall_motion", kMotionNumbers);
  std::vector<Mesh> meshes = meshes_in(arrays, "wall");
  std::vector<Wall> walls;
  for (Mesh& mesh : meshes) {
    const int shape = take_index(integers, std::variant_size_v<WallShape>);
    Wall wall;
    wall.shape = shape_of(shape, take_vector(sizes), std::move(mesh));
    wall.material = take_index(integers, std::numeric_limits<int>::max());
    const int count = take_index(integers, motions.left() / kMotionNumbers + 1);
    wall.is_present = take_index(integers, 2) == 1;
    wall.pose.position = take_vector(poses);
    wall.pose.orientation = take_quaternion(poses);
    for (int k = 0; k < count; ++k) wall.motions.push_back(take_motion(motions));
    walls.push_back(std::move(wall));
  }
  check_end(integers.is_at_end(), integers.name());
  check_end(sizes.is_at_end(), sizes.name());
  check_end(poses.is_at_end(), poses.name());
  check_end(motions.is_at_end(), motions.name());
  return walls;
}

}  // namespace repose::dem
