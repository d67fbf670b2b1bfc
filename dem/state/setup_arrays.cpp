#include "dem/state/setup_arrays.h"

#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"
#include "dem/contact/damping_name.h"
#include "dem/contact/rolling_name.h"

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

/// Per contact where it is not said: so did all programs that did not say it.
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

}  // namespace repose::dem
