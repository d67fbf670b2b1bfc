#include "cli/render/render_options.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "cli/common/number.h"
#include "cli/common/output_places.h"

namespace repose::cli {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

void read_view(const std::string& text, RenderPlan& plan) {
  if (text.empty() || text == "xz") return;
  const auto azimuth_deg = number_in<double>(text);
  constexpr double kMost_deg = 3600;
  if (!azimuth_deg || std::abs(*azimuth_deg) > kMost_deg) {
    plan.errors.push_back(
        fmt::format("--view {}: must be xz or an azimuth in degrees. Fix: --view 90 looks at the "
                    "heap from its right.",
                    text));
    return;
  }
  plan.level.azimuth_rad = *azimuth_deg * kDegree;
}

void read_size(const std::string& text, RenderPlan& plan) {
  if (text.empty()) return;
  const auto size = numbers_in<int, 2>(text);
  if (!size || (*size)[0] < 1 || (*size)[1] < 1) {
    plan.errors.push_back(fmt::format(
        "--size {}: must be width and height in pixels, each above 0, with a comma between them. "
        "Fix: --size 1920,1080.",
        text));
    return;
  }
  plan.size = {.width = (*size)[0], .height = (*size)[1]};
}

void read_scale(const std::string& text, RenderPlan& plan) {
  if (text.empty()) return;
  const auto mm_per_px = number_in<double>(text);
  if (!mm_per_px || *mm_per_px <= 0) {
    plan.errors.push_back(fmt::format(
        "--mm-per-px {}: must be a number above 0. Fix: leave it out to see all grains.", text));
    return;
  }
  plan.level.mm_per_px = mm_per_px;
}

std::optional<render::Shown> shown_named(const std::string& name) {
  if (name.empty() || name == "mesh") return render::Shown::mesh;
  if (name == "spheres") return render::Shown::spheres;
  if (name == "both") return render::Shown::both;
  return std::nullopt;
}

void read_style(const RenderArguments& arguments, RenderPlan& plan) {
  const auto shown = shown_named(arguments.show);
  if (!shown) {
    plan.errors.push_back(fmt::format(
        "--show {}: is none that is known here. Fix: mesh, spheres or both.", arguments.show));
  }
  if (!arguments.style.empty() && arguments.style != "silhouette" && arguments.style != "photo") {
    plan.errors.push_back(fmt::format(
        "--style {}: is none that is known here. Fix: silhouette or photo.", arguments.style));
  }
  const bool is_photo = arguments.style == "photo";
  for (const auto& [option, text] :
       {std::pair{"--seed", &arguments.seed}, std::pair{"--passes", &arguments.passes}}) {
    if (!text->empty() && !is_photo) {
      plan.errors.push_back(fmt::format(
          "{}: a silhouette has neither noise nor shadows. Fix: --style photo, or leave it out.",
          option));
    }
  }
  if (!is_photo) {
    plan.style = render::SilhouetteStyle{.shown = shown.value_or(render::Shown::mesh)};
    return;
  }
  render::PhotoStyle photo{.shown = shown.value_or(render::Shown::mesh)};
  if (!arguments.seed.empty()) {
    const auto seed = number_in<std::uint64_t>(arguments.seed);
    if (!seed) {
      plan.errors.push_back(fmt::format(
          "--seed {}: must be a whole number from 0 on. Fix: --seed 1.", arguments.seed));
    }
    photo.seed = seed.value_or(photo.seed);
  }
  if (!arguments.passes.empty()) {
    constexpr int kMaxPasses = 1000;
    const auto passes = number_in<int>(arguments.passes);
    if (!passes || *passes < 1 || *passes > kMaxPasses) {
      plan.errors.push_back(
          fmt::format("--passes {}: must be a whole number from 1 to {}. Fix: {} is usual.",
                      arguments.passes, kMaxPasses, photo.passes));
    }
    photo.passes = passes.value_or(photo.passes);
  }
  plan.style = photo;
}

/// One KEY=VALUE of --camera; false when there is no such key or it has no number.
bool read_camera_part(std::string_view part, LensPlan& lens) {
  const std::size_t equals = part.find('=');
  if (equals == std::string_view::npos) return false;
  const std::string_view key = part.substr(0, equals);
  const auto value = number_in<double>(part.substr(equals + 1));
  if (!value) return false;
  constexpr double kMmPerM = 1e3;
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
  if (arguments.turntable.empty()) return;
  constexpr int kMaxFrames = 10'000;
  const auto frames = number_in<int>(arguments.turntable);
  if (!frames || *frames < 1 || *frames > kMaxFrames) {
    plan.errors.push_back(
        fmt::format("--turntable {}: must be a whole number of frames from 1 to {}. Fix: 72 is one "
                    "every 5 degrees.",
                    arguments.turntable, kMaxFrames));
    return;
  }
  plan.turntable_frames = *frames;
  if (plan.is_series) {
    plan.errors.push_back(fmt::format(
        "--turntable: {} is a film already. Fix: leave it out, or name one of its .vtp files.",
        arguments.state));
  }
}

void read_output(const RenderArguments& arguments, RenderPlan& plan) {
  const std::string& file = arguments.out_file;
  const auto ends_in = [&file](std::initializer_list<std::string_view> endings) {
    return std::any_of(endings.begin(), endings.end(),
                       [&file](std::string_view ending) { return file.ends_with(ending); });
  };
  const bool is_film = plan.is_series || plan.turntable_frames > 0;
  if (file.empty()) {
    plan.errors.emplace_back("--out: there is no place for the picture. Fix: --out heap.png.");
  } else if (ends_in({".png", ".jpg", ".jpeg"})) {
    plan.output = RenderOutput::picture;
  } else if (ends_in({".glb"})) {
    plan.output = RenderOutput::model;
  } else if (ends_in({".mp4", ".gif"})) {
    plan.output = RenderOutput::film;
  } else {
    plan.errors.push_back(fmt::format(
        "--out {}: its ending must say what it is. Fix: .png or .jpg for a picture, .glb for a "
        "model, .mp4 or .gif for a film.",
        file));
    return;
  }
  if (file.empty() || (plan.output == RenderOutput::film) == is_film) return;
  plan.errors.push_back(
      is_film ? fmt::format("--out {}: a film is asked for. Fix: a name that ends in .mp4 or .gif.",
                            file)
              : fmt::format("--out {}: one state is no film. Fix: add --turntable 72, or name a "
                            "trajectory.pvd.",
                            file));
}

}  // namespace

RenderPlan plan_render(const RenderArguments& arguments) {
  RenderPlan plan;
  plan.is_series = arguments.state.ends_with(".pvd");
  read_view(arguments.view, plan);
  read_size(arguments.size, plan);
  read_scale(arguments.mm_per_px, plan);
  read_style(arguments, plan);
  read_camera(arguments, plan);
  read_turntable(arguments, plan);
  read_output(arguments, plan);
  if (plan.output != RenderOutput::picture) {
    for (const auto& [option, file] :
         {std::pair{"--mask", &arguments.mask_file}, std::pair{"--truth", &arguments.truth_file}}) {
      if (file->empty()) continue;
      plan.errors.push_back(
          fmt::format("{}: belongs to one picture. Fix: leave it out, or --out heap.png.", option));
    }
  }
  if (!arguments.mask_file.empty() && !arguments.mask_file.ends_with(".png")) {
    plan.errors.push_back(fmt::format(
        "--mask {}: JPEG would spoil it. Fix: a name that ends in .png.", arguments.mask_file));
  }
  check_output_places({{"--out", arguments.out_file},
                       {"--mask", arguments.mask_file},
                       {"--truth", arguments.truth_file}},
                      {arguments.state}, plan.errors);
  return plan;
}

}  // namespace repose::cli
