#include "cli/simulate_pictures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "cli/progress.h"
#include "cli/simulate_kept.h"
#include "dem/experiment/placing.h"
#include "dem/state/state_file.h"
#include "render/camera.h"
#include "render/renderer.h"
#include "render/scene.h"
#include "render/style.h"
#include "vision/overlay.h"
#include "vision/picture.h"

namespace repose::cli {
namespace {

/// A heap, and how all pictures of it are taken.
struct Sitting {
  render::Scene scene;
  render::OrthographicCamera camera;
  render::PictureSize size;
};

render::Scene scene_of(const Run& run) {
  if (run.repeat.state) return render::scene_of(*run.repeat.state);
  return render::scene_of(dem::read_state(run.state_file));
}

/// All grains fit in from every side, with bare ground beside them. More pixels to a grain than
/// these are not looked at by what measures, and take time to draw.
Sitting sitting_of(render::Scene scene) {
  constexpr double kGrain_px = 40;
  constexpr render::PictureSize kLargest{.width = 1920, .height = 1080};
  Sitting sitting{.scene = std::move(scene), .camera = {}, .size = kLargest};
  sitting.camera = render::fitted_all_around({}, sitting.scene, kLargest);
  const double fitting = *sitting.camera.mm_per_px;
  const double grain_mm = 1e3 * dem::diameter_m(sitting.scene.shapes.front());
  const double mm_per_px = std::max(fitting, grain_mm / kGrain_px);
  const auto reduced = [&](int pixels) {
    return static_cast<int>(std::ceil(pixels * fitting / mm_per_px));
  };
  sitting.camera.mm_per_px = mm_per_px;
  sitting.size = {.width = reduced(kLargest.width), .height = reduced(kLargest.height)};
  return sitting;
}

/// Draws one view and measures it; keeps it with what was measured where `overlay_file` is given.
HeapView taken(render::Renderer& renderer, const Sitting& sitting, double azimuth_rad,
               const std::filesystem::path& overlay_file) {
  render::OrthographicCamera camera = sitting.camera;
  camera.azimuth_rad = azimuth_rad;
  const vision::Picture picture =
      renderer.draw(sitting.scene, camera, sitting.size, render::SilhouetteStyle{}).picture;
  const vision::ReposeAngle angle = vision::measure_repose_angle(picture);
  if (!overlay_file.empty()) {
    const vision::OverlayNotes notes{.title = overlay_file.filename().string(), .excluded = {}};
    vision::write_picture(overlay_file, vision::draw_overlay(picture, angle, notes));
  }
  return {.azimuth_rad = azimuth_rad, .status = angle.status, .angle_rad = angle.angle_rad};
}

void take_all(const SimulatePlan& plan, std::vector<Run>& runs,
              const std::atomic<bool>& is_interrupted) {
  const auto views = static_cast<std::size_t>(plan.views);
  // Contexts are costly to make, and each belongs to one thread.
  tbb::enumerable_thread_specific<render::Renderer> renderers;
  Progress progress(runs.size() * views);
  tbb::task_arena arena(plan.threads);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    Run& run = runs[k];
    const Sitting sitting = sitting_of(scene_of(run));
    HeapPictures& pictures = run.pictures.emplace();
    pictures.views.resize(views);
    if (!plan.out_folder.empty()) {
      pictures.overlay_file = place_of(plan, run.repeat.seed).string() + ".overlay.png";
    }
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, views, [&](std::size_t view) {
        if (is_interrupted) return;
        const double turn = std::numbers::pi * static_cast<double>(view) / plan.views;
        pictures.views[view] = taken(renderers.local(), sitting, turn,
                                     view == 0 ? pictures.overlay_file : std::string());
        progress.advance();
      });
    });
    run.repeat.state.reset();
  }
}

}  // namespace

void take_pictures(const SimulatePlan& plan, std::vector<Run>& runs,
                   const std::atomic<bool>& is_interrupted) {
  if (plan.views == 0) return;
  try {
    take_all(plan, runs, is_interrupted);
  } catch (const std::runtime_error& fault) {
    for (Run& run : runs) {
      run.pictures = HeapPictures{.views = {}, .overlay_file = {}, .fault = fault.what()};
    }
  }
}

}  // namespace repose::cli
