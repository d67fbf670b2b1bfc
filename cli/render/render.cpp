#include "cli/render/render.h"

#include <cstdint>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "cli/common/output.h"
#include "cli/common/progress.h"
#include "cli/render/render_json.h"
#include "cli/render/render_options.h"
#include "cli/render/render_run.h"
#include "dem/state/state_file.h"
#include "render/model_file.h"
#include "render/renderer.h"
#include "render/truth.h"
#include "vision/picture/picture.h"
#include "vision/video/film_writer.h"

namespace repose::cli {
namespace {

constexpr double kFramesPerSecond = 24;
constexpr const char* kDrawn = "drew";

render::Shown shown_in(const render::Style& style) {
  return std::visit([](const auto& any) { return any.shown; }, style);
}

vision::Picture mask_picture(const render::PictureSize& size,
                             const std::vector<std::uint8_t>& mask) {
  vision::Picture picture{.width = size.width, .height = size.height, .bgr = {}};
  picture.bgr.reserve(3 * mask.size());
  for (const std::uint8_t value : mask) picture.bgr.insert(picture.bgr.end(), 3, value);
  return picture;
}

void render_picture(const RenderArguments& arguments, const RenderPlan& plan,
                    const render::Scene& scene) {
  const render::Camera camera = camera_of(plan, scene);
  render::Renderer renderer;
  const render::Rendered rendered = renderer.draw(scene, camera, plan.size, plan.style);
  vision::write_picture(arguments.out_file, rendered.picture);
  if (!arguments.mask_file.empty()) {
    vision::write_picture(arguments.mask_file, mask_picture(plan.size, rendered.grain_mask));
  }
  if (!arguments.truth_file.empty()) {
    const render::Truth truth = render::truth_of(scene, camera, plan.size, shown_in(plan.style));
    Outputs outputs;
    outputs.add(arguments.truth_file, truth_json(truth));
    outputs.write();
  }
}

void render_turntable(const RenderArguments& arguments, const RenderPlan& plan,
                      const render::Scene& scene) {
  render::Renderer renderer;
  vision::FilmWriter film(arguments.out_file, kFramesPerSecond);
  RenderPlan turned = plan;
  turned.level = render::fitted_all_around(plan.level, scene, plan.size);
  Progress progress(static_cast<std::size_t>(plan.turntable_frames), kDrawn);
  for (int k = 0; k < plan.turntable_frames; ++k) {
    const double turn = 2 * std::numbers::pi * k / plan.turntable_frames;
    turned.level.azimuth_rad = plan.level.azimuth_rad + turn;
    if (turned.lens) turned.lens->stand.azimuth_rad = turned.level.azimuth_rad;
    film.add(renderer.draw(scene, camera_of(turned, scene), plan.size, plan.style).picture);
    progress.advance();
  }
  film.close();
}

}  // namespace

ExitCode run_render(const RenderArguments& arguments) {
  const RenderPlan plan = plan_render(arguments);
  print_lines(plan.errors);
  if (!plan.errors.empty()) return ExitCode::bad_input;
  if (plan.is_series) {
    render_run_film(arguments, plan);
    return ExitCode::done;
  }
  const render::Scene scene = render::scene_of(dem::read_state(arguments.state));
  switch (plan.output) {
    case RenderOutput::picture:
      render_picture(arguments, plan, scene);
      break;
    case RenderOutput::model: {
      const auto content = render::glb_of(scene, shown_in(plan.style));
      Outputs outputs;
      outputs.add(arguments.out_file,
                  {reinterpret_cast<const char*>(content.data()), content.size()});
      outputs.write();
      break;
    }
    case RenderOutput::film:
      render_turntable(arguments, plan, scene);
      break;
  }
  return ExitCode::done;
}

}  // namespace repose::cli
