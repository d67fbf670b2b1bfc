#include "calibrate/export/further_runs.h"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/angle_definition.h"
#include "calibrate/export/conversions.h"
#include "calibrate/export/deck_template.h"
#include "calibrate/export/target_entry.h"
#include "calibrate/study/study_simulator.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/tilt.h"
#include "dem/study/study.h"

namespace repose::calibrate {
namespace {

/// Fitted coefficients that are used in some experiment of the target.
std::vector<const Conversion*> sought(const ExportFacts& facts,
                                      const std::vector<Conversion>& conversions,
                                      bool with_determined) {
  std::vector<const Conversion*> found;
  for (const FittedValue& value : facts.fitted()) {
    if (!with_determined && value.verdict == "determined") continue;
    const auto conversion = std::ranges::find(conversions, value.name, &Conversion::coefficient);
    if (conversion != conversions.end()) found.push_back(&*conversion);
  }
  return found;
}

bool acts_on(const Conversion& conversion, const BenchMean& reading) {
  const dem::Experiment experiment = dem::find_experiment(reading.experiment);
  return experiment != nullptr && dem::depends_on(*experiment, conversion.coefficient);
}

/// Within the study's bounds. Empty: the target's value is the same everywhere between them.
std::vector<VariedCoefficient> varied(const ExportFacts& facts, ExportTarget target,
                                      const Conversion& conversion) {
  for (const NamedCoefficient& named : coefficients_of(facts.study())) {
    if (named.name != conversion.coefficient || !named.coefficient.is_free()) continue;
    const auto [low, high] =
        exported_bounds(facts, target, conversion, {named.coefficient.min, named.coefficient.max});
    if (!std::isfinite(low) || !std::isfinite(high) || low == high) continue;
    return {
        {.name = fmt::format("{}: {}", pair_text(conversion.coefficient), conversion.target_name),
         .low = low,
         .high = high}};
  }
  return {};
}

}  // namespace

std::string FurtherRuns::parameters_text() const {
  const std::string count = coefficients.size() == 1
                                ? std::string("the coefficient")
                                : fmt::format("the {} coefficients", coefficients.size());
  return fmt::format("{} that the study {}", count,
                     are_all_varied ? "sought" : "did not determine");
}

FurtherRuns further_runs(const ExportFacts& facts, ExportTarget target,
                         const std::vector<Conversion>& conversions,
                         const std::vector<BenchMean>& bench) {
  FurtherRuns further{.target = target->program(facts.study().model.rolling)};
  std::vector<BenchMean> known;
  for (const BenchMean& reading : bench) {
    const dem::Experiment experiment = dem::find_experiment(reading.experiment);
    if (experiment == nullptr || !facts.has_deck(experiment) || reading.uncertainty <= 0) continue;
    if (!target->has_tables && experiment == dem::experiment_of<dem::TiltProtocol>()) {
      further.is_tilt_left_out = true;
      continue;
    }
    known.push_back(reading);
  }
  std::vector<const Conversion*> wanted = sought(facts, conversions, false);
  further.are_all_varied = wanted.empty();
  if (wanted.empty()) wanted = sought(facts, conversions, true);
  for (const Conversion* conversion : wanted) {
    const auto is_read = [&](const BenchMean& one) { return acts_on(*conversion, one); };
    if (!std::ranges::any_of(known, is_read)) continue;
    for (VariedCoefficient& one : varied(facts, target, *conversion)) {
      further.coefficients.push_back(std::move(one));
    }
  }
  if (further.coefficients.empty()) return further;
  for (BenchMean& reading : known) {
    const auto acts = [&](const Conversion* one) { return acts_on(*one, reading); };
    if (std::ranges::any_of(wanted, acts)) further.readings.push_back(std::move(reading));
  }
  return further;
}

ExportedFile further_runs_study(const ExportFacts& facts, const FurtherRuns& further) {
  DeckFields fields = common_fields(facts);
  fields.set("TARGET", further.target);
  for (const VariedCoefficient& one : further.coefficients) {
    DeckFields& parameter = fields.add_section("PARAMETER");
    parameter.set("NAME", one.name);
    parameter.set("LOW", fmt::format("{:.6g}", one.low));
    parameter.set("HIGH", fmt::format("{:.6g}", one.high));
  }
  for (const BenchMean& reading : further.readings) {
    DeckFields& one = fields.add_section("READING");
    one.set("NAME", reading.experiment);
    one.set("MEAN", fmt::format("{:.6g}", reading.mean));
    one.set("UNCERTAINTY", fmt::format("{:.3g}", reading.uncertainty));
    one.set("READING_UNIT", sanitized(reading.unit));
    if (reading.experiment == name_of(dem::experiment_of<dem::HeapProtocol>())) {
      one.add_section("PICTURED").set("DEFINITION", heap_definition(facts));
    }
  }
  return {.name = kFurtherRunsFile, .text = filled(kFurtherRunsFile, fields)};
}

std::string heap_definition(const ExportFacts& facts) {
  const auto heap = facts.study().experiments.find(dem::experiment_of<dem::HeapProtocol>());
  return std::string(base::definition_meant(
      heap == facts.study().experiments.end() ? "" : heap->second.definition));
}

}  // namespace repose::calibrate
