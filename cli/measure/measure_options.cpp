#include "cli/measure/measure_options.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/output_places.h"
#include "cli/common/picture_list.h"
#include "cli/common/picture_options.h"
#include "cli/common/scale_option.h"
#include "vision/film/film_angle.h"
#include "vision/picture/picture.h"

namespace repose::cli {
namespace {

namespace fs = std::filesystem;

void check_overlay_folder(const MeasureArguments& arguments, MeasurePlan& plan) {
  const fs::path folder = arguments.overlay_folder;
  const auto is_measured = [&](const std::string& name) {
    std::error_code ignored;
    return fs::is_directory(name, ignored) && identity(name) == identity(folder);
  };
  if (std::any_of(arguments.pictures.begin(), arguments.pictures.end(), is_measured)) {
    plan.errors.push_back(
        fmt::format("--overlay {}: is itself measured, so the overlays would be measured next "
                    "time. Fix: choose "
                    "another folder.",
                    folder.string()));
    return;
  }
  make_output_folder("--overlay", folder, plan.errors);
}

void read_places(const char* option, const std::vector<std::string>& typed,
                 std::vector<vision::Point>& places, std::vector<std::string>& errors) {
  for (const std::string& text : typed) {
    if (const auto place = read_point({option, text, errors})) {
      places.push_back({place->front(), place->back()});
    }
  }
}

/// What a person says of every picture that is measured.
void read_hints(const MeasureArguments& arguments, MeasurePlan& plan) {
  vision::Hints& hints = plan.options.hints;
  if (const auto box = read_box({"--heap", arguments.heap, plan.errors})) {
    const auto [x, y, width, height] = *box;
    hints.heap = vision::Box{.x = x, .y = y, .width = width, .height = height};
  }
  if (const auto line = read_line({"--ground", arguments.ground, plan.errors})) {
    const auto [x1, y1, x2, y2] = *line;
    hints.ground = vision::Segment{{x1, y1}, {x2, y2}};
  }
  read_places("--keep", arguments.keep, hints.keep, plan.errors);
  read_places("--drop", arguments.drop, hints.drop, plan.errors);
  plan.saves_hints = arguments.saves_hints;
  if (arguments.mask_file.empty()) return;
  hints.mask_file = arguments.mask_file;
  try {
    hints.mask = vision::read_picture(arguments.mask_file);
  } catch (const base::InputError& error) {
    plan.errors.push_back(fmt::format("--mask {}", error.what()));
  }
}

/// Only films have frames.
void read_step(const MeasureArguments& arguments, MeasurePlan& plan) {
  plan.every_s =
      read_positive({"--every", arguments.every, plan.errors}, "a time in seconds", "--every 0.1");
  if (!plan.every_s || plan.frames_per_s ||
      std::any_of(plan.pictures.begin(), plan.pictures.end(), vision::has_film_ending)) {
    return;
  }
  plan.errors.push_back(
      fmt::format("--every {}: there are pictures only. Rule: it is for films, whose frames are "
                  "measured one by one. Fix: leave it out, or name a film.",
                  arguments.every));
}

}  // namespace

MeasurePlan plan_measure(const MeasureArguments& arguments) {
  MeasurePlan plan;
  plan.options = read_measuring({.method = arguments.method,
                                 .window = arguments.window,
                                 .pitch_deg = arguments.pitch_deg,
                                 .exclude = arguments.exclude,
                                 .fields = kMeasureFields},
                                plan.errors);
  read_hints(arguments, plan);
  plan.scale = read_scale(arguments.scale,
                          "--scale 310,980,910,980,200, of a ruler in the plane of the heap's "
                          "middle",
                          "the heap's middle", plan.errors);
  plan.threads = read_threads({"--threads", arguments.threads, plan.errors});
  plan.keeps_overlays = !arguments.report_file.empty();
  if (arguments.report_file == kStandardOutput) {
    plan.errors.emplace_back("--report -: a page cannot be shown on a terminal. Fix: name a file.");
  }

  plan.frames_per_s = read_frame_rate(arguments.fps, arguments.pictures, plan.errors);
  FileList list = plan.frames_per_s ? list_with_frame_folders(arguments.pictures)
                                    : list_pictures_and_films(arguments.pictures);
  plan.pictures = std::move(list.files);
  plan.notes = std::move(list.notes);
  plan.errors.insert(plan.errors.end(), list.errors.begin(), list.errors.end());
  read_step(arguments, plan);
  const std::vector<OutputPlace> places = {
      json_place(arguments.json_file, "\"ground_tilt_deg\""),
      csv_place("--csv", arguments.csv_file, "ground_tilt_deg"),
      json_place(arguments.summary_file, "\"mean_deg\"", "--summary"),
      page_place("--report", arguments.report_file)};
  check_output_places(places, plan.pictures, plan.errors);
  if (arguments.overlay_folder.empty()) return plan;

  check_overlay_folder(arguments, plan);
  OverlayFiles overlays = name_overlays(plan.pictures, arguments.overlay_folder);
  plan.overlays = std::move(overlays.files);
  plan.notes.insert(plan.notes.end(), overlays.notes.begin(), overlays.notes.end());
  return plan;
}

}  // namespace repose::cli
