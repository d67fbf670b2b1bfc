#include <limits>
#include <type_traits>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/input_error.h"
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

constexpr const char* kBeds = "wall_bed_tile_from_to_spheres";
constexpr const char* kBedSpheres = "wall_bed_sphere";
constexpr int kBedShape = 4;  ///< number of the shape

/// Arrays of their own too, in files of walls with beds alone.
void add_beds(ArrayWriter& arrays, const std::vector<Wall>& walls) {
  std::vector<double> beds, spheres;
  for (const Wall& wall : walls) {
    const auto* bed = std::get_if<SphereBed>(&wall.shape);
    if (bed == nullptr) continue;
    const auto count = static_cast<double>(bed->spheres.size());
    beds.insert(beds.end(), {bed->tile, bed->from_x, bed->to_x, count});
    for (const FixedSphere& sphere : bed->spheres) {
      append(spheres, sphere.centre);
      spheres.push_back(sphere.radius);
    }
  }
  if (beds.empty()) return;
  arrays.numbers(kBeds, 4, std::move(beds));
  arrays.numbers(kBedSpheres, 4, std::move(spheres));
}

/// A length above 0 and no longer than `most`.
double take_length(NumberStream& numbers, double most) {
  const double length = numbers.take();
  if (length > 0 && length <= most) return length;
  throw base::InputError(
      {.value = fmt::format("array {} holds a length of {:g} m, must be above 0 and at most {:g}",
                            numbers.name(), length, most)});
}

SphereBed take_bed(NumberStream& beds, NumberStream& spheres) {
  constexpr double kWidest = 1e6;
  SphereBed bed;
  bed.tile = take_length(beds, kWidest);
  bed.from_x = beds.take();
  bed.to_x = beds.take();
  const double count = beds.take();
  for (double k = 0; k < count; ++k) {
    const Vector centre = take_vector(spheres);
    bed.spheres.push_back({.centre = centre, .radius = take_length(spheres, bed.tile / 4)});
  }
  return bed;
}

std::vector<SphereBed> beds_in(const ArrayReader& arrays) {
  std::vector<SphereBed> read;
  if (!arrays.has(kBeds)) return read;
  NumberStream beds = arrays.numbers(kBeds, 4);
  NumberStream spheres = arrays.numbers(kBedSpheres, 4);
  while (!beds.is_at_end()) read.push_back(take_bed(beds, spheres));
  check_end(spheres.is_at_end(), spheres.name());
  return read;
}

/// `shape` counts as WallShape does; beds are set apart.
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
static_assert(std::is_same_v<WallShape, std::variant<Plane, Box, Tube, MeshSurface, SphereBed>>,
              "shape_of and kBedShape know these");

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
  add_beds(arrays, walls);
}

std::vector<Wall> walls_in(const ArrayReader& arrays) {
  IntegerStream integers = arrays.integers("wall_shape_material_motions_present", 4);
  NumberStream sizes = arrays.numbers("wall_size", 3);
  NumberStream poses = arrays.numbers("wall_pose", 7);
  NumberStream motions = arrays.numbers("wall_motion", kMotionNumbers);
  std::vector<Mesh> meshes = meshes_in(arrays, "wall");
  std::vector<SphereBed> beds = beds_in(arrays);
  auto next_bed = beds.begin();
  std::vector<Wall> walls;
  for (Mesh& mesh : meshes) {
    const int shape = take_index(integers, std::variant_size_v<WallShape>);
    Wall wall;
    wall.shape = shape_of(shape, take_vector(sizes), std::move(mesh));
    if (shape == kBedShape) {
      if (next_bed == beds.end())
        throw base::InputError({.value = "a wall's bed of spheres is missing"});
      wall.shape = *next_bed++;
    }
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
