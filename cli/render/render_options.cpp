#include "cli/render/render_options.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/units.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "cli/render/render.h"
#include "dem/study/study.h"
#include "vision/picture/made_here.h"

namespace repose::cli {

namespace {

void read_view(const std::string& text, RenderPlan& plan) {
  if (text == "xz") return;
  const auto azimuth_rad = read_angle({"--view", text, plan.errors},
                                      "xz, or an azimuth: --view 90 looks at the heap from its "
                                      "right");
  plan.level.azimuth_rad = azimuth_rad.value_or(plan.level.azimuth_rad);
}

/// From the study; std::nullopt if it is not stated, or if there is no study.
std::optional<render::Colour> grain_colour(const RenderArguments& arguments, RenderPlan& plan) {
  if (arguments.study.empty()) return std::nullopt;
  try {
    return dem::read_study_copy(arguments.study).grain_colour;
  } catch (const base::InputError& error) {
    add_faults(error, plan.errors);
    return std::nullopt;
  }
}

void read_photo(const RenderArguments& arguments, render::PhotoStyle& photo, RenderPlan& plan) {
  photo.seed = read_seed({"--seed", arguments.seed, plan.errors}).value_or(photo.seed);
  photo.passes = read_whole_number({"--passes", arguments.passes, plan.errors}, 1,
                                   render::kMaxPasses, fmt::format("{} is usual", photo.passes))
                     .value_or(photo.passes);
  photo.noise = read_number_within({"--noise", arguments.noise, plan.errors}, 0, 1,
                                   fmt::format("{:g} is usual", photo.noise))
                    .value_or(photo.noise);
}

void read_style(const RenderArguments& arguments, RenderPlan& plan) {
  enum class Kind { silhouette, photo };
  const auto shown = read_choice<render::Shown>({"--show", arguments.show, plan.errors},
                                                {{"mesh", render::Shown::mesh},
                                                 {"spheres", render::Shown::spheres},
                                                 {"both", render::Shown::both}})
                         .value_or(render::Shown::mesh);
  const auto kind = read_choice<Kind>({"--style", arguments.style, plan.errors},
                                      {{"silhouette", Kind::silhouette}, {"photo", Kind::photo}});
  if (kind == Kind::photo) {
    render::PhotoStyle photo = render::photo_of_grains(grain_colour(arguments, plan));
    photo.shown = shown;
    read_photo(arguments, photo, plan);
    plan.style = photo;
    return;
  }
  plan.style = render::SilhouetteStyle{.shown = shown};
  for (const auto& [option, text] :
       {std::pair{"--seed", &arguments.seed}, std::pair{"--passes", &arguments.passes},
        std::pair{"--study", &arguments.study}, std::pair{"--noise", &arguments.noise},
        std::pair{"--exposure-ms", &arguments.exposure_ms}}) {
    if (text->empty() || (!kind && !arguments.style.empty())) continue;
    plan.errors.push_back(
        fmt::format("{}: a silhouette has neither noise nor shadows nor colours. Fix: --style "
                    "photo, or leave it out.",
                    option));
  }
}

/// Reads one KEY=VALUE of --camera; false if the key is unknown or has no number.
bool read_camera_part(std::string_view part, LensPlan& lens) {
  const std::size_t equals = part.find('=');
  if (equals == std::string_view::npos) return false;
  const std::string_view key = part.substr(0, equals);
  const auto value = parse_number<double>(part.substr(equals + 1));
  if (!value) return false;
  if (key == "distance_mm") {
    lens.stand.distance_m = *value / kMmPerM;
  } else if (key == "height_mm") {
    lens.stand.height_m = *value / kMmPerM;
  } else if (key == "focal_mm") {
    lens.stand.focal_mm = value;
  } else if (key == "pitch_deg") {
    lens.stand.pitch_rad = *value * kDegree;
  } else if (key == "roll_deg") {
    lens.roll_rad = *value * kDegree;
  } else if (key == "k1") {
    lens.k1 = *value;
  } else if (key == "k2") {
    lens.k2 = *value;
  } else {
    return false;
  }
  return true;
}

void read_camera(const RenderArguments& arguments, RenderPlan& plan) {
  if (arguments.camera.empty()) return;
  LensPlan lens;
  lens.stand.azimuth_rad = plan.level.azimuth_rad;
  std::string_view rest = arguments.camera;
  while (!rest.empty()) {
    const std::string_view part = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), part.size() + 1));
    if (read_camera_part(part, lens)) continue;
    plan.errors.push_back(fmt::format(
        "--camera {}: must be KEY=NUMBER; keys: distance_mm, height_mm, focal_mm, pitch_deg, "
        "roll_deg, k1, k2. Fix: --camera distance_mm=1500,pitch_deg=3.",
        part));
  }
  if (plan.level.mm_per_px) {
    plan.errors.emplace_back(
        "--mm-per-px: a lens has another scale at each distance. Fix: leave it out, or choose "
        "focal_mm and distance_mm of --camera.");
  }
  plan.lens = lens;
}

void read_turntable(const RenderArguments& arguments, RenderPlan& plan) {
  constexpr int kMaxFrames = 10'000;
  const auto frames = read_whole_number({"--turntable", arguments.turntable, plan.errors}, 1,
                                        kMaxFrames, "72 is one frame every 5 degrees");
  if (!frames) return;
  plan.turntable_frames = *frames;
  if (plan.is_series) {
    plan.errors.push_back(fmt::format(
        "--turntable: {} is a film already. Fix: leave it out, or name one of its .vtp files.",
        arguments.state));
  }
}

/// Options for filming a trajectory in real time.
void read_shutter(const RenderArguments& arguments, RenderPlan& plan) {
  constexpr double kMaxPerS = 10'000, kLongest_s = 60;
  const auto fps =
      read_positive({"--fps", arguments.fps, plan.errors}, "a number of frames per second", "60");
  const auto exposure_ms = read_number_within({"--exposure-ms", arguments.exposure_ms, plan.errors},
                                              0, kMsPerS, "--exposure-ms 4");
  const auto hold_s = read_number_within({"--hold-s", arguments.hold_s, plan.errors}, 0, kLongest_s,
                                         "--hold-s 0.5");
  if (fps && *fps > kMaxPerS) {
    plan.errors.push_back(
        fmt::format("--fps {}: must be at most {:g}. Fix: --fps 60.", arguments.fps, kMaxPerS));
  }
  for (const auto& [option, text] :
       {std::pair{"--fps", &arguments.fps}, std::pair{"--exposure-ms", &arguments.exposure_ms},
        std::pair{"--hold-s", &arguments.hold_s}}) {
    if (text->empty()) continue;
    if (!plan.is_series) {
      plan.errors.push_back(fmt::format(
          "{}: is for a film of a run. Fix: leave it out, or name a trajectory.pvd.", option));
    } else if (arguments.fps.empty()) {
      plan.errors.push_back(fmt::format(
          "{}: is for a film in real time. Fix: leave it out, or add --fps 60.", option));
    }
  }
  if (!fps) return;
  plan.shutter = render::Shutter{.frames_per_s = *fps,
                                 .exposure_s = exposure_ms.value_or(0) / kMsPerS,
                                 .hold_s = hold_s.value_or(0)};
  if (plan.shutter->exposure_s * *fps > 1 + 1e-9) {
    plan.errors.push_back(fmt::format(
        "--exposure-ms {}: frames follow {:.4g} ms after each other. Rule: no longer than that. "
        "Fix: --exposure-ms {:.2g}.",
        arguments.exposure_ms, kMsPerS / *fps, .3 * kMsPerS / *fps));
  }
}

void read_output(const RenderArguments& arguments, RenderPlan& plan) {
  const std::string& file = arguments.out_file;
  if (file.empty()) {
    plan.errors.emplace_back("--out: no place for the picture is given. Fix: --out heap.png.");
    return;
  }
  const auto output =
      read_format<RenderOutput>({"--out", file, plan.errors}, {{".png", RenderOutput::picture},
                                                               {".jpg", RenderOutput::picture},
                                                               {".jpeg", RenderOutput::picture},
                                                               {".glb", RenderOutput::model},
                                                               {".mp4", RenderOutput::film},
                                                               {".gif", RenderOutput::film}});
  if (!output) return;
  plan.output = *output;
  const bool is_film = plan.is_series || plan.turntable_frames > 0;
  if ((plan.output == RenderOutput::film) == is_film) return;
  plan.errors.push_back(
      is_film ? fmt::format("--out {}: these frames make a film. Fix: a name that ends in .mp4 or "
                            ".gif.",
                            file)
              : fmt::format("--out {}: one state makes no film. Fix: add --turntable 72, or name a "
                            "trajectory.pvd.",
                            file));
}

}  // namespace

render::Camera camera_of(const RenderPlan& plan, const render::Scene& scene) {
  if (!plan.lens) return plan.level;
  render::PerspectiveCamera camera = render::camera_on(plan.lens->stand, scene, plan.size);
  camera.roll_rad = plan.lens->roll_rad;
  camera.k1 = plan.lens->k1;
  camera.k2 = plan.lens->k2;
  return camera;
}

namespace {

/// Pictures have their own mark.
std::string_view mark_of(RenderOutput output) {
  switch (output) {
    case RenderOutput::film:
      return vision::kFilmComment;
    case RenderOutput::model:
      return kMeshMark;
    case RenderOutput::picture:
      break;
  }
  return {};
}

}  // namespace

RenderPlan plan_render(const RenderArguments& arguments) {
  RenderPlan plan;
  plan.is_series = arguments.state.ends_with(".pvd");
  plan.positions = read_position_options(arguments.positions, plan.errors);
  if (const std::string given = arguments.positions.given(); plan.is_series && !given.empty()) {
    plan.errors.push_back(
        fmt::format("{}: is for files of other programs' particles. Fix: leave it out.", given));
  }
  read_view(arguments.view, plan);
  if (const auto size = read_size({"--size", arguments.size, plan.errors})) {
    plan.size = {.width = (*size)[0], .height = (*size)[1]};
    for (const base::Fault& problem : plan.size.problems()) {
      plan.errors.push_back(problem.text(kRenderFields));
    }
  }
  plan.level.mm_per_px = read_positive({"--mm-per-px", arguments.mm_per_px, plan.errors},
                                       "a number of mm", "leave it out to see all grains");
  read_style(arguments, plan);
  read_camera(arguments, plan);
  read_turntable(arguments, plan);
  read_shutter(arguments, plan);
  read_output(arguments, plan);
  if (plan.output != RenderOutput::picture) {
    for (const auto& [option, file] :
         {std::pair{"--mask", &arguments.mask_file}, std::pair{"--truth", &arguments.truth_file}}) {
      if (file->empty() || (plan.shutter && file == &arguments.truth_file)) continue;
      plan.errors.push_back(
          fmt::format("{}: is for a single picture{}. Fix: leave it out, or --out heap.png.",
                      option, file == &arguments.truth_file ? ", or a film with --fps" : ""));
    }
  }
  if (!arguments.mask_file.empty() && !arguments.mask_file.ends_with(".png")) {
    plan.errors.push_back(fmt::format(
        "--mask {}: JPEG would spoil it. Fix: a name that ends in .png.", arguments.mask_file));
  }
  check_output_places({{"--out", arguments.out_file, {}, mark_of(plan.output)},
                       {"--mask", arguments.mask_file},
                       json_place(arguments.truth_file, "\"camera\"", "--truth")},
                      {arguments.state}, plan.errors);
  return plan;
}

namespace {

constexpr const char* kRenderNotes = R"(
STATE is a .vtp file written by repose simulate --out or, for a film, the
trajectory.pvd of a run; or a file of particles as other programs write them.

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

Without --fps a film has a frame for each state of the trajectory. With it, the
film plays in real time, states in between are interpolated, and the bench is
cut to the length of the grains' path. Simulate with --trajectory-s 0.001.

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
  Command command{
      .name = "render",
      .summary = "Render a simulated state, or particles",
      .options =
          {{"state", "STATE", "State (.vtp), trajectory.pvd, or particles", &given->state, true},
           {"--view", "xz|DEGREES", "Viewing direction (xz)", &given->view},
           {"--style", "silhouette|photo", "Appearance (silhouette)", &given->style},
           {"--size", "W,H", "Size in pixels (1920,1080)", &given->size},
           {"--mm-per-px", "MM", "Scale (such that all grains fit)", &given->mm_per_px},
           {"--camera", "KEY=NUMBER,...", "Perspective camera; keys below", &given->camera},
           {"--show", "mesh|spheres|both", "How grains are shown (mesh)", &given->show},
           {"--seed", "N", "For a photo's textures and noise (1)", &given->seed},
           {"--passes", "N", "Photo: more for smoother shadows (24)", &given->passes},
           {"--study", "STUDY.toml", "Photo: take the grains' colour from it", &given->study},
           {"--noise", "PART", "Photo: the sensor's, of full light (0.008)", &given->noise},
           {"--mask", "FILE.png", "Mask: grains white, all else black", &given->mask_file},
           {"--truth", "FILE.json", "Exact geometry of the picture", &given->truth_file},
           {"--turntable", "FRAMES", "Film of one turn around the heap", &given->turntable},
           {"--fps", "N", "Film of a run: frames per second, in real time", &given->fps},
           {"--exposure-ms", "MS", "With --fps, photo: exposure of a frame (0)",
            &given->exposure_ms},
           {"--hold-s", "S", "With --fps: show its ends so much longer (0)", &given->hold_s},
           {"--out", "FILE", "Picture .png .jpg, model .glb, film .mp4 .gif", &given->out_file}},
      .notes = std::string(kPositionNotes) + kRenderNotes,
      .missing = "no state given. Fix: repose render STATE.vtp --out heap.png.",
      .fields = kRenderFields,
      .run = [given] { return run_render(*given); }};
  const auto more = position_options(given->positions);
  command.options.insert(command.options.end(), more.begin(), more.end());
  return command;
}

}  // namespace repose::cli
