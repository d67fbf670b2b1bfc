#include "cli/track/track_command.h"

#include <memory>

#include "cli/track/track.h"

namespace repose::cli {
namespace {

constexpr const char* kTrackNotes = R"(
VIDEO is a film of one grain from the side, by a camera that stands still: MP4,
MOV, AVI, MKV, WebM or GIF. With --fps it may be a folder of its frames, pictures
with numbers in their names. FILE may be - for standard output.

  drop   The grain falls on a level plate and bounces. Parabolas are fitted
         to its flights, all with one gravity, which is the ruler: the ratio
         of the speeds at an impact needs no scale.
  roll   The grain rolls down an incline and on along the flat until it lies
         still. Two straight lines are fitted to its path; the foot is where
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
board) upright beside the grain's way, in its plane, facing the camera. Without,
they follow from gravity and the frame rate, and are wrong where a film does not
play as fast as it was taken (slow motion).

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
