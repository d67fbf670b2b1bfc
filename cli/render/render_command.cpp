#include "cli/render/render_command.h"

#include <memory>

#include "cli/render/render.h"
#include "cli/render/render_options.h"

namespace repose::cli {
namespace {

constexpr const char* kRenderNotes = R"(
STATE is a .vtp file written by repose simulate --out or, for a film, the
trajectory.pvd of a run.

Styles:
  silhouette  Black grains on white, every pixel one or the other.
  photo       As a camera in a laboratory sees it: soft light, shadows, a plate
              before a backdrop, depth of field, noise.

Without --camera the view is orthographic. With it, a lens on a stand is used:
distance_mm from the centre of the grains, height_mm above the ground, focal_mm
for a 36 mm wide sensor, pitch_deg (down), roll_deg, k1 and k2 (distortion).
By default the camera is level and all grains fit.

--truth: camera, mm per pixel, the ground line and the heap's upper edge, in
pixels from the top left corner; of a film with --fps the scale for repose track
and where the grains are in each frame.

Without --fps a film has a frame for each state of the trajectory. With it, it
plays as fast as the run went, states in between are computed, and the bench is
cut to the length of the grains' way. Simulate with a --trajectory-s of 0.001.

Examples:
  repose render heaps/heap_seed_1.vtp --out heap.png
  repose render heap.vtp --style photo --camera distance_mm=1500 --out heap.jpg
  repose render heap.vtp --turntable 72 --out heap.mp4
  repose render heap.vtp --out heap.glb
  repose render runs/drop_seed_1/trajectory.pvd --fps 60 --exposure-ms 4
    --hold-s 0.4 --style photo --size 640,480 --out drop.mp4
)";

}  // namespace

Command render_command() {
  const auto given = std::make_shared<RenderArguments>();
  return {
      .name = "render",
      .summary = "Render a simulated state",
      .options = {{"state", "STATE", "State (.vtp), or trajectory.pvd", &given->state, true},
                  {"--view", "xz|DEGREES", "Viewing direction (xz)", &given->view},
                  {"--style", "silhouette|photo", "Appearance (silhouette)", &given->style},
                  {"--size", "W,H", "Size in pixels (1920,1080)", &given->size},
                  {"--mm-per-px", "MM", "Scale (such that all grains fit)", &given->mm_per_px},
                  {"--camera", "KEY=NUMBER,...", "Perspective camera; keys below", &given->camera},
                  {"--show", "mesh|spheres|both", "How grains are shown (mesh)", &given->show},
                  {"--seed", "N", "For a photo's textures and noise (1)", &given->seed},
                  {"--passes", "N", "Photo: more for smoother shadows (24)", &given->passes},
                  {"--study", "STUDY.toml", "Photo: take the grains' colour from it",
                   &given->study},
                  {"--noise", "PART", "Photo: the sensor's, of full light (0.008)", &given->noise},
                  {"--mask", "FILE.png", "Mask: grains white, all else black", &given->mask_file},
                  {"--truth", "FILE.json", "Exact geometry of the picture", &given->truth_file},
                  {"--turntable", "FRAMES", "Film of one turn around the heap", &given->turntable},
                  {"--fps", "N", "Film of a run: frames per second, in real time", &given->fps},
                  {"--exposure-ms", "MS", "With --fps, photo: exposure of a frame (0)",
                   &given->exposure_ms},
                  {"--hold-s", "S", "With --fps: show its ends so much longer (0)", &given->hold_s},
                  {"--out", "FILE", "Picture .png .jpg, model .glb, film .mp4 .gif",
                   &given->out_file}},
      .notes = kRenderNotes,
      .missing = "no state given. Fix: repose render STATE.vtp --out heap.png.",
      .fields = kRenderFields,
      .run = [given] { return run_render(*given); }};
}

}  // namespace repose::cli
