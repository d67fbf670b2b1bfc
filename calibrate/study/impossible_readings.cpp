#include "calibrate/study/impossible_readings.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "dem/experiment/experiment_table.h"

namespace repose::calibrate {
namespace {

/// Range of possible bench readings, in the experiment's unit.
dem::Range measurable_range(const dem::Study& study, const dem::ClumpShape& grain,
                            const dem::ExperimentEntry& entry) {
  dem::Model model = dem::model_for(study, &entry);
  model.grain = grain;
  dem::Range range = entry.possible(model, study.experiments.at(&entry).protocol);
  if (entry.least_of_possible > 0) range.from = entry.least_of_possible * range.to;
  return range;
}

/// 0 if none is stated; a stated common uncertainty larger than the readings is an error of unit.
double stated_bias(const std::vector<dem::Systematic>& parts) {
  const auto stated = std::ranges::find(parts, dem::kBiasKey, &dem::Systematic::name);
  return stated == parts.end() ? 0 : stated->sd;
}

base::Fault too_large_bias(const dem::Study& study, const std::string& where, double bias,
                           double most, std::string_view unit) {
  return {.where = study.file.string(),
          .subject = fmt::format("{}.{}", where, dem::kBiasKey),
          .value = fmt::format("= {:.4g} {}", bias, unit),
          .rule = fmt::format("a standard uncertainty that all readings share, no larger than they "
                              "are themselves: {:.4g} {} at most",
                              most, unit),
          .fix =
              "give it in the unit of the readings; of a ruler, a protractor or a board at most a "
              "few percent of them."};
}

/// Readings near 0 may be as uncertain as a hundredth of the measurable range.
void check_bias(const dem::Study& study, const dem::ExperimentEntry& entry,
                const dem::Measured& measured, const dem::Range& range,
                std::vector<base::Fault>& errors) {
  constexpr double kMinOfRange = .01;
  const std::string where = fmt::format("[experiment.{}]", entry.name);
  double largest = kMinOfRange * (range.to - range.from);
  for (const double value : measured.values) largest = std::max(largest, std::abs(value));
  if (measured.mean) largest = std::max(largest, std::abs(*measured.mean));
  const bool is_measured = measured.mean || !measured.values.empty();
  const double most = is_measured ? largest : range.to;
  if (const double bias = stated_bias(measured.systematic); bias > most) {
    errors.push_back(too_large_bias(study, where + " measured", bias, most, entry.unit));
  }
  for (const dem::MeasuredReading& reading : measured.also) {
    const double bias = stated_bias(reading.systematic);
    if (bias <= std::abs(reading.mean)) continue;
    errors.push_back(too_large_bias(study, where + " also_measured." + reading.name, bias,
                                    std::abs(reading.mean),
                                    dem::reading_named(entry, reading.name).unit));
  }
}

/// Additional readings that are above their possible range.
void find_impossible_readings(const dem::Study& study, const dem::ClumpShape& grain,
                              const dem::ExperimentEntry& entry,
                              const dem::StudyExperiment& described,
                              std::vector<base::Fault>& errors) {
  dem::Model model = dem::model_for(study, &entry);
  model.grain = grain;
  for (const dem::MeasuredReading& reading : described.measured.also) {
    const dem::Reading& known = dem::reading_named(entry, reading.name);
    const auto limit =
        known.limit == nullptr ? std::nullopt : known.limit(model, described.protocol);
    if (!limit || reading.mean <= limit->most) continue;
    errors.push_back(
        {.where = study.file.string(),
         .value = fmt::format("[experiment.{}.also_measured] {} = {:.10g} {}", entry.name,
                              reading.name, reading.mean, known.unit),
         .rule = fmt::format("at most {:.4g} {}, {}", limit->most, known.unit, limit->reason),
         .fix = "correct the reading, or the study."});
  }
}

}  // namespace

std::vector<base::Fault> impossible_readings(const dem::Study& study,
                                             const dem::ClumpShape& grain) {
  std::vector<base::Fault> errors;
  for (const auto& [experiment, described] : study.experiments) {
    find_impossible_readings(study, grain, *experiment, described, errors);
    const dem::ExperimentEntry& entry = *experiment;
    const dem::Range range = measurable_range(study, grain, entry);
    std::vector<double> readings = described.measured.values;
    if (described.measured.mean) readings.push_back(*described.measured.mean);
    check_bias(study, entry, described.measured, range, errors);
    const auto impossible = std::find_if(readings.begin(), readings.end(),
                                         [&](double value) { return !range.contains(value); });
    if (impossible == readings.end()) continue;
    constexpr double kThousand = 1000;
    const std::string thousands =
        range.contains(kThousand * *impossible)
            ? fmt::format("{:.10g} if a point parts thousands or the unit is another one; ",
                          kThousand * *impossible)
            : "";
    errors.push_back(
        {.where = study.file.string(),
         .value = fmt::format("[experiment.{}] measured = {:.10g} {}", entry.name, *impossible,
                              entry.unit),
         .rule = fmt::format("its {} is from {:.4g} to {:.4g} {} with this grain and protocol",
                             entry.value_name, range.from, range.to, entry.unit),
         .fix = thousands + "correct the reading, or the study."});
  }
  return errors;
}

}  // namespace repose::calibrate
