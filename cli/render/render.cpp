#include "cli/render/render.h"

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/particles/positions_angle.h"
#include "cli/common/output.h"
#include "cli/common/terminal.h"
#include "cli/render/render_options.h"
#include "dem/state/state_file.h"
#include "render/model_file.h"
#include "render/renderer.h"
#include "render/run/filmed_run.h"
#include "render/truth.h"
#include "vision/picture/picture.h"
#include "vision/video/film_writer.h"

namespace repose::cli {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

Json vector_mm(const dem::Vector& vector_m) {
  return {kMmPerM * vector_m.x(), kMmPerM * vector_m.y(), kMmPerM * vector_m.z()};
}

Json camera_json(const render::Camera& camera) {
  if (const auto* level = std::get_if<render::OrthographicCamera>(&camera)) {
    return {{"kind", "orthographic"}, {"azimuth_deg", level->azimuth_rad * kDegreesPerRadian}};
  }
  const auto& lens = std::get<render::PerspectiveCamera>(camera);
  return {{"kind", "perspective"},
          {"position_mm", vector_mm(lens.position_m)},
          {"azimuth_deg", lens.azimuth_rad * kDegreesPerRadian},
          {"pitch_deg", lens.pitch_rad * kDegreesPerRadian},
          {"roll_deg", lens.roll_rad * kDegreesPerRadian},
          {"focal_mm", lens.focal_mm},
          {"k1", lens.k1},
          {"k2", lens.k2}};
}

Json ends(const std::optional<vision::Segment>& line) {
  if (!line) return nullptr;
  return {line->from.x, line->from.y, line->to.x, line->to.y};
}

/// The exact ground truth of a picture, for programs.
std::string truth_json(const render::Truth& truth) {
  Json outline = Json::array();
  for (const vision::Point& point : truth.outline) outline.push_back({point.x, point.y});
  const Json json{{"width_px", truth.size.width},        {"height_px", truth.size.height},
                  {"camera", camera_json(truth.camera)}, {"mm_per_px", truth.mm_per_px},
                  {"ground_px", ends(truth.ground)},     {"outline_px", outline}};
  return json.dump() + '\n';
}

/// The same for a film.
std::string film_truth_json(const render::FilmTruth& truth) {
  Json frames = Json::array();
  for (const render::FilmTruth::Frame& frame : truth.frames) {
    Json places_mm = Json::array(), places_px = Json::array();
    for (const render::GrainPlace& grain : frame.grains) {
      places_mm.push_back(vector_mm(grain.position_m));
      places_px.push_back({grain.picture.x, grain.picture.y});
    }
    frames.push_back({{"time_s", frame.run_s}, {"grains_mm", places_mm}, {"grains_px", places_px}});
  }
  const vision::Segment& scale = truth.scale;
  const Json json{{"width_px", truth.size.width},
                  {"height_px", truth.size.height},
                  {"camera", camera_json(truth.camera)},
                  {"frames_per_s", truth.frames_per_s},
                  {"exposure_ms", kMsPerS * truth.exposure_s},
                  {"mm_per_px", truth.mm_per_px},
                  {"scale", {scale.from.x, scale.from.y, scale.to.x, scale.to.y, truth.scale_mm}},
                  {"frames", frames}};
  return json.dump() + '\n';
}

/// Frame rate at which a film with a frame for each state plays in real time.
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

/// Draws the film of a run, and writes its ground truth if requested.
/// @throws base::InputError  the trajectory cannot be read, or a file cannot be written.
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

/// The scene of a state, or of any program's particles; prints how these were interpreted.
render::Scene scene_in(const RenderArguments& arguments, const RenderPlan& plan) {
  calibrate::PositionsFile file = calibrate::read_positions(arguments.state, plan.positions);
  if (!file.heap.has_unit) {
    throw base::InputError({.where = arguments.state,
                            .value = "does not say in which unit its lengths are",
                            .rule = "cameras and scales are in millimetres",
                            .fix = "say it: " + base::field("particles' unit") + " mm."});
  }
  if (!file.is_state()) print_line(fmt::format("{}: {}", arguments.state, file.text()));
  return std::move(file.heap.scene);
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
  const render::Scene scene = scene_in(arguments, plan);
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
