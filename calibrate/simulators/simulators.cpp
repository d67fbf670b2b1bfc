#include "calibrate/simulators/simulators.h"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/input_error.h"
#include "base/text.h"
#include "calibrate/experiment/run_spec.h"
#include "calibrate/simulators/case_peers.h"
#include "calibrate/simulators/liggghts_scene.h"
#include "calibrate/study/study_simulator.h"

namespace repose::calibrate {
namespace {

struct SimulatorEntry {
  const char* name;
  std::shared_ptr<const Simulator> (*make)(const dem::EngineChoice& choice);
  std::unique_ptr<const dem::CasePeer> (*cases)();
};

const std::array kOthers{SimulatorEntry{kLiggghts, liggghts_simulator, liggghts_cases}};

/// A run with all free coefficients at one end of their bounds.
RunSpec spec_at_bounds(const dem::Study& study, const dem::ClumpShape& grain,
                       dem::Experiment experiment, double dem::Coefficient::*bound) {
  RunSpec spec{.protocol = study.experiments.at(experiment).protocol,
               .model = dem::model_for(study, experiment),
               .grain_fingerprint = {}};
  spec.model.grain = grain;
  for (const NamedCoefficient& named : coefficients_of(study)) {
    double* coefficient = find_coefficient(named.name, spec.model);
    if (coefficient == nullptr || !named.coefficient.is_free()) continue;
    *coefficient = named.coefficient.*bound;
  }
  return spec;
}

void find_unreadable(const dem::Study& study, const Simulator& simulator,
                     dem::Experiment experiment, base::Faults& faults) {
  for (const dem::MeasuredReading& also : study.experiments.at(experiment).measured.also) {
    faults.require(
        simulator.has_reading(*experiment, also.name),
        {.subject = fmt::format("experiment.{}.also_measured.{}", experiment->name, also.name),
         .value = fmt::format("is no reading of {}", simulator.title()),
         .fix = "take it out, or simulate with our own engine."});
  }
}

}  // namespace

std::vector<std::string> simulator_names() {
  std::vector<std::string> names = {dem::kOwnEngine};
  for (const SimulatorEntry& entry : kOthers) names.emplace_back(entry.name);
  return names;
}

std::shared_ptr<const Simulator> simulator_for(const dem::Study& study) {
  if (study.engine.is_own()) return own_simulator();
  const auto* entry = std::ranges::find(kOthers, study.engine.program, &SimulatorEntry::name);
  if (entry != kOthers.end()) return entry->make(study.engine);
  const std::string close = base::closest_word(study.engine.program, simulator_names());
  throw base::InputError(
      {.where = study.file.string(),
       .subject = "engine.program",
       .value = fmt::format("= \"{}\" is not known", study.engine.program),
       .rule = fmt::format("{}", fmt::join(simulator_names(), " or ")),
       .fix = fmt::format("program = \"{}\".", close.empty() ? dem::kOwnEngine : close)});
}

std::unique_ptr<const dem::CasePeer> case_peer_of(const std::string& program) {
  const auto* entry = std::ranges::find(kOthers, program, &SimulatorEntry::name);
  if (entry != kOthers.end()) return entry->cases();
  throw base::InputError({.where = "--engine " + program,
                          .value = "is no program that can run these cases beside repose",
                          .fix = fmt::format("--engine {}.", kOthers.front().name)});
}

std::vector<std::string> check_for_fit(const Simulator& simulator, const dem::Study& study,
                                       const dem::ClumpShape& grain) {
  base::Faults faults;
  std::set<std::string> told;
  for (const auto& [experiment, described] : study.experiments) {
    for (const auto bound : {&dem::Coefficient::min, &dem::Coefficient::max}) {
      for (const base::Fault& fault :
           simulator.refusals(spec_at_bounds(study, grain, experiment, bound))) {
        if (told.insert(fault.text()).second) faults.add(fault);
      }
    }
    find_unreadable(study, simulator, experiment, faults);
  }
  faults.throw_if_any();
  std::vector<std::string> differences;
  for (const auto& [experiment, described] : study.experiments) {
    const RunSpec spec = spec_at_bounds(study, grain, experiment, &dem::Coefficient::max);
    for (std::string& one : simulator.differences(spec)) {
      if (std::ranges::find(differences, one) == differences.end()) {
        differences.push_back(std::move(one));
      }
    }
  }
  return differences;
}

}  // namespace repose::calibrate
