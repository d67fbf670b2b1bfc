#include "cli/calibrate/bench_films.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "calibrate/study/bench_films.h"
#include "calibrate/study/bench_setting.h"
#include "cli/common/copies.h"
#include "cli/common/picture_list.h"
#include "cli/track/track_batch.h"
#include "vision/measure/status_name.h"

namespace repose::cli {
namespace {

calibrate::FilmNumber number_of(const vision::Estimate& estimate) {
  return {.value = estimate.value, .uncertainty = estimate.uncertainty};
}

/// What a person should look at, warning by warning.
std::string warnings_text(const TrackedFilm& film) {
  std::string text;
  for (const vision::Warning& warning : warnings_of(film)) {
    text += (text.empty() ? "" : "; ") + warning.message;
  }
  return text;
}

/// As a bench would write it down.
std::map<std::string, calibrate::FilmNumber> row_of(const TrackedFilm& film) {
  if (film.filmed == Filmed::tilt) {
    return {{"angle_deg", number_of(film.tilt.angle_deg)},
            {"rate_deg_s", number_of(film.tilt.rate_deg_s)}};
  }
  if (film.filmed == Filmed::roll) {
    return {{"incline_deg", number_of(film.roll.incline_deg)},
            {"released_mm", number_of(film.roll.released_mm)},
            {"stopped_mm", number_of(film.roll.stopped_mm)}};
  }
  const vision::Bounce& first = film.drop.bounces.front();
  return {{"drop_mm", number_of(first.drop_mm)}, {"rebound_mm", number_of(first.rebound_mm)}};
}

calibrate::FilmReading reading_of(const TrackedFilm& film, const dem::ExperimentEntry& entry,
                                  const dem::Protocol& protocol) {
  const std::string named = film.file + ": ";
  const bool is_named = film.error.starts_with(named);
  calibrate::FilmReading reading{.experiment = std::string(entry.name),
                                 .file = std::filesystem::absolute(film.file),
                                 .status = "not read",
                                 .value = {},
                                 .reason = film.error.substr(is_named ? named.size() : 0)};
  if (!film.error.empty()) return reading;
  reading.status = name_of(status_of(film));
  if (status_of(film) != vision::MeasureStatus::ok) {
    reading.reason = has_reading(film) ? warnings_text(film) : reason_of(film);
  }
  // Its bounces are later ones, whose fall is not the bench's.
  if (film.filmed == Filmed::drop && !film.drop.has_first_bounce()) return reading;
  if (has_reading(film)) read_row(entry, protocol, row_of(film), reading);
  return reading;
}

/// What to know about a film that is not quite as it should be.
std::string note_on(const calibrate::FilmReading& film) {
  const std::string fault = fmt::format("{}: {}", film.file.string(), film.reason);
  if (!film.value) return fmt::format("{} (this film is left out)", fault);
  return fmt::format("{} (flagged, but counted; check it with repose track {} --overlay)", fault,
                     film.experiment);
}

void read_films_of(const dem::ExperimentEntry& entry, const dem::StudyExperiment& described,
                   CalibratePlan& plan) {
  std::vector<std::string> names;
  for (const std::filesystem::path& video : described.measured.videos) {
    names.push_back(video.string());
  }
  FileList list = list_films(names);
  const auto first_of = copies_among(list.files, std::vector<std::string>(list.files.size()));
  std::vector<std::filesystem::path> films;
  for (std::size_t i = 0; i < list.files.size(); ++i) {
    if (first_of[i]) {
      list.notes.push_back(text_of_copy(list.files[i], list.files[*first_of[i]]));
    } else {
      films.push_back(list.files[i]);
    }
  }
  plan.errors.insert(plan.errors.end(), list.errors.begin(), list.errors.end());
  plan.notes.insert(plan.notes.end(), list.notes.begin(), list.notes.end());
  TrackPlan tracking;
  if (entry.experiment == dem::Experiment::roll) {
    tracking.filmed = Filmed::roll;
    tracking.released_mm = calibrate::protocol_value(entry, described.protocol, "release_mm");
  }
  if (entry.experiment == dem::Experiment::tilt) tracking.filmed = Filmed::tilt;
  tracking.videos = std::move(films);
  tracking.threads = plan.jobs;
  // Nothing is written yet that an interrupt could leave half done: it ends the program at once.
  const std::atomic<bool> is_interrupted = false;
  bool any = false;
  std::vector<std::string> said;
  for (const TrackedFilm& film : track_batch(tracking, is_interrupted)) {
    if (film.is_internal_error) plan.errors.push_back("internal error: " + film.error);
    const calibrate::FilmReading& reading =
        plan.record.films.emplace_back(reading_of(film, entry, described.protocol));
    any = any || reading.value;
    if (reading.status != "ok") said.push_back(note_on(reading));
  }
  std::vector<std::string>& where = any ? plan.notes : plan.errors;
  where.insert(where.end(), said.begin(), said.end());
  if (any || said.empty()) return;
  plan.errors.push_back(
      fmt::format("{}: none of the {} films of [experiment.{}] gives a reading. Fix: check them "
                  "with repose track {} --overlay, or give readings as values.",
                  plan.record.study.file.string(), said.size(), entry.name, entry.name));
}

}  // namespace

void read_films(CalibratePlan& plan) {
  for (const auto& [experiment, described] : plan.record.study.experiments) {
    const dem::ExperimentEntry& entry = dem::entry_of(experiment);
    // Those of heaps are measured as pictures are.
    if (described.measured.videos.empty() || entry.is_pictured) continue;
    read_films_of(entry, described, plan);
  }
}

}  // namespace repose::cli
