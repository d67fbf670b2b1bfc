#include "cli/compare/compare_command.h"

#include <memory>

#include "cli/compare/compare.h"

namespace repose::cli {
namespace {

constexpr const char* kNotes = R"(
Each PICTURE is a level side view of one heap: a photograph or a rendered
silhouette. Both are measured as repose measure does, rotated until
their ground is level, and laid over each other: axis on axis, ground on
ground. The axis is the middle of the silhouette between 20 and 80 % of its
height; where a side is missing, the crests are aligned instead. All
differences are the first minus the second.

Verdict on the angles, from the 95 % interval of their difference:
  equivalent   the interval lies within the margin
  different    it does not, and it excludes 0
  cannot tell  otherwise
The verdict on two pictures is about these two heaps. Heaps of the same
grains differ, too: name a folder instead of a picture, and sets of heaps are
compared by their means, which is a verdict on the grains. A folder is of
photographs, one for each heap, or of simulated heaps, as repose simulate heap
--out and repose calibrate --out write them; a .vtp file is one such heap.

Scale: mm per pixel, or the known width of the base. One value is for both
pictures, A,B is one for each. Without a scale only shapes are compared, and
lengths are relative to the square root of a silhouette's area.
)";

}  // namespace

Command compare_command() {
  const auto given = std::make_shared<CompareArguments>();
  constexpr int kPictures = 2;
  return {
      .name = "compare",
      .summary = "Compare two heaps, or two sets of heaps",
      .options =
          {{"heaps", "HEAPS HEAPS", "Two pictures, or folders of heaps", &given->pictures, true,
            kPictures},
           {"--mm-per-px", "A[,B]", "Scale: mm per pixel", &given->mm_per_px},
           {"--base-mm", "A[,B]", "Scale: known width of the base", &given->base_mm},
           {"--grain-mm", "D", "Grain size, for lengths in grains", &given->grain_mm},
           {"--margin-deg", "DEGREES", "Difference that does not matter (2)", &given->margin_deg},
           {"--method", "auto|paper", "How to measure (auto)", &given->method},
           {"--window", "FROM,TO", "Part of the height (0.2,0.8)", &given->window},
           {"--pitch-deg", "A[,B]", "Cameras' downward pitch (unknown)", &given->pitch_deg},
           {"--exclude-first", "X,Y,W,H", "Box to leave out; repeatable", &given->exclude_first},
           {"--exclude-second", "X,Y,W,H", "Box to leave out; repeatable", &given->exclude_second},
           {"--overlay", "FILE.png", "Draw both outlines", &given->overlay_file},
           {"--json", "FILE|-", "All results, for programs", &given->json_file}},
      .notes = kNotes,
      .missing =
          "two pictures or folders are needed. Fix: repose compare photo.jpg render.png, or repose "
          "compare photos heaps.",
      .run = [given] { return run_compare(*given); }};
}

}  // namespace repose::cli
