#include "cli/compare/compare_command.h"

#include <memory>

#include "cli/compare/compare.h"

namespace repose::cli {
namespace {

constexpr const char* kCompareNotes = R"(
Each picture is a level side view of one heap: a photograph or a rendered
silhouette. Both are measured as by repose measure, rotated until their ground
is level, and aligned by axis and ground line. The axis is the middle of the
silhouette between 20 and 80 % of its height; where a side is missing, the
crests are aligned instead. All differences are the first minus the second.

Verdict on the angles, from the 95 % interval of their difference:
  equivalent   the interval lies within the margin
  different    it does not, and it excludes 0
  cannot tell  otherwise
The verdict on two pictures is about these two heaps. Heaps of the same grains
differ too: give folders instead of pictures to compare sets of heaps by their
means, which is a verdict on the grains. A folder contains photographs, one per
heap (with --group-by-name those whose names differ in a last number after _ or
- alone are of one heap, which has their mean), or simulated heaps, as written
by repose simulate heap --out and repose calibrate --out; a .vtp file is one
such heap. Its pictures are drawn as from far away. A level camera that stands
three widths from the heap reads some .8 degrees less, for the nuts of the
sample: --camera-mm says where the photographs were taken from, by the lens's
distance from the heap's middle and its height
above the ground, so that both sets are seen alike.

Scale: mm per pixel, or the known width of the base. One value applies to both
pictures, A,B to one each. A scale that repose measure --save-hints has saved
beside both pictures is used if none is given. Without a scale only shapes are
compared, and lengths are relative to the square root of a silhouette's area.
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
           {"--mm-per-px", "A[,B]", "Scale: millimetres per pixel", &given->mm_per_px},
           {"--base-mm", "A[,B]", "Scale: known width of the base", &given->base_mm},
           {"--grain-mm", "D", "Grain size, for lengths in grains", &given->grain_mm},
           {"--margin-deg", "DEGREES", "Negligible difference (2)", &given->margin_deg},
           {"--camera-mm", "DISTANCE,HEIGHT", "Camera before simulated heaps (far away)",
            &given->camera_mm},
           {"--method", "auto|paper", "Method of measuring (auto)", &given->method},
           {"--window", "FROM,TO", "Fitted part of the height (0.2,0.8)", &given->window},
           {"--pitch-deg", "A[,B]", "Cameras' downward pitch (unknown)", &given->pitch_deg},
           {"--exclude-first", "X,Y,W,H", "Box to ignore; repeatable", &given->exclude_first},
           {"--exclude-second", "X,Y,W,H", "Box to ignore; repeatable", &given->exclude_second},
           {"--group-by-name", "", "a_1.jpg and a_2.jpg are of one heap", &given->groups_by_name},
           {"--overlay", "FILE.png", "Draw both outlines", &given->overlay_file},
           {"--json", "FILE|-", "Full results, for programs", &given->json_file}},
      .notes = kCompareNotes,
      .missing =
          "two pictures or folders are needed. Fix: repose compare photo.jpg render.png, or repose "
          "compare photos heaps.",
      .run = [given] { return run_compare(*given); }};
}

}  // namespace repose::cli
