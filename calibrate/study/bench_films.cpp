#include "calibrate/study/bench_films.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/distributions.h"
#include "calibrate/statistics/summary.h"
#include "calibrate/study/bench_setting.h"

namespace repose::calibrate {
namespace {

/// Why a film shows another experiment than the study's; empty: it does not.
std::string other_setting(const dem::ExperimentEntry& entry, const dem::Protocol& protocol,
                          const std::map<std::string, FilmNumber>& row) {
  std::vector<dem::FilmedSetting> settings = entry.filmed_settings;
  for (const auto& [column, key] : entry.sheet.protocol) {
    settings.push_back({column, key, kSameSetting});
  }
  for (const auto& [column, key, tolerance] : settings) {
    const FilmNumber& seen = row.at(std::string(column));
    const double meant = protocol_value(entry, protocol, key);
    if (std::abs(seen.value - meant) <= tolerance * meant + seen.uncertainty) continue;
    return fmt::format(
        "{0} = {1:.4g} ± {2:.2g} in it, and the study has {3} = {4:g} in [experiment.{5}]. Rule: "
        "the same within {6:g} % and the film's interval. Fix: write {3} = {1:.4g} there if the "
        "bench was set so. Of films that show it wrongly, as those in slow motion, give a sheet of "
        "readings instead: repose track {5} {7}--csv {5}.csv.",
        column, seen.value, seen.uncertainty, key, meant, entry.name, 100 * tolerance,
        entry.sheet.protocol.empty() ? "" : "--scale ... ");
  }
  return {};
}

void share_length_error(double error, dem::StudyExperiment& described) {
  constexpr double kWorthSaying = 1e-9;
  if (std::abs(error) < kWorthSaying) return;
  const dem::ExperimentEntry& entry = dem::entry_of(described.protocol);
  const double sd = std::abs(error * summarise(described.measured.values).mean);
  described.measured.systematic.push_back(
      {.name = "film",
       .sd = sd,
       .note = fmt::format(
           "its films show a length that the study states {:+.2g} % off: by as much all that is "
           "read off them may be off, ± {:.2g} {} (standard uncertainty), which more films do not "
           "lower. Fix: state what was set, or check the frame rate",
           100 * error, sd, entry.unit)});
}

}  // namespace

void read_row(const dem::ExperimentEntry& entry, const dem::Protocol& protocol,
              const std::map<std::string, FilmNumber>& row, FilmReading& film) {
  const std::string other = other_setting(entry, protocol, row);
  if (!other.empty()) {
    film.status = "refused";
    film.reason = other;
    return;
  }
  const FilmNumber& reading = row.at(std::string(entry.sheet.value));
  film.value = reading.value;
  film.uncertainty = reading.uncertainty;
  for (const auto& [column, key] : entry.sheet.protocol) {
    if (!column.ends_with("_mm")) continue;
    film.length_error =
        row.at(std::string(column)).value / protocol_value(entry, protocol, key) - 1;
  }
}

dem::Study with_films(dem::Study study, const std::vector<FilmReading>& films) {
  for (auto& [experiment, described] : study.experiments) {
    const std::string name = dem::name_of(experiment);
    dem::Measured& measured = described.measured;
    double squares = 0;
    double length_errors = 0;
    for (const FilmReading& film : films) {
      if (film.experiment != name || !film.value) continue;
      measured.values.push_back(*film.value);
      squares += film.uncertainty * film.uncertainty;
      length_errors += film.length_error;
    }
    if (measured.videos.empty() || measured.values.empty()) continue;
    const auto count = static_cast<double>(measured.values.size());
    measured.value_uncertainty = std::sqrt(squares / count) / base::kNormal95;
    share_length_error(length_errors / count, described);
  }
  return study;
}

}  // namespace repose::calibrate
