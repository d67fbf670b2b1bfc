#include "dem/experiment/model_setup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "dem/contact/model_names.h"
#include "dem/shape/clump/clump_shape.h"

namespace repose::dem {

Quaternion Random::orientation() {
  // Separate statements, as argument evaluation order is unspecified.
  const double fraction = uniform();
  const double first = 2 * std::numbers::pi * uniform();
  const double second = 2 * std::numbers::pi * uniform();
  const double a = std::sqrt(1 - fraction);
  const double b = std::sqrt(fraction);
  return Quaternion(b * std::cos(second), a * std::sin(first), a * std::cos(first),
                    b * std::sin(second))
      .normalized();
}

double reach_towards(const ClumpShape& shape, const Quaternion& orientation,
                     const Vector& direction) {
  const Vector own = orientation.conjugate() * direction;
  double reach = -std::numeric_limits<double>::infinity();
  for (const ClumpSphere& sphere : shape.spheres) {
    reach = std::max(reach, own.dot(sphere.centre) + sphere.radius);
  }
  return reach;
}

double lowest_m(const ClumpShape& shape, const Grain& grain) {
  return grain.position.z() - reach_towards(shape, grain.orientation, -Vector::UnitZ());
}

double highest_m(const ClumpShape& shape, const Grain& grain) {
  return grain.position.z() + reach_towards(shape, grain.orientation, Vector::UnitZ());
}

const ClumpShape& shape_of(const Simulation& simulation, const Grain& grain) {
  return simulation.setup().kinds[static_cast<std::size_t>(grain.kind)].shape;
}

double reach_m(const SimulationSetup& setup) {
  double reach = 0;
  for (const GrainKind& kind : setup.kinds) reach = std::max(reach, kind.shape.reach_m());
  return reach;
}

void Bulk::add(const Simulation& simulation, int grain) {
  const ClumpShape& mean = simulation.setup().kinds.front().shape;
  ++grains;
  relative_mass += shape_of(simulation, simulation.grain(grain)).volume_m3 / mean.volume_m3;
}

double highest_m(const Simulation& simulation, int grain) {
  const Grain now = simulation.grain(grain);
  return highest_m(shape_of(simulation, now), now);
}

Quaternion lying_pose(const ClumpShape& shape) {
  std::array<int, 3> axes = {0, 1, 2};
  std::stable_sort(axes.begin(), axes.end(),
                   [&](int a, int b) { return shape.gyration_m2[a] < shape.gyration_m2[b]; });
  const Vector along_y = Vector::Unit(axes[0]);
  const Vector along_z = Vector::Unit(axes[2]);
  Eigen::Matrix3d own_axes;  // rows: the axes that become x, y, z
  own_axes << along_y.cross(along_z).transpose(), along_y.transpose(), along_z.transpose();
  return Quaternion(own_axes).normalized();
}

double diameter_m(const ClumpShape& shape) {
  return std::cbrt(6 / std::numbers::pi * shape.volume_m3);
}

std::vector<ClumpSphere> placed_spheres(const Simulation& simulation) {
  std::vector<ClumpSphere> placed;
  for (int k = 0; k < simulation.grain_count(); ++k) {
    if (!simulation.is_present(k)) continue;
    const Grain grain = simulation.grain(k);
    for (const ClumpSphere& sphere : shape_of(simulation, grain).spheres) {
      placed.push_back(
          {.centre = grain.position + grain.orientation * sphere.centre, .radius = sphere.radius});
    }
  }
  return placed;
}

namespace {

Material softened(Material material, double factor) {
  material.young_modulus_pa *= factor;
  return material;
}

ContactTable contact_table(const Model& model) {
  std::vector<Material> materials = {softened(model.grain_material, model.stiffness_factor),
                                     softened(model.wall_material, model.stiffness_factor)};
  std::vector<PairCoefficients> with_grain = {model.grain_grain, model.grain_wall};
  for (const auto& [part, surface] : model.parts) {
    materials.push_back(softened(surface.material, model.stiffness_factor));
    with_grain.push_back(surface.with_grain);
  }
  std::vector<PairCoefficients> pairs = with_grain;
  for (std::size_t a = 1; a < with_grain.size(); ++a) {
    pairs.push_back(with_grain[a]);
    // Coefficients between walls are never used.
    pairs.insert(pairs.end(), with_grain.size() - 1, model.grain_wall);
  }
  return {std::move(materials), std::move(pairs), model.rolling, model.damping};
}

bool is_positive(double value) { return std::isfinite(value) && value > 0; }

SimulationSetup setup_of(const Model& model, std::vector<ClumpShape> shapes,
                         std::vector<Wall> walls, double speed_m_s, double fraction) {
  SimulationSetup setup{.kinds = {},
                        .walls = std::move(walls),
                        .contacts = contact_table(model),
                        .threads = model.threads};
  for (ClumpShape& shape : shapes) {
    setup.kinds.push_back({.shape = std::move(shape), .material = kGrainMaterial});
  }
  if (model.timestep_s) {
    check_timestep(*model.timestep_s, setup, speed_m_s, fraction);
    setup.timestep_s = *model.timestep_s;
  } else {
    setup.timestep_s = model.timestep_fraction * accurate_timestep_s(setup, speed_m_s, fraction);
  }
  return setup;
}

}  // namespace

void find_errors(const Model& model, base::Faults& errors) {
  bool has_radii = !model.grain.spheres.empty();
  for (const ClumpSphere& sphere : model.grain.spheres) {
    has_radii = has_radii && is_positive(sphere.radius) && sphere.centre.allFinite();
  }
  errors.require(has_radii && is_positive(model.grain.volume_m3) &&
                     model.grain.gyration_m2.allFinite() && model.grain.gyration_m2.minCoeff() > 0,
                 {.where = "grain",
                  .value = "it has no spheres, volume or inertia",
                  .fix = "make it from a scan or from its sizes."});
  errors.require(
      model.size_cv >= 0 && model.size_cv <= kMaxSizeSd,
      {.subject = "size_sd_fraction",
       .value = fmt::format("is {:g}", model.size_cv),
       .rule = fmt::format("0 to {:g}", kMaxSizeSd),
       .fix = "the standard deviation of the sizes by their mean; 0 for grains that are alike."});
  const bool has_stiffness = is_positive(model.stiffness_factor);
  errors.require(has_stiffness, {.subject = "stiffness_factor",
                                 .value = fmt::format("is {:g}", model.stiffness_factor),
                                 .rule = "above 0",
                                 .fix = "1 for the real material."});
  errors.require(model.timestep_fraction > 0 && model.timestep_fraction <= 1,
                 {.subject = "timestep_fraction",
                  .value = fmt::format("is {:g}", model.timestep_fraction),
                  .rule = "above 0, at most 1",
                  .fix = "1."});
  errors.require(!model.timestep_s || is_positive(*model.timestep_s),
                 {.subject = "timestep_s",
                  .value = fmt::format("is {:g}", model.timestep_s.value_or(0)),
                  .rule = "above 0",
                  .fix = "leave it to the program."});
  errors.require(model.threads >= 1, {.subject = "threads",
                                      .value = fmt::format("is {}", model.threads),
                                      .rule = "1 or more",
                                      .fix = "1."});
  if (!has_stiffness) return;
  try {
    contact_table(model);
  } catch (const base::InputError& error) {
    errors.add_all(error.faults());
  }
}

std::string damping_definition(const Model& model) {
  std::string text = damping_definition(model.damping);
  const auto add = [&text](const std::string& other, const PairCoefficients& pair) {
    if (pair.restitution_exponent == 0) return;
    text += fmt::format(
        "; particle_{0}.restitution is that of impacts at {1:g} m/s, at v it is multiplied by "
        "(v / {1:g} m/s)^-restitution_exponent, up to {2:g}",
        other, pair.restitution_speed_m_s, kMaxRestitutionBySpeed);
  };
  add("wall", model.grain_wall);
  for (const auto& [part, surface] : model.parts) add(name_of(part), surface.with_grain);
  add("particle", model.grain_grain);
  return text;
}

Wall study_wall(WallShape shape, const Pose& pose) {
  return {std::move(shape), kWallMaterial, pose, {}};
}

int material_of(const Model& model, WallPart part) {
  const auto found = model.parts.find(part);
  if (found == model.parts.end()) return kWallMaterial;
  return kWallMaterial + 1 + static_cast<int>(std::distance(model.parts.begin(), found));
}

Wall part_wall(const Model& model, WallPart part, WallShape shape, const Pose& pose) {
  return {std::move(shape), material_of(model, part), pose, {}};
}

SimulationSetup model_setup(const Model& model, const ClumpShape& shape, std::vector<Wall> walls,
                            double speed_m_s, double fraction) {
  return setup_of(model, {shape}, std::move(walls), speed_m_s, fraction);
}

SimulationSetup bulk_setup(const Model& model, std::vector<Wall> walls, double speed_m_s) {
  return setup_of(model, size_classes(model.grain, model.size_cv), std::move(walls), speed_m_s,
                  kBulkFraction);
}

double largest_reach_m(const Model& model) {
  double reach = 0;
  for (const ClumpShape& shape : size_classes(model.grain, model.size_cv)) {
    reach = std::max(reach, shape.reach_m());
  }
  return reach;
}

}  // namespace repose::dem
