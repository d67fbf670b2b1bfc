#include <fmt/format.h>

#include "calibrate/export/conversions.h"
#include "calibrate/export/targets.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/placing.h"

namespace repose::calibrate {
namespace {

using dem::Experiment;

void set_pair(const std::string& prefix, const std::string& pair, const ExportFacts& facts,
              const Conversions& conversions, const dem::ContactLaw& law, DeckFields& fields) {
  const double radius = .5 * dem::diameter_m(facts.grain());
  // Their rolling spring pulls at a lever of 2 R, on walls and, as R* = R / 2, between grains at R.
  const double lever = prefix == "WALL" ? 2 * radius : radius;
  fields.set(prefix + "_YOUNG", law.reduced_young_pa);
  fields.set(prefix + "_SHEAR", law.reduced_shear_pa);
  fields.set(prefix + "_RESTITUTION", exported(conversions, pair + "restitution"));
  fields.set(prefix + "_SLIDING", exported(conversions, pair + "sliding_friction"));
  fields.set(prefix + "_ROLLING", exported(conversions, pair + "rolling_friction"));
  fields.set(prefix + "_STIFFNESS",
             rolling_stiffness(law, facts.mass_kg(), radius) / (lever * lever));
}

ExportedFile drop_file(const ExportFacts& facts, const Conversions& conversions) {
  const dem::ContactTable contacts = facts.contacts(Experiment::drop);
  const double height = facts.study().protocol<dem::DropProtocol>().height_m;
  const std::string walls = "contact.particle_wall.";
  // Without a heap grains never touch each other.
  const std::string grains =
      facts.has(dem::Experiment::heap) ? "contact.particle_particle." : walls;
  DeckFields fields = common_fields(facts);
  fields.set("HEIGHT_MM", 1e3 * height);
  fields.set("RADIUS", .5 * dem::diameter_m(facts.grain()));
  fields.set("SPEED", facts.drop_speed_m_s());
  fields.set("ROOM", height + 10 * facts.grain().reach_m());
  fields.set("TIMESTEP", facts.timestep_s(Experiment::drop));
  fields.set("LONGEST", facts.longest_drop_s());
  fields.set("DENSITY", facts.study().model.grain_material.density_kg_m3);
  set_pair("WALL", walls, facts, conversions, contacts.law(dem::kGrainMaterial, dem::kWallMaterial),
           fields);
  set_pair("GRAIN", grains, facts, conversions,
           contacts.law(dem::kGrainMaterial, dem::kGrainMaterial), fields);
  return {.name = "drop.cpp", .text = filled("mercurydpm/drop.driver", fields)};
}

/// Spheres, then mass and moments of inertia.
ExportedFile clump_table(const ExportFacts& facts) {
  std::string text = "x_m,y_m,z_m,radius_m\n";
  for (const dem::ClumpSphere& sphere : facts.grain().spheres) {
    text += fmt::format("{},{},{},{}\n", sphere.centre.x(), sphere.centre.y(), sphere.centre.z(),
                        sphere.radius);
  }
  const dem::Vector inertia = facts.mass_kg() * facts.grain().gyration_m2;
  text += fmt::format("# mass_kg {}, moments of inertia kg m2 {} {} {}\n", facts.mass_kg(),
                      inertia.x(), inertia.y(), inertia.z());
  return {.name = "clump.csv", .text = text};
}

}  // namespace

std::vector<ExportedFile> mercurydpm_files(const ExportFacts& facts,
                                           const Conversions& conversions) {
  std::vector<ExportedFile> files = {clump_table(facts)};
  if (facts.has(Experiment::drop)) files.push_back(drop_file(facts, conversions));
  return files;
}

}  // namespace repose::calibrate
