#include "calibrate/bench/read_bench.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"
#include "base/memory.h"
#include "calibrate/bench/batch.h"
#include "calibrate/experiment/heap_angle.h"
#include "calibrate/experiment/picture_set.h"
#include "calibrate/experiment/scan_angle.h"
#include "dem/experiment/experiment_table.h"
#include "vision/files/file_list.h"
#include "vision/files/heap_file.h"
#include "vision/measure/repose_angle.h"
#include "vision/scan/scan_file.h"
#include "vision/track/film_track.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;

/// Collects errors and notes.
struct Findings {
  base::Faults faults;
  std::vector<std::string>& notes;
};

std::vector<fs::path> files_of(vision::FileList list, Findings& findings) {
  findings.faults.add_all(list.faults);
  findings.notes.insert(findings.notes.end(), list.notes.begin(), list.notes.end());
  return std::move(list.files);
}

std::vector<std::string> names_of(const std::vector<fs::path>& files) {
  std::vector<std::string> names;
  for (const fs::path& file : files) names.push_back(file.string());
  return names;
}

std::vector<SheetReadings> read_all_sheets(const dem::Study& study, NoRows no_rows,
                                           Findings& findings) {
  try {
    std::vector<SheetReadings> sheets = read_sheets(study, no_rows);
    for (const SheetReadings& sheet : sheets) {
      findings.notes.insert(findings.notes.end(), sheet.notes.begin(), sheet.notes.end());
    }
    return sheets;
  } catch (const base::InputError& error) {
    findings.faults.add_all(error.faults());
    return {};
  }
}

PictureReading reading_of(const fs::path& file, const vision::ReposeAngle& angle) {
  const SetPicture picture = set_picture_of(angle);
  return {.file = fs::absolute(file),
          .status = name_of(angle.status),
          .angle_deg = picture.angle_deg,
          .reason = angle.reason,
          .own_deg = picture.own_deg,
          .camera_deg = picture.camera_deg};
}

/// A measured picture, film or scan of a heap.
struct MeasuredFile {
  fs::path file;
  std::string pixels;  ///< fingerprint of the picture's pixels; empty: no picture
  PictureReading reading;
};

MeasuredFile measured_file(const fs::path& file, const std::string& definition) {
  vision::PictureSettings told;
  told.measuring.definition = definition;
  if (vision::has_scan_ending(file)) {
    const ScanViews seen = measure_scan_file(file, told.measuring);
    return {.file = file, .pixels = {}, .reading = reading_of(file, seen.angle)};
  }
  const vision::HeapInFile seen = vision::measure_heap_file(file, told);
  return {.file = file,
          .pixels = seen.is_film ? std::string() : vision::pixels_of(seen.picture),
          .reading = reading_of(file, seen.heap.angle)};
}

/// A note on a picture that is not quite as it should be.
std::string note_on(const PictureReading& picture) {
  return counts_in_mean(picture.status)
             ? fmt::format("{}: flagged, but counted; check it with repose measure --overlay.",
                           picture.file.string())
             : fmt::format("{}: refused, left out: {}", picture.file.string(), picture.reason);
}

/// The heap of each file that the study assigns to a group, keyed by vision::identity().
std::map<std::string, std::string> heaps_named(const dem::Measured& bench, base::Faults& faults) {
  std::map<std::string, std::string> heaps;
  for (std::size_t k = 0; k < bench.picture_heaps.size(); ++k) {
    const std::string& heap = bench.picture_heaps[k];
    if (heap.empty()) continue;
    for (const auto& file : vision::list_pictures_and_films({bench.pictures[k].string()}).files) {
      const auto [place, is_new] = heaps.try_emplace(vision::identity(file).string(), heap);
      faults.require(
          is_new || place->second == heap,
          {.where = file.string(),
           .value = fmt::format("is of the heap \"{}\" and of \"{}\"", place->second, heap),
           .rule = "a picture shows one heap",
           .fix = "list it in one group of pictures."});
    }
  }
  return heaps;
}

/// Measures those that can be read; of duplicates only the first.
std::vector<PictureReading> measured_once(const std::vector<fs::path>& files,
                                          const std::map<std::string, std::string>& heaps,
                                          const std::string& definition, Findings& findings) {
  std::vector<MeasuredFile> all;
  for (const fs::path& file : files) {
    try {
      all.push_back(measured_file(file, definition));
      const auto group = heaps.find(vision::identity(file).string());
      if (group != heaps.end()) all.back().reading.heap = group->second;
    } catch (const base::InputError& error) {
      findings.faults.add_all(error.faults());
    }
  }
  std::vector<fs::path> read;
  std::vector<std::string> pixels;
  for (const MeasuredFile& one : all) {
    read.push_back(one.file);
    pixels.push_back(one.pixels);
  }
  const auto first_of = vision::copies_among(read, pixels);
  std::vector<PictureReading> pictures;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (first_of[i]) {
      findings.notes.push_back(vision::text_of_copy(read[i], read[*first_of[i]]));
      continue;
    }
    if (all[i].reading.status != "ok") findings.notes.push_back(note_on(all[i].reading));
    pictures.push_back(std::move(all[i].reading));
  }
  return pictures;
}

/// Names each picture that is far from the others, whether it counts or not.
void note_outliers(const std::vector<PictureReading>& pictures, std::vector<std::string>& notes) {
  const PictureSet set = set_of(pictures);
  for (const OutlyingPicture& outlier : set.outliers) {
    const PictureReading& picture = pictures[outlier.place];
    notes.push_back(
        fmt::format("{}: {}", picture.file.string(), text_of(outlier, set, *picture.angle_deg)));
  }
}

/// Files of heaps named in the study.
vision::FileList listed(const dem::Measured& bench) {
  if (!bench.scans.empty()) return vision::list_scans(names_of(bench.scans));
  if (!bench.videos.empty()) return vision::list_films(names_of(bench.videos));
  return vision::list_pictures_and_films(names_of(bench.pictures));
}

/// Scans are not pictures, and have no camera position.
void check_medium(const dem::Study& study, const dem::StudyExperiment& described,
                  const std::vector<fs::path>& files, base::Faults& faults) {
  const bool is_scanned = !described.measured.scans.empty();
  for (const fs::path& file : files) {
    if (vision::has_scan_ending(file) == is_scanned) continue;
    faults.add(
        {.where = file.string(),
         .value = is_scanned ? "is no three-dimensional scan" : "is a three-dimensional scan",
         .fix = is_scanned ? "name pictures and films in a study that has pictures = [...]."
                           : "write measured = { scans = [...] }, and no pictures there."});
  }
  const dem::ExperimentEntry& entry = dem::entry_of(described.protocol);
  faults.require(
      !is_scanned || entry.camera == nullptr || !entry.camera(described.protocol),
      {.where = study.file.string(),
       .value = "has scans and a camera's distance",
       .rule =
           "scans are read in silhouettes as from far away, and so are heaps simulated for them",
       .fix = fmt::format("take camera_distance_mm and camera_height_mm out of [experiment.{}].",
                          entry.name)});
}

/// The reason for the first picture, if all are refused.
std::string why_first(const std::vector<PictureReading>& pictures) {
  if (pictures.empty()) return {};
  const PictureReading& first = pictures.front();
  return fmt::format("; {}: {}", first.file.filename().string(), first.reason);
}

std::vector<PictureReading> measure_heaps(const dem::Study& study, Findings& findings) {
  const auto heap = study.experiments.find(&dem::pictured_experiment());
  if (heap == study.experiments.end()) return {};
  const dem::Measured& bench = heap->second.measured;
  if (!bench.is_seen()) return {};
  const std::vector<fs::path> files = files_of(listed(bench), findings);
  check_medium(study, heap->second, files, findings.faults);
  if (!findings.faults.empty()) return {};
  const auto heaps = heaps_named(bench, findings.faults);
  std::vector<PictureReading> pictures =
      measured_once(files, heaps, heap->second.definition, findings);
  note_outliers(pictures, findings.notes);
  const bool any = std::ranges::any_of(
      pictures, [](const PictureReading& picture) { return counts_in_mean(picture.status); });
  // If a file cannot be read, that is the error.
  findings.faults.require(
      any || !findings.faults.empty(),
      {.where = study.file.string(),
       .value = fmt::format("none of the {} {} of the heap could be measured{}", files.size(),
                            !bench.scans.empty()    ? "scans"
                            : !bench.videos.empty() ? "films"
                                                    : "pictures",
                            why_first(pictures)),
       .fix = "check them with repose measure --overlay, or give the angles as values."});
  return pictures;
}

/// A film's track, or why there is none.
struct TrackedFile {
  vision::FilmTrack track;
  std::string error;  ///< why it could not be read; empty: see its track
};

vision::Filmed filmed_of(const dem::ExperimentEntry& entry) {
  if (entry.filmed == dem::FilmedMotion::roll) return vision::Filmed::roll;
  if (entry.filmed == dem::FilmedMotion::slide) return vision::Filmed::tilt;
  return vision::Filmed::drop;
}

/// "What. Fix: ..." of "FILE: what. Fix: ...".
std::string without_name(const fs::path& file, const std::string& error) {
  const std::string name = file.string() + ": ";
  return error.starts_with(name) ? error.substr(name.size()) : error;
}

TrackedFile track_one(const fs::path& file, vision::Filmed filmed,
                      const vision::TrackOptions& options) {
  try {
    return {.track = vision::track_film(filmed, file, options), .error = {}};
  } catch (const base::InputError& error) {
    return {.track = {}, .error = without_name(file, error.what())};
  } catch (const std::exception& error) {
    if (!base::is_out_of_memory(error)) {
      throw std::runtime_error(file.string() + ": " + without_name(file, error.what()));
    }
    const std::string text = base::no_memory(file.string(), "a smaller film, or fewer threads");
    return {.track = {}, .error = without_name(file, text)};
  }
}

FilmNumber number_of(const vision::Estimate& estimate) {
  return {.value = estimate.value, .uncertainty = estimate.uncertainty};
}

/// The row as it would be written down at the bench.
std::map<std::string, FilmNumber> row_of(const vision::FilmTrack& film) {
  if (film.filmed == vision::Filmed::tilt) {
    return {{"angle_deg", number_of(film.tilt.angle_deg)},
            {"rate_deg_s", number_of(film.tilt.rate_deg_s)}};
  }
  if (film.filmed == vision::Filmed::roll) {
    return {{"incline_deg", number_of(film.roll.incline_deg)},
            {"released_mm", number_of(film.roll.released_mm)},
            {"stopped_mm", number_of(film.roll.stopped_mm)}};
  }
  const vision::Bounce& first = film.drop.bounces.front();
  return {{"drop_mm", number_of(first.drop_mm)}, {"rebound_mm", number_of(first.rebound_mm)}};
}

/// What the user should check, warning by warning.
std::string warnings_text(const vision::FilmTrack& film) {
  std::string text;
  for (const vision::Warning& warning : warnings_of(film)) {
    text += (text.empty() ? "" : "; ") + warning.message;
  }
  return text;
}

FilmReading reading_of(const fs::path& file, const TrackedFile& tracked,
                       const dem::ExperimentEntry& entry, const dem::Protocol& protocol) {
  const vision::FilmTrack& film = tracked.track;
  FilmReading reading{.experiment = std::string(entry.name),
                      .file = fs::absolute(file),
                      .status = "not read",
                      .value = {},
                      .reason = tracked.error};
  if (!tracked.error.empty()) return reading;
  reading.status = name_of(status_of(film));
  if (status_of(film) != vision::MeasureStatus::ok) {
    reading.reason = has_reading(film) ? warnings_text(film) : reason_of(film);
  }
  // Its bounces are later ones, whose fall height is not that set on the bench.
  if (film.filmed == vision::Filmed::drop && !film.drop.has_first_bounce()) return reading;
  if (has_reading(film)) read_row(entry, protocol, row_of(film), reading);
  return reading;
}

/// A note on a film that is not quite as it should be.
base::Fault fault_of(const FilmReading& film) {
  std::string what = film.reason;
  what += film.value ? fmt::format(
                           " (flagged, but counted; check it with repose track {} "
                           "--overlay)",
                           film.experiment)
                     : " (this film is left out)";
  return {.where = film.file.string(), .value = std::move(what)};
}

/// Duplicates of a film count once.
std::vector<fs::path> films_once(const std::vector<fs::path>& videos, Findings& findings) {
  const std::vector<fs::path> files = files_of(vision::list_films(names_of(videos)), findings);
  const auto first_of = vision::copies_among(files, std::vector<std::string>(files.size()));
  std::vector<fs::path> films;
  for (std::size_t i = 0; i < files.size(); ++i) {
    if (first_of[i]) {
      findings.notes.push_back(vision::text_of_copy(files[i], files[*first_of[i]]));
    } else {
      films.push_back(files[i]);
    }
  }
  return films;
}

std::vector<TrackedFile> track_all(const std::vector<fs::path>& films,
                                   const dem::ExperimentEntry& entry, const dem::Protocol& protocol,
                                   const BenchOptions& options) {
  const vision::Filmed filmed = filmed_of(entry);
  const FilmReport report = options.watch_films ? options.watch_films(films.size()) : nullptr;
  return batch_of<TrackedFile>(films.size(), options.threads, [&](std::size_t number) {
    vision::TrackOptions tracking;
    if (filmed == vision::Filmed::roll) {
      tracking.released_mm = protocol_value(entry, protocol, "release_mm");
    }
    if (report) {
      report(number, 0);
      tracking.progress = [&](double fraction) { report(number, fraction); };
    }
    return track_one(films[number], filmed, tracking);
  });
}

void read_films_of(const dem::Study& study, const dem::ExperimentEntry& entry,
                   const dem::StudyExperiment& described, const BenchOptions& options,
                   Findings& findings, std::vector<FilmReading>& readings) {
  const std::vector<fs::path> films = films_once(described.measured.videos, findings);
  const std::vector<TrackedFile> tracked = track_all(films, entry, described.protocol, options);
  bool any = false;
  std::vector<base::Fault> found;
  for (std::size_t i = 0; i < films.size(); ++i) {
    const FilmReading& reading =
        readings.emplace_back(reading_of(films[i], tracked[i], entry, described.protocol));
    any = any || reading.value;
    if (reading.status != "ok") found.push_back(fault_of(reading));
  }
  if (any || found.empty()) {
    for (const base::Fault& fault : found) findings.notes.push_back(fault.text());
    return;
  }
  findings.faults.add_all(found);
  findings.faults.add(
      {.where = study.file.string(),
       .value = fmt::format("none of the {} films of [experiment.{}] gives a reading", found.size(),
                            entry.name),
       .fix = fmt::format("check them with repose track {} --overlay, or give readings as values.",
                          entry.name)});
}

/// Tracks the films that the study names, several at a time. It is an error if none of an
/// experiment's films gives a reading.
std::vector<FilmReading> read_films(const dem::Study& study, const BenchOptions& options,
                                    Findings& findings) {
  std::vector<FilmReading> readings;
  for (const auto& [experiment, described] : study.experiments) {
    const dem::ExperimentEntry& entry = *experiment;
    // Those of heaps are measured like pictures.
    if (described.measured.videos.empty() || entry.is_pictured) continue;
    read_films_of(study, entry, described, options, findings, readings);
  }
  return readings;
}

}  // namespace

Measurement read_bench(const dem::Study& study, const BenchOptions& options,
                       std::vector<std::string>& notes) {
  Findings findings{.faults = base::Faults(), .notes = notes};
  Measurement measurement;
  measurement.sheets = read_all_sheets(study, options.no_rows, findings);
  measurement.pictures = measure_heaps(study, findings);
  measurement.films = read_films(study, options, findings);
  findings.faults.throw_if_any();
  return measurement;
}

}  // namespace repose::calibrate
