#include "calibrate/export/export.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/file_set.h"
#include "base/input_error.h"
#include "calibrate/export/conversions.h"
#include "calibrate/export/facts.h"
#include "calibrate/export/further_runs.h"
#include "calibrate/export/readme.h"
#include "calibrate/export/target_entry.h"
#include "calibrate/result/result.h"
#include "calibrate/result/result_text.h"
#include "dem/experiment/experiment_table.h"

namespace repose::calibrate {

std::vector<FittedValue> fitted_values(const StudyResult& result) {
  std::vector<FittedValue> values;
  if (const auto* joint = std::get_if<JointResult>(&result.found)) {
    for (const ResultParameter& parameter : joint->parameters) {
      values.push_back({.name = parameter.name,
                        .value = parameter.value,
                        .low = parameter.interval.low,
                        .high = parameter.interval.high,
                        .verdict = name_of(parameter.verdict)});
    }
    return values;
  }
  for (const auto& [name, value] : std::get<PublishedResult>(result.found).values) {
    values.push_back({.name = name, .value = value});
  }
  return values;
}

std::vector<std::vector<double>> exported_sets(const StudyResult& result) {
  std::vector<std::vector<double>> sets;
  if (const auto* joint = std::get_if<JointResult>(&result.found)) {
    for (EquivalentSet& set : good_sets(*joint)) sets.push_back(std::move(set.values));
    return sets;
  }
  sets.emplace_back();
  for (const auto& [name, value] : std::get<PublishedResult>(result.found).values) {
    sets.back().push_back(value);
  }
  return sets;
}

std::vector<BenchMean> bench_means_of(const StudyResult& result) {
  std::vector<BenchMean> readings;
  const auto* joint = std::get_if<JointResult>(&result.found);
  if (joint == nullptr) return readings;
  for (const ResultObservable& one : joint->observables) {
    if (dem::find_experiment(one.name) == nullptr) continue;
    readings.push_back({.experiment = one.name,
                        .unit = one.unit,
                        .mean = one.measured,
                        .uncertainty = one.measured_uncertainty});
  }
  return readings;
}

namespace {

/// Warnings for values that the measurements did not determine.
std::vector<std::string> warnings_of(const ExportFacts& facts) {
  std::vector<std::string> warnings;
  for (const FittedValue& value : facts.fitted()) {
    if (value.verdict == "determined") continue;
    if (value.verdict.empty()) {
      warnings.push_back(fmt::format("{} = {:.4g} is a point estimate without an interval.",
                                     value.name, value.value));
    } else {
      warnings.push_back(
          fmt::format("{} = {:.4g} is {}: the measurements allow {:.3g} to {:.3g}, each value only "
                      "with those of its own set. It is exported nevertheless.",
                      value.name, value.value, value.verdict, value.low, value.high));
    }
  }
  return warnings;
}

/// Replaces the values by those of the requested set.
std::vector<FittedValue> of_set(std::vector<FittedValue> fitted,
                                const std::vector<std::vector<double>>& sets, std::size_t number) {
  const std::size_t known = std::max<std::size_t>(1, sets.size());
  if (number < 1 || number > known) {
    throw base::InputError(
        {.where = fmt::format("--set-number {}", number),
         .value = known == 1 ? "this study has one set of coefficients"
                             : fmt::format("this study has {} equally good sets, from 1 to {}",
                                           known, known),
         .fix = "leave it out for set 1, the best one."});
  }
  if (sets.empty()) return fitted;
  for (std::size_t k = 0; k < fitted.size(); ++k) fitted[k].value = sets[number - 1].at(k);
  return fitted;
}

}  // namespace

std::array<ExportTarget, 4> export_targets() {
  return {liggghts_target(), yade_target(), lammps_target(), edem_target()};
}

std::string name_of(ExportTarget target) { return std::string(target->name); }

std::string summary_of(ExportTarget target) { return std::string(target->summary); }

ExportTarget export_target_named(std::string_view name) {
  for (const ExportTarget target : export_targets()) {
    if (target->name == name) return target;
  }
  return nullptr;
}

std::string name_of(Fidelity fidelity) {
  switch (fidelity) {
    case Fidelity::exact:
      return "exact";
    case Fidelity::close:
      return "close";
    case Fidelity::approximate:
      break;
  }
  return "approximate";
}

StudyExport export_study(const dem::Study& study, const dem::ClumpShape& grain,
                         const std::vector<FittedValue>& fitted, const ExportRequest& request,
                         const std::vector<std::vector<double>>& sets,
                         const std::vector<BenchMean>& bench) {
  const ExportFacts facts(study, grain, of_set(fitted, sets, request.set_number), request.target);
  StudyExport made{.conversions = conversions_of(facts, request.target)};
  base::Faults faults;
  faults.add_all(refusals(facts, request, made.conversions));
  faults.throw_if_any();
  made.files = request.target->files(facts, made.conversions);
  const FurtherRuns further = further_runs(facts, request.target, made.conversions, bench);
  if (!further.readings.empty()) made.files.push_back(further_runs_study(facts, further));
  made.files.push_back(readme_of(facts, request, made.conversions, sets, further));
  made.warnings = warnings_of(facts);
  return made;
}

void write_export(const std::filesystem::path& folder, const std::vector<ExportedFile>& files,
                  bool is_ours) {
  std::vector<base::NamedText> texts;
  for (const ExportedFile& file : files) texts.push_back({file.name, file.text});
  base::write_file_set(folder, texts, is_ours ? base::Unlisted::ours : base::Unlisted::users);
}

}  // namespace repose::calibrate
