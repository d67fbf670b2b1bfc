#include "dem/state/setup_arrays.h"

#include <limits>
#include <type_traits>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/input_error.h"
#include "dem/contact/model_names.h"

namespace repose::dem {

namespace {

constexpr const char* kDamping = "damping";
constexpr const char* kBySpeed = "pair_restitution_exponent_speed";

void add_contact_table(ArrayWriter& arrays, const ContactTable& table) {
  std::vector<std::string> names;
  std::vector<double> properties, pairs, by_speed;
  for (int a = 0; a < table.size(); ++a) {
    const Material& material = table.material(a);
    names.push_back(material.name);
    properties.insert(properties.end(),
                      {material.density_kg_m3, material.young_modulus_pa, material.poisson_ratio});
    for (int b = 0; b < table.size(); ++b) {
      const PairCoefficients& pair = table.pair(a, b);
      pairs.insert(pairs.end(), {pair.restitution, pair.sliding_friction, pair.rolling_friction});
      by_speed.insert(by_speed.end(), {pair.restitution_exponent, pair.restitution_speed_m_s});
    }
  }
  arrays.texts("material_name", std::move(names));
  arrays.numbers("material_density_young_poisson", 3, std::move(properties));
  arrays.numbers("pair_restitution_sliding_rolling", 3, std::move(pairs));
  if (table.is_by_speed()) arrays.numbers(kBySpeed, 2, std::move(by_speed));
  arrays.texts("rolling_model", {name_of(table.rolling())});
  if (table.damping() != DampingModel::per_contact) {
    arrays.texts(kDamping, {name_of(table.damping())});
  }
}

/// Per contact if absent: it is written only for other models.
DampingModel damping_in(const ArrayReader& arrays) {
  if (!arrays.has(kDamping)) return DampingModel::per_contact;
  const auto& models = arrays.texts(kDamping);
  const auto damping = damping_model_named(models.empty() ? "" : models.front());
  if (!damping) {
    throw base::InputError({.value = fmt::format("array {} names none that is known", kDamping)});
  }
  return *damping;
}

ContactTable contact_table_in(const ArrayReader& arrays) {
  std::vector<Material> materials;
  NumberStream properties = arrays.numbers("material_density_young_poisson", 3);
  for (const std::string& name : arrays.texts("material_name")) {
    Material material{.name = name};
    material.density_kg_m3 = properties.take();
    material.young_modulus_pa = properties.take();
    material.poisson_ratio = properties.take();
    materials.push_back(material);
  }
  check_end(properties.is_at_end(), properties.name());
  std::vector<PairCoefficients> pairs;
  NumberStream coefficients = arrays.numbers("pair_restitution_sliding_rolling", 3);
  while (!coefficients.is_at_end()) {
    PairCoefficients pair;
    pair.restitution = coefficients.take();
    pair.sliding_friction = coefficients.take();
    pair.rolling_friction = coefficients.take();
    pairs.push_back(pair);
  }
  if (arrays.has(kBySpeed)) {
    NumberStream by_speed = arrays.numbers(kBySpeed, 2);
    for (PairCoefficients& pair : pairs) {
      pair.restitution_exponent = by_speed.take();
      pair.restitution_speed_m_s = by_speed.take();
    }
    check_end(by_speed.is_at_end(), by_speed.name());
  }
  const auto& models = arrays.texts("rolling_model");
  const auto rolling = rolling_model_named(models.empty() ? "" : models.front());
  if (!rolling) throw base::InputError({.value = "array rolling_model names none that is known"});
  return {std::move(materials), std::move(pairs), *rolling, damping_in(arrays)};
}

}  // namespace

void add_meshes(ArrayWriter& arrays, const std::string& name,
                const std::vector<const Mesh*>& meshes) {
  std::vector<std::int64_t> sizes, triangles;
  std::vector<double> vertices;
  for (const Mesh* mesh : meshes) {
    sizes.push_back(std::ssize(mesh->vertices));
    sizes.push_back(std::ssize(mesh->triangles));
    for (const Vector& vertex : mesh->vertices) append(vertices, vertex);
    for (const auto& triangle : mesh->triangles) {
      triangles.insert(triangles.end(), triangle.begin(), triangle.end());
    }
  }
  arrays.integers(name + "_mesh_size", 2, std::move(sizes));
  arrays.numbers(name + "_mesh_vertex", 3, std::move(vertices));
  arrays.integers(name + "_mesh_triangle", 3, std::move(triangles));
}

std::vector<Mesh> meshes_in(const ArrayReader& arrays, const std::string& name) {
  IntegerStream sizes = arrays.integers(name + "_mesh_size", 2);
  NumberStream vertices = arrays.numbers(name + "_mesh_vertex", 3);
  IntegerStream triangles = arrays.integers(name + "_mesh_triangle", 3);
  std::vector<Mesh> meshes;
  while (!sizes.is_at_end()) {
    const int corners = take_index(sizes, vertices.left() / 3 + 1);
    const int faces = take_index(sizes, triangles.left() / 3 + 1);
    Mesh mesh;
    for (int k = 0; k < corners; ++k) mesh.vertices.push_back(take_vector(vertices));
    for (int k = 0; k < faces; ++k) {
      auto& triangle = mesh.triangles.emplace_back();
      for (int& corner : triangle) corner = take_index(triangles, mesh.vertices.size());
    }
    meshes.push_back(std::move(mesh));
  }
  check_end(vertices.is_at_end(), vertices.name());
  check_end(triangles.is_at_end(), triangles.name());
  return meshes;
}

void add_kinds(ArrayWriter& arrays, const std::vector<GrainKind>& kinds) {
  std::vector<std::int64_t> integers;
  std::vector<double> numbers, spheres;
  std::vector<const Mesh*> meshes;
  for (const GrainKind& kind : kinds) {
    integers.insert(integers.end(), {kind.material, std::ssize(kind.shape.spheres)});
    numbers.push_back(kind.shape.volume_m3);
    append(numbers, kind.shape.gyration_m2);
    for (const ClumpSphere& sphere : kind.shape.spheres) {
      append(spheres, sphere.centre);
      spheres.push_back(sphere.radius);
    }
    meshes.push_back(&kind.shape.surface);
  }
  arrays.integers("kind_material_spheres", 2, std::move(integers));
  arrays.numbers("kind_volume_gyration", 4, std::move(numbers));
  arrays.numbers("kind_sphere", 4, std::move(spheres));
  add_meshes(arrays, "kind", meshes);
}

std::vector<GrainKind> kinds_in(const ArrayReader& arrays) {
  IntegerStream integers = arrays.integers("kind_material_spheres", 2);
  NumberStream numbers = arrays.numbers("kind_volume_gyration", 4);
  NumberStream spheres = arrays.numbers("kind_sphere", 4);
  std::vector<Mesh> meshes = meshes_in(arrays, "kind");
  std::vector<GrainKind> kinds;
  for (Mesh& mesh : meshes) {
    GrainKind kind;
    kind.material = take_index(integers, std::numeric_limits<int>::max());
    const int count = take_index(integers, spheres.left() / 4 + 1);
    kind.shape.volume_m3 = numbers.take();
    kind.shape.gyration_m2 = take_vector(numbers);
    for (int k = 0; k < count; ++k) {
      const Vector centre = take_vector(spheres);
      kind.shape.spheres.push_back({.centre = centre, .radius = spheres.take()});
    }
    kind.shape.surface = std::move(mesh);
    kinds.push_back(std::move(kind));
  }
  check_end(integers.is_at_end(), integers.name());
  check_end(numbers.is_at_end(), numbers.name());
  check_end(spheres.is_at_end(), spheres.name());
  return kinds;
}

void add_setup(ArrayWriter& arrays, const SimulationSetup& setup) {
  add_kinds(arrays, setup.kinds);
  add_walls(arrays, setup.walls);
  add_contact_table(arrays, setup.contacts);
  std::vector<double> gravity;
  append(gravity, setup.gravity);
  arrays.numbers("gravity", 3, std::move(gravity));
  arrays.numbers("timestep", 1, {setup.timestep_s});
  arrays.numbers("floor", 1, {setup.floor_m});
  arrays.integers("audit_steps", 1, {setup.audit_steps});
}

SimulationSetup setup_in(const ArrayReader& arrays) {
  NumberStream gravity = arrays.numbers("gravity", 3);
  NumberStream timestep = arrays.numbers("timestep", 1);
  NumberStream floor = arrays.numbers("floor", 1);
  IntegerStream audit = arrays.integers("audit_steps", 1);
  SimulationSetup setup{.kinds = kinds_in(arrays),
                        .walls = walls_in(arrays),
                        .contacts = contact_table_in(arrays),
                        .gravity = take_vector(gravity),
                        .timestep_s = timestep.take(),
                        .floor_m = floor.take(),
                        .audit_steps = take_index(audit, std::numeric_limits<int>::max())};
  if (setup.audit_steps == 0)
    throw base::InputError({.value = "array audit_steps holds 0, must be more"});
  constexpr double kShortest_s = 1e-15, kLongest_s = 1;
  if (!(setup.timestep_s >= kShortest_s && setup.timestep_s <= kLongest_s)) {
    throw base::InputError(
        {.value = fmt::format("array timestep holds {:g}, must be from {:g} to {:g}",
                              setup.timestep_s, kShortest_s, kLongest_s)});
  }
  return setup;
}

namespace {

/// Three lengths describe every plain shape; meshes have their own arrays.
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

/// Beds have their own arrays, present only if there are beds.
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

/// `shape` is the index in WallShape; beds are handled separately.
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
