#include "cli/camera/camera_command.h"

#include <memory>

#include "cli/camera/camera.h"

namespace repose::cli {
namespace {

constexpr const char* kCameraNotes = R"(
PICTURE shows the board of repose board; a folder stands for all pictures in it.
Take ten or more with the zoom and focus that the heaps are photographed with:
the board filling half of the picture or more, sharp, in the middle and in every
corner, turned by 20 to 40 degrees to the left, right, up and down.

Fitted are one focal length, the place of the lens's axis, and of the distortion
(Brown-Conrady, as in OpenCV) only as many coefficients as the pictures support.
Uncertainties are half-widths of 95 % intervals.

Refused, with the reason: fewer than 5 pictures with the board, pictures of
different sizes, boards that all face the same way or cover too little of the
picture, corners too far from the fit, a focal length that stays uncertain.

The camera file is for repose measure --camera-file, which then corrects the
lens's distortion. It holds for whole pictures of any size from this camera.

Examples:
  repose camera board_photos --out camera.toml
  repose measure heap.jpg --board --camera-file camera.toml
)";

}  // namespace

Command camera_command() {
  const auto given = std::make_shared<CameraArguments>();
  return {.name = "camera",
          .summary = "Find a camera's lens from pictures of the board",
          .options = {{"pictures", "PICTURE|FOLDER ...",
                       "Pictures of the board, or folders of them", &given->pictures, true},
                      {"--out", "FILE.toml", "Camera file to write", &given->out_file},
                      {"--square-mm", "MM", "Side of a printed square (24)", &given->square_mm},
                      {"--json", "FILE|-", "Full results, for programs", &given->json_file},
                      {"--threads", "N", "Pictures in parallel (all cores)", &given->threads}},
          .notes = kCameraNotes,
          .missing = "no picture given. Fix: repose camera PICTURE ..., or a folder of pictures.",
          .run = [given] { return run_camera(*given); }};
}

}  // namespace repose::cli
