#include "cli/measure/measure_options.h"

#include <algorithm>
#include <stdexcept>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "base/whole_file.h"
#include "cli/common/number.h"
#include "cli/common/output.h"
#include "cli/common/output_places.h"
#include "cli/common/picture_list.h"
#include "cli/common/picture_options.h"

namespace repose::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxThreads = 1024;

void read_threads(const std::string& text, MeasurePlan& plan) {
  plan.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  if (text.empty()) return;
  const auto threads = number_in<int>(text);
  if (!threads || *threads < 1 || *threads > kMaxThreads) {
    plan.errors.push_back(fmt::format(
        "--threads {}: must be a whole number from 1 to {}. Fix: leave it out to use all cores.",
        text, kMaxThreads));
    return;
  }
  plan.threads = *threads;
}

void check_overlay_folder(const MeasureArguments& arguments, MeasurePlan& plan) {
  const fs::path folder = arguments.overlay_folder;
  const auto is_measured = [&](const std::string& name) {
    std::error_code ignored;
    return fs::is_directory(name, ignored) && identity(name) == identity(folder);
  };
  if (std::any_of(arguments.pictures.begin(), arguments.pictures.end(), is_measured)) {
    plan.errors.push_back(fmt::format(
        "--overlay {}: is a folder that is measured, so the overlays would be measured next time. "
        "Fix: choose another folder.",
        folder.string()));
    return;
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (std::error_code ignored; error || !fs::is_directory(folder, ignored)) {
    plan.errors.push_back(fmt::format(
        "--overlay {}: the folder cannot be made ({}). Fix: choose a place you may write to.",
        folder.string(), error ? error.message() : "there is a file of that name"));
    return;
  }
  try {
    base::check_can_write(folder / "overlay.png");
  } catch (const std::invalid_argument& error) {
    plan.errors.push_back(fmt::format("--overlay {}", error.what()));
  }
}

}  // namespace

MeasurePlan plan_measure(const MeasureArguments& arguments) {
  MeasurePlan plan;
  read_method(arguments.method, plan.options, plan.errors);
  read_window(arguments.window, plan.options, plan.errors);
  read_pitch(arguments.pitch_deg, plan.options, plan.errors);
  read_boxes("--exclude", arguments.exclude, plan.options, plan.errors);
  read_threads(arguments.threads, plan);
  plan.keeps_overlays = !arguments.report_file.empty();
  if (arguments.report_file == kStandardOutput) {
    plan.errors.emplace_back("--report -: is a page, not for a terminal. Fix: name a file.");
  }

  PictureList list = list_pictures(arguments.pictures);
  plan.pictures = std::move(list.files);
  plan.notes = std::move(list.notes);
  plan.errors.insert(plan.errors.end(), list.errors.begin(), list.errors.end());
  const std::vector<OutputPlace> places = {{"--json", arguments.json_file},
                                           {"--csv", arguments.csv_file},
                                           {"--summary", arguments.summary_file},
                                           {"--report", arguments.report_file}};
  check_output_places(places, plan.pictures, plan.errors);
  if (arguments.overlay_folder.empty()) return plan;

  check_overlay_folder(arguments, plan);
  OverlayFiles overlays = name_overlays(plan.pictures, arguments.overlay_folder);
  plan.overlays = std::move(overlays.files);
  plan.notes.insert(plan.notes.end(), overlays.notes.begin(), overlays.notes.end());
  return plan;
}

}  // namespace repose::cli
