#include "cli/calibrate/calibrate_options.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/input_error.h"
#include "calibrate/experiment/heap_angle.h"
#include "calibrate/study/bench_readings.h"
#include "calibrate/study/study_record.h"
#include "cli/calibrate/calibrate.h"
#include "cli/common/json_text.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/picture_list.h"
#include "cli/track/track.h"
#include "vision/film/film_angle.h"
#include "vision/hints/hint_file.h"
#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"

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

/// Tracks the films that the plan's study names, several at a time: each gives a reading, or it is
/// said why it gives none. An experiment none of whose films gives one is an error.
void read_films(CalibratePlan& plan) {
  for (const auto& [experiment, described] : plan.record.study.experiments) {
    const dem::ExperimentEntry& entry = dem::entry_of(experiment);
    // Those of heaps are measured as pictures are.
    if (described.measured.videos.empty() || entry.is_pictured) continue;
    read_films_of(entry, described, plan);
  }
}

constexpr int kMaxJobs = 1024;

/// Does `work`; what it refuses becomes errors.
template <typename Work>
bool attempt(std::vector<std::string>& errors, const Work& work) {
  try {
    work();
    return true;
  } catch (const base::InputError& error) {
    add_faults(error, errors, kCalibrateFields);
    return false;
  }
}

/// @param pixels  is given those of a picture
vision::ReposeAngle measured_angle(const std::filesystem::path& file, std::string& pixels) {
  const auto [told, scale] = vision::with_saved_hints({}, file);
  if (vision::has_film_ending(file)) return vision::measure_film(file, told, scale).heap.angle;
  const vision::Picture picture = vision::read_picture(file);
  pixels = pixels_of(picture);
  return vision::measure_sized_heap(picture, told, scale).angle;
}

calibrate::PictureReading reading_of(const std::filesystem::path& file,
                                     const std::string& definition, std::string& pixels) {
  const vision::ReposeAngle angle = measured_angle(file, pixels);
  calibrate::PictureReading reading{.file = std::filesystem::absolute(file),
                                    .status = name_of(angle.status),
                                    .angle_deg = {},
                                    .reason = angle.reason};
  const calibrate::SetPicture seen = calibrate::set_picture_of(angle, definition);
  reading.own_deg = seen.own_deg;
  reading.camera_deg = seen.camera_deg;
  if (seen.angle_deg) {
    reading.angle_deg = seen.angle_deg;
  } else if (angle.status != vision::MeasureStatus::refused) {
    reading.status = name_of(vision::MeasureStatus::refused);
    reading.reason = fmt::format(
        "its angle cannot be measured by the definition {}: too little of the flank is seen. Fix: "
        "take pictures in which the heap is larger and whole.",
        definition);
  }
  return reading;
}

/// What to know about a picture that is not quite as it should be.
std::string note_on(const calibrate::PictureReading& picture) {
  return calibrate::counts_in_mean(picture.status)
             ? fmt::format("{}: flagged, but counted; check it with repose measure --overlay.",
                           picture.file.string())
             : fmt::format("{}: refused, left out: {}", picture.file.string(), picture.reason);
}

std::vector<std::string> names_of(const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> names;
  for (const std::filesystem::path& file : files) names.push_back(file.string());
  return names;
}

/// The heap of each file that the study puts into a group, by identity().
std::map<std::string, std::string> heaps_named(const dem::Measured& measured,
                                               std::vector<std::string>& errors) {
  std::map<std::string, std::string> heaps;
  for (std::size_t k = 0; k < measured.picture_heaps.size(); ++k) {
    const std::string& heap = measured.picture_heaps[k];
    if (heap.empty()) continue;
    for (const auto& file : list_pictures_and_films({measured.pictures[k].string()}).files) {
      const auto [place, is_new] = heaps.try_emplace(identity(file).string(), heap);
      if (is_new || place->second == heap) continue;
      errors.push_back(fmt::format(
          "{}: is of the heap \"{}\" and of \"{}\". Rule: a picture shows one heap. Fix: list it "
          "in one group of pictures.",
          file.string(), place->second, heap));
    }
  }
  return heaps;
}

/// Pictures that are far from the others: each is named, whether it counts or not.
void note_outliers(CalibratePlan& plan) {
  const calibrate::PictureSet set = calibrate::set_of(plan.record.pictures);
  for (const calibrate::OutlyingPicture& outlier : set.outliers) {
    const calibrate::PictureReading& picture = plan.record.pictures[outlier.place];
    plan.notes.push_back(
        fmt::format("{}: {}", picture.file.string(), text_of(outlier, set, *picture.angle_deg)));
  }
}

/// Photographs and films of the bench's heaps: each gives a reading, or it is said why it gives
/// none.
void measure_heaps(CalibratePlan& plan) {
  const auto heap = plan.record.study.experiments.find(dem::Experiment::heap);
  if (heap == plan.record.study.experiments.end()) return;
  const dem::Measured& measured = heap->second.measured;
  if (measured.pictures.empty() && measured.videos.empty()) return;
  const FileList list = measured.videos.empty()
                            ? list_pictures_and_films(names_of(measured.pictures))
                            : list_films(names_of(measured.videos));
  plan.errors.insert(plan.errors.end(), list.errors.begin(), list.errors.end());
  plan.notes.insert(plan.notes.end(), list.notes.begin(), list.notes.end());
  bool any = false;
  const std::map<std::string, std::string> heaps = heaps_named(measured, plan.errors);
  std::vector<calibrate::PictureReading> readings;
  std::vector<std::filesystem::path> files;
  std::vector<std::string> pixels;
  for (const std::filesystem::path& file : list.files) {
    attempt(plan.errors, [&] {
      std::string own_pixels;
      readings.push_back(reading_of(file, heap->second.definition, own_pixels));
      const auto group = heaps.find(identity(file).string());
      if (group != heaps.end()) readings.back().heap = group->second;
      files.push_back(file);
      pixels.push_back(std::move(own_pixels));
    });
  }
  const auto first_of = copies_among(files, pixels);
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (first_of[i]) {
      plan.notes.push_back(text_of_copy(files[i], files[*first_of[i]]));
      continue;
    }
    if (calibrate::counts_in_mean(readings[i].status)) any = true;
    if (readings[i].status != "ok") plan.notes.push_back(note_on(readings[i]));
    plan.record.pictures.push_back(std::move(readings[i]));
  }
  note_outliers(plan);
  if (plan.errors.empty() && !any) {
    plan.errors.push_back(
        fmt::format("{}: none of the {} {} of the heap could be measured. Fix: check them with "
                    "repose measure --overlay, or give the angles as values.",
                    plan.record.study.file.string(), list.files.size(),
                    measured.videos.empty() ? "pictures" : "films"));
  }
}

void read_jobs(const CalibrateArguments& arguments, CalibratePlan& plan) {
  plan.jobs = plan.record.study.threads.value_or(available_cores());
  if (arguments.jobs.empty()) return;
  const auto jobs = parse_number<int>(arguments.jobs);
  if (!jobs || *jobs < 1 || *jobs > kMaxJobs) {
    plan.errors.push_back(fmt::format(
        "--jobs {}: must be a whole number from 1 to {}. Fix: leave it out to use all cores.",
        arguments.jobs, kMaxJobs));
    return;
  }
  plan.jobs = *jobs;
}

/// Nothing of the user's may be written over.
void check_places(CalibratePlan& plan) {
  const dem::Study& study = plan.record.study;
  if (plan.out_folder.empty()) plan.out_folder = default_folder(study.file);
  const std::vector<std::string> foreign = calibrate::foreign_files(plan.out_folder, study.file);
  if (!foreign.empty()) {
    plan.errors.push_back(
        fmt::format("--out {}: not a folder of repose calibrate, and your own files there would be "
                    "overwritten: {}. Fix: choose another folder, or move them away.",
                    plan.out_folder.string(), fmt::join(foreign, ", ")));
  }
  std::vector<std::filesystem::path> read = files_of(study);
  for (const char* name : {calibrate::kStudyCopy, calibrate::kClumpCopy, calibrate::kNotesFile,
                           calibrate::kResultFile, calibrate::kHeapFile}) {
    read.push_back(plan.out_folder / name);
  }
  check_output_places({json_place(plan.json_file, "\"hash\"")}, read, plan.errors);
}

/// A dry run tells what the joint method would do, and gives no results.
void check_method(const CalibrateArguments& arguments, CalibratePlan& plan) {
  if (arguments.method != "joint" && arguments.method != "paper") {
    plan.errors.push_back(fmt::format(
        "--method {}: must be joint or paper. Fix: leave it out for joint.", arguments.method));
  }
  if (!arguments.is_dry_run) return;
  if (!arguments.json_file.empty()) {
    plan.errors.emplace_back("--dry-run: gives no results for --json. Fix: leave one of them out.");
  }
  if (arguments.method != "joint") {
    plan.errors.push_back(
        fmt::format("--dry-run: is for the joint method, not for --method {}, which makes at most "
                    "62 simulations. Fix: leave one of them out.",
                    arguments.method));
  }
}

}  // namespace

std::filesystem::path default_folder(const std::filesystem::path& study_file) {
  return study_file.stem().string() + "_calibration";
}

CalibratePlan read_bench(const CalibrateArguments& arguments, calibrate::NoRows no_rows) {
  CalibratePlan plan;
  plan.record.settings = arguments.settings;
  plan.out_folder = arguments.out_folder;
  plan.json_file = arguments.json_file;
  plan.record.method = arguments.method;
  attempt(plan.errors, [&] { plan.record.budget = calibrate::budget_named(arguments.budget); });
  const bool is_read = attempt(plan.errors, [&] {
    plan.record.study = dem::read_study(arguments.study, arguments.settings);
  });
  read_jobs(arguments, plan);
  if (!is_read) return plan;
  check_places(plan);
  attempt(plan.errors,
          [&] { plan.record.sheets = calibrate::read_sheets(plan.record.study, no_rows); });
  for (const calibrate::SheetReadings& sheet : plan.record.sheets) {
    plan.notes.insert(plan.notes.end(), sheet.notes.begin(), sheet.notes.end());
  }
  measure_heaps(plan);
  read_films(plan);
  if (!plan.errors.empty()) return plan;
  attempt(plan.errors, [&] {
    plan.record.grain = dem::build_grain(plan.record.study.grain);
    plan.record.study =
        calibrate::as_measured(std::move(plan.record.study), plan.record.grain.shape,
                               plan.record.pictures, plan.record.sheets, plan.record.films);
    for (const base::Fault& fault :
         calibrate::impossible_readings(plan.record.study, plan.record.grain.shape)) {
      plan.errors.push_back(fault.text());
    }
  });
  for (const std::string& repair : plan.record.grain.repairs) {
    plan.notes.push_back(fmt::format("{}: {}", plan.record.grain.source, repair));
  }
  const std::string shape = dem::warning_of_shape(plan.record.grain);
  if (!shape.empty()) plan.notes.push_back(shape);
  return plan;
}

CalibratePlan plan_calibrate(const CalibrateArguments& arguments) {
  CalibratePlan plan = read_bench(arguments, calibrate::NoRows::refused);
  check_method(arguments, plan);
  if (!plan.errors.empty()) return plan;
  attempt(plan.errors, [&] {
    plan.problem = calibrate::problem_of(plan.record.study, plan.record.grain, plan.record.budget);
  });
  plan.notes.insert(plan.notes.end(), plan.problem.notes.begin(), plan.problem.notes.end());
  return plan;
}

namespace {

constexpr const char* kCalibrateNotes = R"(
STUDY is a study file in which contact coefficients have bounds instead of a
value, as in restitution = { min = 0.1, max = 0.6 }, and experiments state what
was measured. All unknowns are fitted to all measurements at once; each gets an
interval and a verdict: determined, bounded, one-sided, or undetermined by these
data. The best fit is then simulated with fresh seeds; these runs enter the fit too,
and a verdict says whether bench and simulation agree: agrees, disagrees, or
cannot tell.

Simulations are saved in --out: the same command resumes an interrupted study,
and a study with other bounds or measurements reuses them. The same study gives
the same result with any number of --jobs.

Methods:
  joint     all unknowns fitted to all measurements at once, with intervals
  paper     a published calibration procedure: point estimates, for comparison

Budgets:
  quick     14 minutes on one core for the fit
  standard  125 minutes on one core for the fit
  paper     at most 62 simulations, the number of a published calibration
The minutes are estimates for heaps of a few hundred grains; verification is
extra. --dry-run times one run of each experiment, for at most 20 seconds each,
and reports what each budget would simulate and how long it takes. It needs the
bench readings, and saves nothing.

--rolling-models constant_torque,elastic_plastic calibrates the study with each
of them, in folders of their own, and says which one explains the bench readings
best: their means, and how much they scatter.

Examples:
  repose calibrate study.toml --dry-run
  repose calibrate study.toml
  repose calibrate study.toml --rolling-models constant_torque,elastic_plastic
  repose calibrate study.toml --budget standard --jobs 8 --out hazelnut
)";

}  // namespace

Command calibrate_command() {
  const auto given = std::make_shared<CalibrateArguments>();
  return {
      .name = "calibrate",
      .summary = "Calibrate a study's coefficients",
      .options = {{"study", "STUDY.toml", "Study file", &given->study, true},
                  {"--budget", "quick|standard|paper", "Limit on the simulations (quick)",
                   &given->budget},
                  {"--method", "joint|paper", "Method of calibration (joint)", &given->method},
                  {"--rolling-models", "A,B", "Fit the study with each, and compare them",
                   &given->rolling_models},
                  {"--set", "KEY=VALUE", "Replace a value of the study; repeatable",
                   &given->settings},
                  {"--jobs", "N", "Simulations in parallel (all cores)", &given->jobs},
                  {"--out", "FOLDER", "Output folder (STUDY_calibration)", &given->out_folder},
                  {"--dry-run", "", "Only estimate how long each budget takes", &given->is_dry_run},
                  {"--json", "FILE|-", "Full results, for programs", &given->json_file}},
      .notes = kCalibrateNotes,
      .missing = "no study file given. Fix: repose calibrate STUDY.toml.",
      .fields = kCalibrateFields,
      .run = [given] { return run_calibrate(*given); }};
}

}  // namespace repose::cli
