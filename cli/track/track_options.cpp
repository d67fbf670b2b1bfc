#include "cli/track/track_options.h"

#include <utility>

#include <fmt/format.h>

#include "cli/common/option_value.h"
#include "cli/common/output_places.h"
#include "cli/common/picture_list.h"
#include "cli/common/scale_option.h"

namespace repose::cli {
namespace {

/// What one experiment has and others do not.
void read_own_options(const TrackArguments& arguments, TrackPlan& plan) {
  constexpr double kShortest_mm = 1, kLongest_mm = 10000;  // of inclines that can be filmed
  plan.released_mm =
      read_number_within({"--released", arguments.released, plan.errors}, kShortest_mm, kLongest_mm,
                         "how far up the incline from its foot, in mm");
  const auto belongs = [&](bool does, const std::string& given, const char* message) {
    if (!does && !given.empty()) plan.errors.emplace_back(message);
  };
  belongs(plan.filmed == Filmed::roll, arguments.released,
          "--released: is for track roll. Fix: leave it out.");
  belongs(plan.filmed == Filmed::drop, arguments.bounces,
          "--bounces: is for track drop. Fix: leave it out.");
  const bool has_scale = !arguments.scale.scale.empty() || arguments.scale.finds_board;
  belongs(plan.filmed != Filmed::tilt, arguments.scale.scale,
          "--scale: is for track drop and roll; angles need none. Fix: leave it out.");
  belongs(plan.filmed != Filmed::tilt, arguments.scale.finds_board ? "--board" : "",
          "--board: is for track drop and roll; angles need no scale. Fix: leave it out.");
  if (plan.filmed == Filmed::roll && has_scale == !arguments.released.empty()) {
    plan.errors.push_back(fmt::format(
        "track roll: {}. Rule: millimetres come from --scale, --board or --released. Fix: --scale "
        "X1,Y1,X2,Y2,MM of a ruler beside the way, --board with the printed board there, or "
        "--released MM, how far up the incline from its foot the grains were let go.",
        has_scale ? "there are two scales" : "there is no scale"));
  }
}

void read_overlay(const TrackArguments& arguments, TrackPlan& plan,
                  std::vector<OutputPlace>& places) {
  if (arguments.overlay.empty()) return;
  if (arguments.overlay.ends_with(".png")) {
    places.push_back({"--overlay", arguments.overlay});
    plan.overlays.emplace_back(arguments.overlay);
    if (plan.videos.size() > 1) {
      plan.errors.push_back(
          fmt::format("--overlay {}: is one picture, and there are {} films. Fix: name a folder.",
                      arguments.overlay, plan.videos.size()));
    }
    return;
  }
  make_output_folder("--overlay", arguments.overlay, plan.errors);
  OverlayFiles overlays = name_overlays(plan.videos, arguments.overlay);
  plan.overlays = std::move(overlays.files);
  plan.notes = std::move(overlays.notes);
}

}  // namespace

TrackPlan plan_track(const TrackArguments& arguments) {
  TrackPlan plan;
  plan.filmed =
      read_choice<Filmed>({"track", arguments.experiment, plan.errors},
                          {{"drop", Filmed::drop}, {"roll", Filmed::roll}, {"tilt", Filmed::tilt}})
          .value_or(plan.filmed);
  for (const std::string& video : arguments.videos) plan.videos.push_back(without_slash(video));
  plan.frames_per_s = read_frame_rate(arguments.fps, arguments.videos, plan.errors);
  plan.scale =
      read_scale(arguments.scale, "--scale 310,95,310,980,500, of a ruler in the grain's plane",
                 "the grain's way", plan.errors);
  read_own_options(arguments, plan);
  plan.tells_all_bounces = read_choice<bool>({"--bounces", arguments.bounces, plan.errors},
                                             {{"first", false}, {"all", true}})
                               .value_or(false);
  plan.threads = read_threads({"--threads", arguments.threads, plan.errors});
  std::vector<OutputPlace> places = {json_place(arguments.json_file, "\"experiment\""),
                                     csv_place("--csv", arguments.csv_file, "_uncertainty_")};
  read_overlay(arguments, plan, places);
  check_output_places(places, plan.videos, plan.errors);
  return plan;
}

}  // namespace repose::cli
