#include <fmt/format.h>

#include "calibrate/export/conversions.h"
#include "calibrate/export/targets.h"
#include "calibrate/study/study_simulator.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/heap.h"

namespace repose::calibrate {
namespace {

/// G = E / 2(1 + nu).
double shear_modulus_pa(const dem::Material& material) {
  return material.young_modulus_pa / (2 * (1 + material.poisson_ratio));
}

/// What the rolling model's coefficient multiplies.
struct EdemRolling {
  const char* meaning = "";
  bool has_damping_ratio = false;
};

EdemRolling rolling_in_edem(dem::RollingModel model) {
  switch (model) {
    case dem::RollingModel::relative_constant_torque:
      return {"torque per normal force and R*, against the relative spin"};
    case dem::RollingModel::elastic_plastic:
      return {"torque at which the spring yields, per normal force and R*", true};
    case dem::RollingModel::none:
    case dem::RollingModel::constant_torque:
      break;
  }
  return {
      "torque per normal force and distance from the centre of mass to the contact, against "
      "the particle's own spin"};
}

/// Of the damper of `elastic_plastic`, as a fraction of the critical one: dem/engine/rolling.h.
constexpr double kRollingDampingRatio = .3;

void add_interaction(const std::string& pair, const std::string& other,
                     const Conversions& conversions, const EdemRolling& rolling,
                     DeckFields& fields) {
  DeckFields& interaction = fields.add_section("INTERACTION");
  interaction.set("OTHER", other);
  interaction.set("RESTITUTION", exported(conversions, pair + "restitution"));
  interaction.set("SLIDING", exported(conversions, pair + "sliding_friction"));
  interaction.set("ROLLING", exported(conversions, pair + "rolling_friction"));
  interaction.set("ROLLING_MEANING", rolling.meaning);
  if (rolling.has_damping_ratio) {
    interaction.add_section("DAMPED").set("DAMPING_RATIO", kRollingDampingRatio);
  }
}

ExportedFile values_text(const ExportFacts& facts, const Conversions& conversions) {
  const dem::Material& grain = facts.study().model.grain_material;
  const dem::Material& wall = facts.study().model.wall_material;
  DeckFields fields = common_fields(facts);
  set_body(facts.grain(), grain.density_kg_m3, fields);
  fields.set("VOLUME", facts.grain().volume_m3);
  fields.set("DENSITY", grain.density_kg_m3);
  fields.set("GRAIN_YOUNG", grain.young_modulus_pa);
  fields.set("GRAIN_SHEAR", shear_modulus_pa(grain));
  fields.set("GRAIN_POISSON", grain.poisson_ratio);
  fields.set("WALL_YOUNG", wall.young_modulus_pa);
  fields.set("WALL_SHEAR", shear_modulus_pa(wall));
  fields.set("WALL_POISSON", wall.poisson_ratio);
  const EdemRolling rolling = rolling_in_edem(facts.study().model.rolling);
  fields.set("ROLLING_MODEL_NAME", edem_rolling_name(facts.study().model.rolling));
  add_interaction("contact.particle_wall.", sanitized(wall.name), conversions, rolling, fields);
  if (facts.has_grain_contacts()) {
    add_interaction("contact.particle_particle.", "itself", conversions, rolling, fields);
  }
  for (const dem::WallPart part : facts.parts()) {
    const dem::Material& material = facts.surface(part).material;
    const std::string name = fmt::format("{} ({})", sanitized(material.name), name_of(part));
    DeckFields& own = fields.add_section("PART");
    own.set("PART_NAME", name);
    own.set("PART_YOUNG", material.young_modulus_pa);
    own.set("PART_SHEAR", shear_modulus_pa(material));
    own.set("PART_POISSON", material.poisson_ratio);
    add_interaction("contact.particle_" + name_of(part) + '.', name, conversions, rolling, fields);
  }
  if (facts.has(dem::experiment_of<dem::HeapProtocol>())) {
    fields.add_section("HEAP").set("STIFFNESS",
                                   facts.stiffness(dem::experiment_of<dem::HeapProtocol>()));
  }
  for (const dem::Experiment experiment : facts.experiments()) {
    DeckFields& step = fields.add_section("STEP");
    step.set("EXPERIMENT", name_of(experiment));
    step.set("TIMESTEP", fmt::format("{:.3g}", facts.timestep_s(experiment)));
  }
  return {.name = "values.txt", .text = filled("edem/values.txt", fields)};
}

/// "wall" for "contact.particle_wall.restitution"; what grains do to each other is with "grain".
std::string other_of(const std::string& coefficient) {
  constexpr std::string_view kBefore = "contact.particle_";
  const std::string other =
      coefficient.substr(kBefore.size(), coefficient.rfind('.') - kBefore.size());
  return other == "particle" ? "grain" : other;
}

std::string material_rows(const std::string& part, const dem::Material& material) {
  return fmt::format(
      "{0},Poisson's Ratio,{1},\n{0},Shear Modulus,{2},Pa\n{0},Solids Density,{3},"
      "kg/m3\n",
      part, material.poisson_ratio, number(shear_modulus_pa(material)), material.density_kg_m3);
}

ExportedFile values_table(const ExportFacts& facts, const Conversions& conversions) {
  const dem::Model& model = facts.study().model;
  const double mass = facts.mass_kg();
  std::string text = "part,value,number,unit\n" + material_rows("grain", model.grain_material) +
                     material_rows("wall", model.wall_material);
  for (const dem::WallPart part : facts.parts()) {
    text += material_rows(name_of(part), facts.surface(part).material);
  }
  const bool is_damped = rolling_in_edem(model.rolling).has_damping_ratio;
  for (const Conversion& conversion : conversions) {
    const std::string other = other_of(conversion.coefficient);
    text += fmt::format("grain with {},{},{},\n", other, conversion.target_name,
                        number(conversion.exported));
    if (is_damped && conversion.coefficient.ends_with("rolling_friction")) {
      text += fmt::format("grain with {},Rolling Viscous Damping Ratio,{},\n", other,
                          kRollingDampingRatio);
    }
  }
  text +=
      fmt::format("particle,Mass,{},kg\nparticle,Volume,{},m3\n", mass, facts.grain().volume_m3);
  const dem::Vector inertia = mass * facts.grain().gyration_m2;
  for (int axis = 0; axis < 3; ++axis) {
    text += fmt::format("particle,Moment of Inertia {},{},kg m2\n", "XYZ"[axis], inertia[axis]);
  }
  return {.name = "values.csv", .text = text};
}

ExportedFile clump_table(const dem::ClumpShape& grain) {
  std::string text = "x_m,y_m,z_m,radius_m\n";
  for (const dem::ClumpSphere& sphere : grain.spheres) {
    text += fmt::format("{},{},{},{}\n", sphere.centre.x(), sphere.centre.y(), sphere.centre.z(),
                        sphere.radius);
  }
  return {.name = "clump.csv", .text = text};
}

}  // namespace

const char* edem_rolling_name(dem::RollingModel model) {
  switch (model) {
    case dem::RollingModel::relative_constant_torque:
      return "RVD Rolling Friction";
    case dem::RollingModel::elastic_plastic:
      return "Type C Rolling Friction";
    case dem::RollingModel::none:
    case dem::RollingModel::constant_torque:
      break;
  }
  return "Standard Rolling Friction";
}

std::vector<ExportedFile> edem_files(const ExportFacts& facts, const Conversions& conversions) {
  return {values_text(facts, conversions), values_table(facts, conversions),
          clump_table(facts.grain())};
}

}  // namespace repose::calibrate
