#include "cli/measure_options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "cli/number.h"
#include "cli/output.h"
#include "cli/picture_list.h"
#include "vision/whole_file.h"

namespace repose::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kLargestPitchDeg = 30;  // from higher up the side view is lost
constexpr int kMostThreads = 1024;

void read_method(const std::string& text, MeasurePlan& plan) {
  if (text.empty() || text == "auto") return;
  if (text == "paper") {
    plan.options.method = vision::Method::paper;
    return;
  }
  plan.faults.push_back(
      fmt::format("--method {}: there is no such method. Fix: auto or paper.", text));
}

void read_window(const std::string& text, MeasurePlan& plan) {
  if (text.empty()) return;
  const auto window = numbers_in<double, 2>(text);
  if (!window) {
    plan.faults.push_back(fmt::format(
        "--window {}: must be two numbers with a comma between them. Fix: --window 0.2,0.8.",
        text));
    return;
  }
  plan.options.window_from = window->front();
  plan.options.window_to = window->back();
  for (std::string& problem : plan.options.problems()) plan.faults.push_back(std::move(problem));
}

void read_pitch(const std::string& text, MeasurePlan& plan) {
  if (text.empty()) return;
  const auto pitch_deg = number_in<double>(text);
  if (!pitch_deg || std::abs(*pitch_deg) > kLargestPitchDeg) {
    plan.faults.push_back(
        fmt::format("--pitch-deg {}: must be a number of degrees between -{} and {}. Fix: give "
                    "the angle by which the camera looks down, or take a level picture.",
                    text, kLargestPitchDeg, kLargestPitchDeg));
    return;
  }
  plan.options.camera_pitch_rad = *pitch_deg * std::numbers::pi / 180;
}

void read_boxes(const std::vector<std::string>& texts, MeasurePlan& plan) {
  for (const std::string& text : texts) {
    const auto box = numbers_in<int, 4>(text);
    if (!box) {
      plan.faults.push_back(fmt::format(
          "--exclude {}: must be four whole numbers X,Y,W,H in pixels. Fix: --exclude 0,0,200,80 "
          "leaves out 200 x 80 pixels in the top left corner.",
          text));
      continue;
    }
    const auto [x, y, width, height] = *box;
    if (x < 0 || y < 0 || width < 1 || height < 1) {
      plan.faults.push_back(fmt::format(
          "--exclude {}: X and Y must be at least 0, W and H at least 1. Fix: count from the "
          "picture's top left corner.",
          text));
      continue;
    }
    plan.options.excluded.push_back({.x = x, .y = y, .width = width, .height = height});
  }
}

void read_threads(const std::string& text, MeasurePlan& plan) {
  plan.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  if (text.empty()) return;
  const auto threads = number_in<int>(text);
  if (!threads || *threads < 1 || *threads > kMostThreads) {
    plan.faults.push_back(fmt::format(
        "--threads {}: must be a whole number from 1 to {}. Fix: leave it out to use all cores.",
        text, kMostThreads));
    return;
  }
  plan.threads = *threads;
}

bool same_file(const fs::path& a, const fs::path& b) { return identity(a) == identity(b); }

/// Faults of --json, --csv and --summary: two outputs in one place, a picture overwritten, a place
/// that cannot be written.
void check_output_files(const MeasureArguments& arguments, MeasurePlan& plan) {
  const std::array<std::pair<const char*, const std::string*>, 3> outputs{
      {{"--json", &arguments.json_file},
       {"--csv", &arguments.csv_file},
       {"--summary", &arguments.summary_file}}};
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const auto& [option, file] = outputs[i];
    if (file->empty()) continue;
    for (std::size_t j = 0; j < i; ++j) {
      if (outputs[j].second->empty() || !same_file(*outputs[j].second, *file)) continue;
      plan.faults.push_back(fmt::format("{} and {} both write to {}. Fix: give each its own file.",
                                        outputs[j].first, option, *file));
    }
    if (*file == kStandardOutput) continue;
    for (const fs::path& picture : plan.pictures) {
      if (!same_file(picture, *file)) continue;
      plan.faults.push_back(fmt::format(
          "{} {}: would overwrite a picture that is measured. Fix: choose another name.", option,
          *file));
    }
    try {
      vision::check_can_write(*file);
    } catch (const std::invalid_argument& fault) {
      plan.faults.push_back(fmt::format("{} {}", option, fault.what()));
    }
  }
}

void check_overlay_folder(const MeasureArguments& arguments, MeasurePlan& plan) {
  const fs::path folder = arguments.overlay_folder;
  const auto is_measured = [&](const std::string& name) {
    std::error_code ignored;
    return fs::is_directory(name, ignored) && same_file(name, folder);
  };
  if (std::any_of(arguments.pictures.begin(), arguments.pictures.end(), is_measured)) {
    plan.faults.push_back(fmt::format(
        "--overlay {}: is a folder that is measured, so the overlays would be measured next time. "
        "Fix: choose another folder.",
        folder.string()));
    return;
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (std::error_code ignored; error || !fs::is_directory(folder, ignored)) {
    plan.faults.push_back(fmt::format(
        "--overlay {}: the folder cannot be made ({}). Fix: choose a place you may write to.",
        folder.string(), error ? error.message() : "there is a file of that name"));
    return;
  }
  try {
    vision::check_can_write(folder / "overlay.png");
  } catch (const std::invalid_argument& fault) {
    plan.faults.push_back(fmt::format("--overlay {}", fault.what()));
  }
}

}  // namespace

MeasurePlan plan_measure(const MeasureArguments& arguments) {
  MeasurePlan plan;
  read_method(arguments.method, plan);
  read_window(arguments.window, plan);
  read_pitch(arguments.pitch_deg, plan);
  read_boxes(arguments.exclude, plan);
  read_threads(arguments.threads, plan);

  PictureList list = list_pictures(arguments.pictures);
  plan.pictures = std::move(list.files);
  plan.notes = std::move(list.notes);
  plan.faults.insert(plan.faults.end(), list.faults.begin(), list.faults.end());
  check_output_files(arguments, plan);
  if (arguments.overlay_folder.empty()) return plan;

  check_overlay_folder(arguments, plan);
  OverlayFiles overlays = name_overlays(plan.pictures, arguments.overlay_folder);
  plan.overlays = std::move(overlays.files);
  plan.notes.insert(plan.notes.end(), overlays.notes.begin(), overlays.notes.end());
  return plan;
}

}  // namespace repose::cli
