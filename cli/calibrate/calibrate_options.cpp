#include "cli/calibrate/calibrate_options.h"

#include <array>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/input_error.h"
#include "calibrate/experiment/heap_angle.h"
#include "calibrate/study/study_record.h"
#include "cli/calibrate/bench_films.h"
#include "cli/common/copies.h"
#include "cli/common/cores.h"
#include "cli/common/degrees.h"
#include "cli/common/number.h"
#include "cli/common/output.h"
#include "cli/common/output_places.h"
#include "cli/common/picture_list.h"
#include "vision/film/film_angle.h"
#include "vision/hints/hint_file.h"
#include "vision/measure/repose_angle.h"
#include "vision/measure/status_name.h"
#include "vision/picture/picture.h"

namespace repose::cli {
namespace {

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
  const auto jobs = number_in<int>(arguments.jobs);
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

}  // namespace repose::cli
