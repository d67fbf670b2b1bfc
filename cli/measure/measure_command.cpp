#include "cli/measure/measure_command.h"

#include <memory>

#include "cli/measure/measure.h"

namespace repose::cli {
namespace {

constexpr const char* kNotes = R"(
PICTURE is a level side view: JPEG, PNG, TIFF, BMP or WebP. A folder stands
for the pictures in it. FILE may be - for standard output.

Methods:
  auto   Segments the heap in several ways and takes the most convincing
         silhouette. Finds the ground line; leaves out thin aprons at the
         toe, the crest, and stray grains; fits a robust line to each side
         within the window. Angles are measured from the ground line.
  paper  The method of the published hazelnut study: grey picture, Otsu
         threshold, holes filled, edge, ordinary least squares through each
         side's edge over the whole window, mean of the absolute slopes of
         the two sides.

Window: the part of each side that is fitted, as fractions of the heap's
height. Sides are concave at the toe and round at the crest, so the angle
depends on the window: always state it. Other definitions (height over base,
tangent at half height, whole flank, other windows) are listed by
--definitions and in the JSON.

Hints: where the heap is not found, say where it is. --heap alone often is
enough; --ground is needed where the foot is not seen. Positions are in pixels
from the picture's top left corner. --save-hints writes them, with --exclude
and --pitch-deg, into PICTURE.repose.toml, which is read whenever PICTURE is
measured again. What a refused picture needs is tried and proposed.

Uncertainties are half-widths of 95 % intervals. The mean of several pictures
is over all that could be measured. A flagged picture counts in it, and has a
warning to be checked by a person; a refused one has a reason instead of an
angle.
)";

}  // namespace

Command measure_command() {
  const auto given = std::make_shared<MeasureArguments>();
  return {.name = "measure",
          .summary = "Measure heaps in pictures",
          .options =
              {{"pictures", "PICTURE|FOLDER ...", "Pictures, or folders of pictures",
                &given->pictures, true},
               {"--method", "auto|paper", "How to measure (auto)", &given->method},
               {"--window", "FROM,TO", "Part of the height (0.2,0.8)", &given->window},
               {"--exclude", "X,Y,W,H", "Box in pixels to leave out; repeatable", &given->exclude},
               {"--heap", "X,Y,W,H", "Box in pixels around the heap", &given->heap},
               {"--ground", "X1,Y1,X2,Y2", "Line that the heap stands on", &given->ground},
               {"--keep", "X,Y", "Place on the heap; repeatable", &given->keep},
               {"--drop", "X,Y", "Place beside the heap; repeatable", &given->drop},
               {"--mask", "FILE", "Picture: heap light, rest dark", &given->mask_file},
               {"--save-hints", "", "Keep these beside each picture", &given->saves_hints},
               {"--pitch-deg", "DEGREES", "Camera's downward pitch (unknown)", &given->pitch_deg},
               {"--overlay", "FOLDER", "Draw what was measured", &given->overlay_folder},
               {"--json", "FILE|-", "All results, for programs", &given->json_file},
               {"--csv", "FILE|-", "A row for each picture", &given->csv_file},
               {"--summary", "FILE|-", "Mean and interval, as JSON", &given->summary_file},
               {"--report", "FILE.html", "All results as a web page", &given->report_file},
               {"--threads", "N", "Pictures at a time (all cores)", &given->threads},
               {"--definitions", "", "Show other definitions too", &given->shows_definitions}},
          .notes = kNotes,
          .missing = "no picture is named. Fix: repose measure PICTURE, or a folder of pictures.",
          .run = [given] { return run_measure(*given); }};
}

}  // namespace repose::cli
