#include <fmt/format.h>

#include "calibrate/export/conversions.h"
#include "calibrate/export/target_entry.h"
#include "calibrate/study/study_simulator.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/heap.h"

namespace repose::calibrate {
namespace {

/// G = E / 2(1 + nu).
double shear_modulus_pa(const dem::Material& material) {
  return material.young_modulus_pa / (2 * (1 + material.poisson_ratio));
}

/// As many digits of a computed number as anybody wants to type.
std::string six_digits(double value) { return fmt::format("{:.6g}", value); }

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

/// Damping of `elastic_plastic`, as a fraction of critical: dem/engine/rolling.h.
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

/// Data for repeating the drops.
void add_drops(const dem::DropProtocol& protocol, DeckFields& fields) {
  DeckFields& drop = fields.add_section("DROP");
  drop.set("HEIGHT", protocol.height_m);
  drop.set("DROPPED", protocol.grains);
  if (protocol.low_height_m) drop.add_section("LOW").set("LOW_HEIGHT", *protocol.low_height_m);
}

/// Data for rebuilding a heap.
void add_heap(const ExportFacts& facts, DeckFields& fields) {
  const auto& protocol = facts.study().protocol<dem::HeapProtocol>();
  const double stiffness = facts.stiffness(dem::experiment_of<dem::HeapProtocol>());
  DeckFields& heap = fields.add_section("HEAP");
  heap.set("STIFFNESS", stiffness);
  heap.set("SOFT_GRAIN_SHEAR",
           six_digits(stiffness * shear_modulus_pa(facts.study().model.grain_material)));
  heap.set("SOFT_WALL_SHEAR",
           six_digits(stiffness * shear_modulus_pa(facts.study().model.wall_material)));
  heap.set("TUBE_DIAMETER", protocol.tube_diameter_m);
  heap.set("TUBE_HEIGHT", protocol.tube_height_m);
  heap.set("TUBE_THICKNESS", protocol.tube_thickness_m);
  heap.set("LIFT_SPEED", protocol.lift_speed_m_s);
  heap.set("PLATE", protocol.plate_m);
  heap.set("GRAINS", grains_in_heap(facts));
  heap.set("HOW_MANY", protocol.grains ? "by the study" : "about as many fill the tube");
}

ExportedFile values_text(const ExportFacts& facts, const Conversions& conversions) {
  const dem::Material& grain = facts.study().model.grain_material;
  const dem::Material& wall = facts.study().model.wall_material;
  DeckFields fields = common_fields(facts);
  fields.set("SPHERES", static_cast<int>(facts.grain().spheres.size()));
  fields.set("BODY_MASS", six_digits(facts.mass_kg()));
  fields.set("VOLUME", six_digits(facts.grain().volume_m3));
  const dem::Vector inertia = facts.mass_kg() * facts.grain().gyration_m2;
  fields.set("IXX", six_digits(inertia.x()));
  fields.set("IYY", six_digits(inertia.y()));
  fields.set("IZZ", six_digits(inertia.z()));
  fields.set("DENSITY", grain.density_kg_m3);
  fields.set("GRAIN_YOUNG", grain.young_modulus_pa);
  fields.set("GRAIN_SHEAR", six_digits(shear_modulus_pa(grain)));
  fields.set("GRAIN_POISSON", grain.poisson_ratio);
  fields.set("WALL_YOUNG", wall.young_modulus_pa);
  fields.set("WALL_SHEAR", six_digits(shear_modulus_pa(wall)));
  fields.set("WALL_POISSON", wall.poisson_ratio);
  fields.set("WALL_DENSITY", wall.density_kg_m3);
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
    own.set("PART_SHEAR", six_digits(shear_modulus_pa(material)));
    own.set("PART_POISSON", material.poisson_ratio);
    own.set("PART_DENSITY", material.density_kg_m3);
    add_interaction("contact.particle_" + name_of(part) + '.', name, conversions, rolling, fields);
  }
  if (facts.has(dem::experiment_of<dem::DropProtocol>())) {
    add_drops(facts.study().protocol<dem::DropProtocol>(), fields);
  }
  if (facts.has(dem::experiment_of<dem::HeapProtocol>())) add_heap(facts, fields);
  for (const dem::Experiment experiment : facts.experiments()) {
    DeckFields& step = fields.add_section("STEP");
    step.set("EXPERIMENT", name_of(experiment));
    step.set("TIMESTEP", fmt::format("{:.3g}", facts.timestep_s(experiment)));
  }
  return {.name = "values.txt", .text = filled("edem/values.txt", fields)};
}

std::string material_rows(const std::string& part, const dem::Material& material) {
  return fmt::format(
      "{0},Poisson's Ratio,{1},\n{0},Shear Modulus,{2},Pa\n{0},Solids Density,{3},"
      "kg/m3\n",
      part, material.poisson_ratio, six_digits(shear_modulus_pa(material)), material.density_kg_m3);
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
    const std::string pair = pair_text(conversion.coefficient);
    text += fmt::format("{},{},{},\n", pair, conversion.target_name, number(conversion.exported));
    if (is_damped && conversion.coefficient.ends_with("rolling_friction")) {
      text += fmt::format("{},Rolling Viscous Damping Ratio,{},\n", pair, kRollingDampingRatio);
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

/// For pasting: Altair, EDEM documentation, "Add Multi-Sphere Particles". Spheres are relative to
/// the centre of mass along the principal axes, as required there.
ExportedFile sphere_table(const dem::ClumpShape& grain) {
  std::string text = "Position X\tPosition Y\tPosition Z\tPhysical Radius\n";
  for (const dem::ClumpSphere& sphere : grain.spheres) {
    text += fmt::format("{}\t{}\t{}\t{}\n", sphere.centre.x(), sphere.centre.y(), sphere.centre.z(),
                        sphere.radius);
  }
  return {.name = "spheres.txt", .text = text};
}

std::vector<ExportedFile> edem_files(const ExportFacts& facts, const Conversions& conversions) {
  return {values_text(facts, conversions), values_table(facts, conversions),
          sphere_table(facts.grain())};
}

std::string edem_program(dem::RollingModel model) {
  return fmt::format("EDEM: Hertz-Mindlin (no slip), {}", edem_rolling_name(model));
}

RestitutionCounterpart edem_restitution(double ours) {
  return {
      .name = "Coefficient of Restitution",
      .value = ours,
      .fidelity = Fidelity::close,
      .law = "speed after per speed before a central impact",
      .limits =
          "EDEM's damper has the textbook factor. Where tensile damping is disabled, low values "
          "rebound too high (0.1 gives 0.25): calibrate the drop there."};
}

std::string edem_rolling_law(dem::RollingModel model) {
  if (model == dem::RollingModel::relative_constant_torque) {
    return "RVD rolling friction: mu_r F R* on both bodies, against their relative spin";
  }
  if (model == dem::RollingModel::elastic_plastic) {
    return "Type C rolling friction: spring, up to mu_r F R*, and damper, against the relative "
           "rotation";
  }
  return "standard rolling friction: mu_r F times each body's own distance from centre of mass to "
         "contact, against its own spin";
}

/// EDEM has all three laws, with the same levers: Standard, RVD and Type C rolling friction
/// (Altair, EDEM 2023 documentation, "Rolling Friction").
RollingConversion edem_rolling(dem::RollingModel model, Partner partner,
                               const dem::ClumpShape& /*grain*/) {
  RollingConversion converted;
  if (model == dem::RollingModel::constant_torque) return converted;
  if (model == dem::RollingModel::elastic_plastic) {
    converted.fidelity = Fidelity::close;
    converted.limits =
        "The same limit and the same damping ratio; the spring up to there has EDEM's own normal "
        "stiffness in it, which grows with the overlap otherwise than ours. ";
  } else if (partner == Partner::grain) {
    converted.fidelity = Fidelity::close;
    converted.limits =
        "Between two grains EDEM's manual prints the direction as that of half the sum of both "
        "spins, which is nought where two equal grains roll off each other. We take it for the "
        "relative spin, as in the model of Ai et al. (type A) that the manual says it is: simulate "
        "roll_on_grains there before you trust it. ";
  }
  return converted;
}

bool edem_has_deck(const dem::Protocol& /*protocol*/) { return true; }

}  // namespace

ExportTarget edem_target() {
  static constexpr TargetEntry kTarget{.name = "edem",
                                       .summary = "tables to type in",
                                       .has_tables = true,
                                       .takes_incline_material = true,
                                       .program = edem_program,
                                       .restitution = edem_restitution,
                                       .heap_file = "heap.csv",
                                       .heap_unit = "",
                                       .sliding_name = "Coefficient of Static Friction",
                                       .sliding_limits = "",
                                       .rolling_name = "Coefficient of Rolling Friction",
                                       .rolling_law = edem_rolling_law,
                                       .rolling = edem_rolling,
                                       .has_deck = edem_has_deck,
                                       .files = edem_files};
  return &kTarget;
}

}  // namespace repose::calibrate
