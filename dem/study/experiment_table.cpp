#include "dem/study/experiment_table.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "dem/engine/time_step.h"
#include "dem/experiment/model_setup.h"
#include "dem/study/entries.h"

namespace repose::dem {
namespace {

double spheres_of(const Model& model) { return static_cast<double>(model.grain.spheres.size()); }

}  // namespace

std::span<const ExperimentEntry> all_experiments() {
  static const std::array<ExperimentEntry, std::variant_size_v<Protocol>> kEntries = {
      drop_entry(),           tilt_entry(),           roll_entry(),           heap_entry(),
      drop_on_grains_entry(), tilt_on_grains_entry(), roll_on_grains_entry(), fill_entry(),
      pendulum_entry(),       draw_down_entry()};
  return kEntries;
}

const ExperimentEntry& entry_of(Experiment experiment) {
  return all_experiments()[static_cast<std::size_t>(experiment)];
}

const ExperimentEntry& entry_of(const Protocol& protocol) {
  return all_experiments()[protocol.index()];
}

const ExperimentEntry* find_experiment(std::string_view name) {
  const auto entries = all_experiments();
  const auto found = std::find_if(entries.begin(), entries.end(),
                                  [name](const auto& entry) { return entry.name == name; });
  return found == entries.end() ? nullptr : &*found;
}

const ExperimentEntry& experiment_named(std::string_view name) {
  const ExperimentEntry* found = find_experiment(name);
  if (found != nullptr) return *found;
  throw base::InputError({.where = fmt::format("experiment {}", name),
                          .value = "unknown experiment",
                          .fix = experiment_names() + '.'});
}

std::string experiment_names() {
  std::string names;
  const auto entries = all_experiments();
  for (const ExperimentEntry& entry : entries) {
    const bool is_last = &entry == &entries.back();
    if (!names.empty()) names += is_last ? " or " : ", ";
    names += entry.name;
  }
  return names;
}

std::string name_of(Experiment experiment) { return std::string(entry_of(experiment).name); }

base::InputError with_study_keys(const base::InputError& error, const Protocol& protocol) {
  const ExperimentEntry& entry = entry_of(protocol);
  Protocol asked = protocol, usual = entry.usual;
  const std::vector<ProtocolKey> keys = entry.keys(asked), usual_keys = entry.keys(usual);
  std::vector<base::Fault> faults = error.faults();
  for (std::size_t k = 0; k < keys.size(); ++k) {
    std::string name = keys[k].name;  // in SI units: tube_diameter_m
    if (const std::size_t mm = name.find("_mm"); mm != std::string::npos) name.erase(mm + 1, 1);
    const auto value = value_of(keys[k]);
    for (base::Fault& fault : faults) {
      if (!value || fault.subject != fmt::format("{}.{}", entry.name, name)) continue;
      fault.fix += fmt::format(" ([experiment.{}] {} = {:g}{})", entry.name, keys[k].name, *value,
                               value == value_of(usual_keys[k]) ? ", the default" : "");
    }
  }
  return base::InputError(std::move(faults));
}

Range readable_in(std::string_view unit) {
  return unit == "deg" ? from_to(0, 90) : from_to(0, std::numeric_limits<double>::infinity());
}

bool depends_on(const ExperimentEntry& entry, std::string_view coefficient) {
  // How restitution goes with the speed matters where restitution does.
  constexpr std::string_view kExponent = "_exponent";
  if (coefficient.ends_with(kExponent)) coefficient.remove_suffix(kExponent.size());
  const auto is_of = [coefficient](WallPart part) {
    return coefficient.starts_with("contact.particle_" + name_of(part) + '.');
  };
  if (std::ranges::any_of(entry.parts, is_of)) return true;
  return std::find(entry.coefficients.begin(), entry.coefficients.end(), coefficient) !=
         entry.coefficients.end();
}

bool has_grain_contacts(Experiment experiment) {
  const ExperimentEntry& entry = entry_of(experiment);
  return std::any_of(
      entry.coefficients.begin(), entry.coefficients.end(),
      [](std::string_view name) { return name.starts_with("contact.particle_particle."); });
}

double bulk_step_s(const Model& model) { return 1.5e-7 + 9e-9 * spheres_of(model); }

double step_on_wall_s(const Model& model, int bonded) {
  return 4e-7 + 5.5e-8 * spheres_of(model) * bonded;
}

double step_on_grains_s(const Model& model, int bonded) {
  return 4.5e-7 + 8e-8 * spheres_of(model) * bonded;
}

double rolling_timestep_s(const Model& model, double speed_m_s) {
  return model_setup(model, model.grain, {study_wall(Plane{})}, speed_m_s, kCourseFraction)
      .timestep_s;
}

double bulk_timestep_s(const Model& model, double speed_m_s) {
  return bulk_setup(model, {study_wall(Plane{})}, speed_m_s).timestep_s;
}

}  // namespace repose::dem
