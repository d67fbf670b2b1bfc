#include "cli/render/render_run.h"

#include <algorithm>
#include <vector>

#include "cli/common/output.h"
#include "cli/common/progress.h"
#include "cli/render/render_json.h"
#include "dem/state/state_file.h"
#include "dem/state/trajectory.h"
#include "render/renderer.h"
#include "render/run/film_truth.h"
#include "render/run/filmed_run.h"
#include "vision/video/film_writer.h"

namespace repose::cli {
namespace {

/// So that a film with a frame for each state plays as fast as the run went.
double frames_per_s(const std::vector<double>& times_s) {
  constexpr double kSlowest = 1, kFastest = 60;
  const double lasted_s = times_s.back() - times_s.front();
  const auto intervals = static_cast<double>(times_s.size() - 1);
  return lasted_s > 0 ? std::clamp(intervals / lasted_s, kSlowest, kFastest) : kSlowest;
}

render::RunStates states_of(const std::string& trajectory) {
  const auto frames = dem::read_trajectory(trajectory);
  render::RunStates states;
  for (const dem::TrajectoryFrame& frame : frames) states.times_s.push_back(frame.time_s);
  states.scene = [frames](std::size_t number) {
    return render::scene_of(dem::read_state(frames[number].file));
  };
  return states;
}

vision::Picture picture_of(render::FilmedRun& run, int frame, const render::Camera& camera,
                           const RenderPlan& plan, render::Renderer& renderer) {
  if (const auto* photo = std::get_if<render::PhotoStyle>(&plan.style)) {
    render::PhotoStyle style = *photo;
    style.frame = static_cast<std::uint64_t>(frame);
    const bool is_blurred = plan.shutter && plan.shutter->exposure_s > 0;
    return renderer.expose(run.moments(frame, is_blurred ? style.passes : 1), camera, plan.size,
                           style);
  }
  return renderer.draw(run.scene_at(run.time_s(frame)), camera, plan.size, plan.style).picture;
}

}  // namespace

void render_run_film(const RenderArguments& arguments, const RenderPlan& plan) {
  render::RunStates states = states_of(arguments.state);
  const std::vector<double> times_s = states.times_s;
  const double rate = plan.shutter ? plan.shutter->frames_per_s : frames_per_s(times_s);
  render::FilmedRun run(std::move(states),
                        plan.shutter.value_or(render::Shutter{.frames_per_s = rate}));
  const render::Camera camera = camera_of(plan, run.first());
  render::Renderer renderer;
  vision::FilmWriter film(arguments.out_file, rate);
  // Without a shutter each state is a frame.
  const int frames = plan.shutter ? run.frames() : static_cast<int>(times_s.size());
  Progress progress(static_cast<std::size_t>(frames), "drew");
  for (int frame = 0; frame < frames; ++frame) {
    film.add(picture_of(run, frame, camera, plan, renderer));
    progress.advance();
  }
  film.close();
  if (arguments.truth_file.empty()) return;
  Outputs outputs;
  outputs.add(arguments.truth_file, film_truth_json(render::film_truth_of(run, camera, plan.size)));
  outputs.write();
}

}  // namespace repose::cli
