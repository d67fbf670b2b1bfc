#include "cli/track/track.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "cli/common/batch.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/picture_list.h"
#include "cli/common/picture_options.h"
#include "cli/common/terminal.h"
#include "cli/track/track_table.h"
#include "vision/files/file_list.h"

namespace repose::cli {

namespace {

TrackedFilm track_one(const TrackPlan& plan, std::size_t index,
                      const std::function<void(double)>& progress) {
  calibrate::FilmTracking tracking{.film = {plan.videos[index], plan.frames_per_s, plan.scale.lens},
                                   .filmed = plan.filmed,
                                   .scale = plan.scale,
                                   .released_mm = plan.released_mm,
                                   .progress = progress};
  if (!plan.overlays.empty()) {
    tracking.take_overlay = [&](const vision::Picture& overlay) {
      vision::write_picture(plan.overlays[index], overlay);
    };
  }
  return calibrate::tracked_film(tracking);
}

}  // namespace

std::vector<TrackedFilm> track_batch(const TrackPlan& plan,
                                     const std::atomic<bool>& is_interrupted) {
  return batch_of<TrackedFilm>(
      plan.videos.size(), plan.threads, "tracked", is_interrupted,
      [&](std::size_t number, const auto& report) { return track_one(plan, number, report); });
}

namespace {

void print_errors(const std::vector<TrackedFilm>& films) {
  for (const TrackedFilm& film : films) {
    const std::string whose = film.is_internal_error ? "internal error: " : "";
    if (!film.error.empty()) print_line(whose + film.error);
    if (!film.overlay_error.empty()) print_line(film.overlay_error);
  }
}

/// Marks films that are duplicates of an earlier one.
void name_copies(std::vector<TrackedFilm>& films) {
  std::vector<std::filesystem::path> files;
  for (const TrackedFilm& film : films) files.emplace_back(film.file);
  const auto first_of = vision::copies_among(files, std::vector<std::string>(files.size()));
  for (std::size_t i = 0; i < films.size(); ++i) {
    if (!first_of[i]) continue;
    films[i].copy_of = films[*first_of[i]].file;
    print_line(vision::text_of_copy(files[i], files[*first_of[i]]));
  }
}

ExitCode exit_code(const std::vector<TrackedFilm>& films) {
  const auto any = [&](auto predicate) {
    return std::any_of(films.begin(), films.end(), predicate);
  };
  if (any([](const auto& film) { return film.is_internal_error; })) return ExitCode::internal_error;
  if (any([](const auto& film) { return !film.error.empty() || !film.overlay_error.empty(); }))
    return ExitCode::bad_input;
  return any([](const auto& film) { return has_reading(film); }) ? ExitCode::done
                                                                 : ExitCode::nothing_measurable;
}

}  // namespace

ExitCode run_track(const TrackArguments& arguments) {
  const TrackPlan plan = plan_track(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;
  print_lines(plan.notes);

  const std::atomic<bool>& is_interrupted = watch_for_interrupt();
  std::vector<TrackedFilm> films = track_batch(plan, is_interrupted);
  if (is_interrupted) {
    print_line("interrupted, no results were written");
    return ExitCode::interrupted;
  }
  name_copies(films);
  Outputs outputs;
  const bool any_was_read =
      std::any_of(films.begin(), films.end(), [](const auto& film) { return film.error.empty(); });
  if (any_was_read)
    outputs.show(track_table(films, plan.filmed, columns_of(stdout), wants_colour(stdout)));
  outputs.add(arguments.json_file, calibrate::track_json(films));
  outputs.add(arguments.csv_file,
              calibrate::track_csv(films, plan.filmed,
                                   plan.tells_all_bounces ? calibrate::BouncesToTell::all
                                                          : calibrate::BouncesToTell::first));
  outputs.write_files();
  print_errors(films);
  outputs.write();
  return exit_code(films);
}

namespace {

/// Options specific to one experiment.
void read_own_options(const TrackArguments& arguments, TrackPlan& plan) {
  constexpr double kShortest_mm = 1, kLongest_mm = 10000;  // of inclines that can be filmed
  plan.released_mm =
      read_number_within({"--released", arguments.released, plan.errors}, kShortest_mm, kLongest_mm,
                         "how far up the incline from its foot, in mm");
  const auto belongs = [&](bool does, const std::string& given, const char* message) {
    if (!does && !given.empty()) plan.errors.emplace_back(message);
  };
  belongs(plan.filmed == vision::Filmed::roll, arguments.released,
          "--released: is for track roll. Fix: leave it out.");
  belongs(plan.filmed == vision::Filmed::drop, arguments.bounces,
          "--bounces: is for track drop. Fix: leave it out.");
  const bool has_scale = !arguments.scale.scale.empty() || arguments.scale.finds_board;
  belongs(plan.filmed != vision::Filmed::tilt, arguments.scale.scale,
          "--scale: is for track drop and roll; angles need none. Fix: leave it out.");
  belongs(plan.filmed != vision::Filmed::tilt, arguments.scale.finds_board ? "--board" : "",
          "--board: is for track drop and roll; angles need no scale. Fix: leave it out.");
  if (plan.filmed == vision::Filmed::roll && has_scale == !arguments.released.empty()) {
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
  plan.filmed = read_choice<vision::Filmed>({"track", arguments.experiment, plan.errors},
                                            {{"drop", vision::Filmed::drop},
                                             {"roll", vision::Filmed::roll},
                                             {"tilt", vision::Filmed::tilt}})
                    .value_or(plan.filmed);
  for (const std::string& video : arguments.videos)
    plan.videos.push_back(vision::without_slash(video));
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

namespace {

constexpr const char* kTrackNotes = R"(
VIDEO is a film of one grain from the side, by a camera that stands still: MP4,
MOV, AVI, MKV, WebM or GIF. With --fps it may be a folder of its frames, pictures
with numbers in their names. FILE may be - for standard output.

  drop   The grain falls on a level plate and bounces. Parabolas are fitted
         to its flights, all with one gravity, which is the ruler: the ratio
         of the speeds at an impact needs no scale.
  roll   The grain rolls down an incline and on along the flat until it is at
         rest. Two straight lines are fitted to its path; the foot is where
         the planes below them meet. Distances are along the planes from
         there, in millimetres of --scale or --board, or of --released: how far
         up the incline the grains were let go.
  tilt   The plate is level at first and is tilted slowly until the grain, or
         grains that are bonded, slides. A line is fitted to the plate's edge
         in each frame, and the slide is traced back to its onset: the angle
         is what the plate has turned until then. No scale is needed.

Heights of a drop are those of a fall without air to the speed at the impact.
With a scale they are in its millimetres, and the film's frame rate is checked
against gravity. The scale is --scale, or with --board the printed board (repose
board) upright beside the grain's path, in its plane, facing the camera. Without
a scale they follow from gravity and the frame rate, and are wrong if a film
does not play as fast as it was taken (slow motion).

The table for --csv has the columns that repose bench restitution reads, or
rolling, or sliding, and a film's name as sample.

Uncertainties are half-widths of 95 % intervals.

Examples:
  repose track drop drop_01.mp4 --overlay drop_01.png
  repose track drop drop_01.mp4 drop_02.mp4 --csv drops.csv
  repose bench restitution drops.csv
  repose track drop frames_01 --fps 240 --overlay drop_01.png
  repose track roll roll_01.mp4 --released 150 --csv rolls.csv
  repose track tilt tilt_01.mp4 --overlay tilt_01.png --csv tilts.csv
)";

}  // namespace

Command track_command() {
  const auto given = std::make_shared<TrackArguments>();
  return {
      .name = "track",
      .summary = "Read bench experiments off films",
      .options =
          {{"experiment", "drop|roll|tilt", "Which experiment is filmed", &given->experiment, true},
           {"videos", "VIDEO ...", "Films, a repeat each", &given->videos, true},
           {"--scale", "X1,Y1,X2,Y2,MM", "Two points and their distance", &given->scale.scale},
           {"--board", "", "Find the board of repose board: the scale", &given->scale.finds_board},
           {"--square-mm", "MM", "Side of a printed square (24)", &given->scale.square_mm},
           {"--board-behind", "MM", "How far behind the grain's way it is (0)",
            &given->scale.board_behind_mm},
           {"--camera-file", "FILE.toml", "Camera whose lens distortion to correct",
            &given->scale.camera_file},
           {"--released", "MM", "Of rolls: way up the incline", &given->released},
           {"--fps", "N", "Of folders of frames: how many a second", &given->fps},
           {"--bounces", "first|all", "Bounces in the CSV table (first)", &given->bounces},
           {"--overlay", "FILE.png|FOLDER", "Draw what was tracked", &given->overlay},
           {"--json", "FILE|-", "All results, for programs", &given->json_file},
           {"--csv", "FILE|-", "A row for each bounce, roll or tilt", &given->csv_file},
           {"--threads", "N", "Films at a time (all cores)", &given->threads}},
      .notes = kTrackNotes,
      .missing = "an experiment and a film are needed. Fix: repose track drop VIDEO.",
      .run = [given] { return run_track(*given); }};
}

}  // namespace repose::cli
