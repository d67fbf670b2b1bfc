#include "dem/experiment/experiment_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "dem/engine/time_step.h"
#include "dem/experiment/entry.h"
#include "dem/experiment/model_setup.h"

namespace repose::dem {
namespace {

double spheres_of(const Model& model) { return static_cast<double>(model.grain.spheres.size()); }

}  // namespace

std::span<const ExperimentEntry> all_experiments() {
#define REPOSE_ENTRY(name) name##_entry(),
  static const ExperimentEntry kEntries[] = {REPOSE_EXPERIMENTS(REPOSE_ENTRY)};
#undef REPOSE_ENTRY
  return kEntries;
}

const ExperimentEntry& entry_of(const std::type_info& protocol) {
  for (const ExperimentEntry& entry : all_experiments()) {
    if (entry.usual.kind() == protocol) return entry;
  }
  throw std::logic_error(fmt::format("{} is no experiment's protocol", protocol.name()));
}

const ExperimentEntry& entry_of(const Protocol& protocol) { return entry_of(protocol.kind()); }

const ExperimentEntry& pictured_experiment() {
  return *std::ranges::find_if(all_experiments(), &ExperimentEntry::is_pictured);
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

std::string experiment_names(const NameList& list) {
  std::vector<std::string_view> meant;
  for (const ExperimentEntry& entry : all_experiments()) {
    if (list.is_meant == nullptr || list.is_meant(entry)) meant.push_back(entry.name);
  }
  std::string names;
  for (std::size_t k = 0; k < meant.size(); ++k) {
    if (k > 0) names += k + 1 == meant.size() ? list.last : ", ";
    names += fmt::format("{}{}{}", list.before, meant[k], list.after);
  }
  return names;
}

std::string name_of(Experiment experiment) { return std::string(experiment->name); }

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

const Reading& reading_named(const ExperimentEntry& entry, std::string_view name) {
  return *std::ranges::find(entry.readings, name, &Reading::name);
}

Range readable_in(std::string_view unit) {
  return unit == "deg" ? from_to(0, 90) : from_to(0, std::numeric_limits<double>::infinity());
}

bool depends_on(const ExperimentEntry& entry, std::string_view coefficient) {
  // The speed dependence of restitution matters wherever restitution does.
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
  return std::ranges::any_of(experiment->coefficients, [](std::string_view name) {
    return name.starts_with("contact.particle_particle.");
  });
}

double bulk_step_s(const Model& model) { return 1.5e-7 + 9e-9 * spheres_of(model); }

double many_grains_factor(double grains) {
  struct Measured {
    double grains, factor;
  };
  constexpr std::array<Measured, 4> kMeasured{{{500, 1}, {5000, 1.2}, {15'000, 2}, {50'000, 2.9}}};
  const auto above = std::ranges::find_if(
      kMeasured, [&](const Measured& measured) { return measured.grains >= grains; });
  if (above == kMeasured.begin()) return kMeasured.front().factor;
  if (above == kMeasured.end()) return kMeasured.back().factor;
  const Measured below = *std::prev(above);
  return std::lerp(below.factor, above->factor,
                   std::log(grains / below.grains) / std::log(above->grains / below.grains));
}

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
