#include "cli/measure/measure_options.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/angle_definition.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/common/picture_list.h"
#include "cli/common/picture_options.h"
#include "vision/files/file_list.h"
#include "vision/film/film_angle.h"
#include "vision/picture/picture.h"
#include "vision/scan/scan_file.h"

namespace repose::cli {

namespace {

namespace fs = std::filesystem;

void check_overlay_folder(const MeasureArguments& arguments, MeasurePlan& plan) {
  const fs::path folder = arguments.overlay_folder;
  const auto is_measured = [&](const std::string& name) {
    std::error_code ignored;
    return fs::is_directory(name, ignored) && vision::identity(name) == vision::identity(folder);
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

/// The user's hints for every measured picture.
void read_hints(const MeasureArguments& arguments, MeasurePlan& plan) {
  vision::Hints& hints = plan.options.hints;
  hints.turn_deg = read_choice<int>({"--rotate", arguments.rotate, plan.errors},
                                    {{"90", 90}, {"180", 180}, {"270", 270}})
                       .value_or(0);
  if (const auto box = read_box({"--heap", arguments.heap, plan.errors})) {
    const auto [x, y, width, height] = *box;
    hints.heap = vision::Box{.x = x, .y = y, .width = width, .height = height};
  }
  hints.half =
      read_choice<vision::Side>({"--half", arguments.half, plan.errors},
                                {{"left", vision::Side::left}, {"right", vision::Side::right}});
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

/// Options for scans and particles do not apply to pictures, nor the other way round.
void read_scans_and_particles(const MeasureArguments& arguments, MeasurePlan& plan) {
  plan.positions = read_position_options(arguments.positions, plan.errors);
  vision::ScanOptions& scan = plan.scan;
  scan.window_from = plan.options.window_from;
  scan.window_to = plan.options.window_to;
  scan.names = kMeasureFields;
  if (const auto unit_m = calibrate::unit_named(arguments.positions.unit)) {
    scan.unit_mm = 1000 * *unit_m;
  }
  if (!arguments.ground_plane.empty()) {
    if (const auto given = numbers_in<double, 9>(arguments.ground_plane)) {
      const auto& n = *given;
      scan.ground = {{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}}};
    } else {
      OptionText{"--ground-plane", arguments.ground_plane, plan.errors}.refuse(
          "nine numbers: three points X,Y,Z,X,Y,Z,X,Y,Z of the ground, in the scan's unit",
          "read them off the scan in a viewer, such as MeshLab.");
    }
  }
}

/// Refuses options that apply to none of the files, or not to all of them.
void check_kinds_of_files(const MeasureArguments& arguments, MeasurePlan& plan) {
  if (plan.pictures.empty()) return;
  const auto scan = std::ranges::find_if(plan.pictures, vision::has_scan_ending);
  const auto particles = std::ranges::find_if(plan.pictures, calibrate::is_positions_file);
  const bool has_scan = scan != plan.pictures.end();
  const bool has_particles = particles != plan.pictures.end();
  const PositionArguments& said = arguments.positions;
  for (const auto& [option, is_given, is_usable, what] :
       {std::tuple{"--unit", !said.unit.empty(), has_scan || has_particles,
                   "scans and files of particles"},
        std::tuple{"--ground-plane", !arguments.ground_plane.empty(), has_scan, "scans"},
        std::tuple{said.of_particles(), *said.of_particles() != 0, has_particles,
                   "files of particles"}}) {
    if (!is_given || is_usable) continue;
    plan.errors.push_back(
        fmt::format("{}: is for {}, and none is named. Fix: leave it out.", option, what));
  }
  if (!has_scan && !has_particles) return;
  const std::string other =
      has_scan ? scan->string() + " is a scan" : particles->string() + " is a file of particles";
  const ScaleArguments& scale = arguments.scale;
  for (const auto& [option, is_given] :
       {std::pair{"--exclude", !arguments.exclude.empty()},
        std::pair{"--rotate", !arguments.rotate.empty()},
        std::pair{"--heap", !arguments.heap.empty()}, std::pair{"--half", !arguments.half.empty()},
        std::pair{"--ground", !arguments.ground.empty()},
        std::pair{"--keep", !arguments.keep.empty()}, std::pair{"--drop", !arguments.drop.empty()},
        std::pair{"--mask", !arguments.mask_file.empty()},
        std::pair{"--save-hints", arguments.saves_hints},
        std::pair{"--pitch-deg", !arguments.pitch_deg.empty()},
        std::pair{"--camera-file", !scale.camera_file.empty()},
        std::pair{"--board", scale.finds_board}, std::pair{"--scale", !scale.scale.empty()},
        std::pair{"--method paper", has_scan && plan.options.method == vision::Method::paper},
        std::pair{"--definition",
                  has_scan && !base::is_usual_definition(plan.options.definition)}}) {
    if (!is_given) continue;
    plan.errors.push_back(fmt::format(
        "{}: is for pictures, and {}. Fix: leave it out, or measure pictures by themselves.",
        option, other));
  }
}

}  // namespace

MeasurePlan plan_measure(const MeasureArguments& arguments) {
  MeasurePlan plan;
  plan.fields = kMeasureFields;
  plan.options = read_measuring({.method = arguments.method,
                                 .window = arguments.window,
                                 .definition = arguments.definition,
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
  plan.pictures = files_in(
      plan.frames_per_s ? vision::list_with_frame_folders(arguments.pictures)
                        : vision::list_heap_files(with_positions_of_folders(arguments.pictures)),
      plan.errors, plan.notes);
  read_step(arguments, plan);
  read_scans_and_particles(arguments, plan);
  check_kinds_of_files(arguments, plan);
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

namespace {

constexpr const char* kMeasureNotes = R"(
PICTURE is a level side view: JPEG, HEIC, AVIF, PNG, TIFF, BMP or WebP; a film
of one by a camera that stands still: MP4, MOV, AVI, MKV, WebM or GIF; or a
three-dimensional scan: PLY, OBJ, STL or GLB. A folder stands for all pictures,
films and scans in it, except films that share a photo's name, as phones save
both at once, and pictures that share a scan's, which are its texture. A file of
particles, as simulation programs write them, is drawn from nine sides and
measured in these pictures; its angle is their mean. --json FILE and the like
may be - for standard output.

Scans: PLY, OBJ, STL and GLB of a heap with the ground around it, as surface or
as cloud of points, however it is turned. The ground is found, or --ground-plane
names three points of it. The angle is the mean over 72 azimuths of the flank's
angle, by the same fit as in pictures. --unit, what one unit of the file is,
gives height, base and the heap's own volume.

Films: the heap at rest is measured in the mean of the frames of the last second
in which nothing moves. A heap that still moves when the film ends is refused:
film on until 1 s after the last grain has stopped. --every 0.1 also measures
the frame nearest to each tenth of a second, for the angle over time; means and
the report are of heaps at rest alone.

Methods:
  auto   Segments the heap in several ways and keeps the most convincing
         silhouette. Finds the ground line; leaves out the crest and stray
         grains; fits a robust line to each side within the window, in which
         aprons (feet much flatter than the flank above) count little; the
         interval covers what counting them in full would change. Angles are
         measured from the ground line.
  paper  The method of the published hazelnut study: grey picture, Otsu
         threshold, holes filled, edge, ordinary least squares through each
         side's edge over the whole window, mean of the absolute slopes of
         the two sides.

Window: the part of each side that is fitted, as fractions of the heap's
height. Sides are concave at the toe and round at the crest, so the angle
depends on the window: always state it.

Definitions: --definition makes another one the number, with its own interval:
  flank_20_80          robust line at 20-80 % of the height (usual)
  height_over_base     from the crest to the foot (cone; ISO 4324)
  half_height_tangent  least-squares line at 40-60 %
  inner_window         least-squares line at 30-70 %
  outer_window         least-squares line at 10-90 %
  whole_flank          least-squares line from toe to crest
--definitions and the JSON list the angle by all of them.

Hints: if the heap is not found, mark where it is. --heap alone is often enough;
--ground is needed if the foot is hidden. Positions are in pixels from the
picture's top left corner, once --rotate has turned it. --save-hints saves them,
with --exclude, --pitch-deg and what gives millimetres, in PICTURE.repose.toml,
which is read whenever PICTURE is measured again. For a refused picture, hints
are tried and the best one is suggested.

Sizes: with a board (repose board) upright beside the heap and in the plane of
its middle, or with --scale of two points in that plane, heights and widths are
also in millimetres, with the volume of the cone. A camera file (repose camera)
corrects the lens's distortion before the picture is measured; with it the board
also gives the camera's pitch. Hints are in the pixels of the picture as it is,
overlays show the corrected one.

Uncertainties are half-widths of 95 % intervals. The mean of several pictures
includes all that could be measured, except flagged ones that are outliers; the
mean of those that are ok is given beside it. A flagged picture counts, but has
a warning to check; a refused one has a reason instead of an angle. Photographs
of one heap from several sides are one heap: with --group-by-name those whose
names differ only in a last number after _ or - count once, with their mean.
)";

}  // namespace

Command measure_command() {
  const auto given = std::make_shared<MeasureArguments>();
  Command command{
      .name = "measure",
      .summary = "Measure heaps in pictures, films and scans",
      .options =
          {{"pictures", "PICTURE|FOLDER ...", "Pictures, films, scans, particles", &given->pictures,
            true},
           {"--method", "auto|paper", "Method of measuring (auto)", &given->method},
           {"--window", "FROM,TO", "Fitted part of the height (0.2,0.8)", &given->window},
           {"--definition", "NAME", "Which angle it is (flank_20_80)", &given->definition},
           {"--exclude", "X,Y,W,H", "Box in pixels to ignore; repeatable", &given->exclude},
           {"--rotate", "90|180|270", "Turn clockwise until it is upright", &given->rotate},
           {"--heap", "X,Y,W,H", "Box in pixels around the heap", &given->heap},
           {"--half", "left|right", "Side of its one flank; a wall on the other", &given->half},
           {"--ground", "X1,Y1,X2,Y2", "Line that the heap stands on", &given->ground},
           {"--keep", "X,Y", "Point on the heap; repeatable", &given->keep},
           {"--drop", "X,Y", "Point off the heap; repeatable", &given->drop},
           {"--mask", "FILE", "Picture with the heap light, rest dark", &given->mask_file},
           {"--save-hints", "", "Save these hints beside each picture", &given->saves_hints},
           {"--pitch-deg", "DEGREES", "Camera's downward pitch (unknown)", &given->pitch_deg},
           {"--camera-file", "FILE.toml", "Camera whose lens distortion to correct",
            &given->scale.camera_file},
           {"--board", "", "Find the board of repose board: sizes in mm",
            &given->scale.finds_board},
           {"--square-mm", "MM", "Side of a printed square (24)", &given->scale.square_mm},
           {"--board-behind", "MM", "How far behind the heap's middle it is (0)",
            &given->scale.board_behind_mm},
           {"--scale", "X1,Y1,X2,Y2,MM", "Two points and their distance", &given->scale.scale},
           {"--ground-plane", "X,Y,Z,X,Y,Z,X,Y,Z", "Three points of a scan's ground",
            &given->ground_plane},
           {"--overlay", "FOLDER", "Folder for pictures with the measurement",
            &given->overlay_folder},
           {"--json", "FILE|-", "Full results, for programs", &given->json_file},
           {"--csv", "FILE|-", "One row per picture or frame", &given->csv_file},
           {"--summary", "FILE|-", "Mean and its interval, as JSON", &given->summary_file},
           {"--report", "FILE.html", "Report as a web page", &given->report_file},
           {"--group-by-name", "", "a_1.jpg and a_2.jpg are of one heap", &given->groups_by_name},
           {"--fps", "N", "Folders are films, their pictures the frames", &given->fps},
           {"--every", "SECONDS", "Of films: also frames so far apart", &given->every},
           {"--threads", "N", "Pictures in parallel (all cores)", &given->threads},
           {"--definitions", "", "Also show other definitions", &given->shows_definitions}},
      .notes = std::string(kMeasureNotes) + kPositionNotes,
      .missing = "no picture given. Fix: repose measure PICTURE, or a folder of pictures.",
      .run = [given] { return run_measure(*given); }};
  const auto more = position_options(given->positions);
  command.options.insert(command.options.end(), more.begin(), more.end());
  return command;
}

}  // namespace repose::cli
