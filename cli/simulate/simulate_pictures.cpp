#include "cli/simulate/simulate_pictures.h"

#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "cli/common/progress.h"
#include "cli/simulate/simulate_saved.h"
#include "dem/state/state_file.h"
#include "render/renderer.h"
#include "render/scene/scene.h"

namespace repose::cli {
namespace {

render::Scene scene_of(const Run& run) {
  if (run.repeat.state) return render::scene_of(*run.repeat.state);
  return render::scene_of(dem::read_state(run.state_file));
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
    const calibrate::HeapViewSession session(scene_of(run), plan.views);
    HeapPictures& pictures = run.pictures.emplace();
    pictures.views.resize(views);
    if (!plan.out_folder.empty()) {
      pictures.overlay_file = place_of(plan, run.repeat.seed).string() + ".overlay.png";
    }
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, views, [&](std::size_t view) {
        if (is_interrupted) return;
        pictures.views[view] = session.measure(renderers.local(), static_cast<int>(view),
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
  } catch (const std::runtime_error& error) {
    for (Run& run : runs) {
      run.pictures = HeapPictures{.views = {}, .overlay_file = {}, .error = error.what()};
    }
  }
}

}  // namespace repose::cli
