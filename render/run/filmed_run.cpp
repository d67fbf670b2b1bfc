#include "render/run/filmed_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"
#include "render/scene/bench.h"
#include "render/scene/view.h"

namespace repose::render {

namespace {

using dem::Vector;

bool are_alike(const Scene& a, const Scene& b) {
  if (a.grains.size() != b.grains.size() || a.walls.size() != b.walls.size()) return false;
  for (std::size_t k = 0; k < a.grains.size(); ++k) {
    if (a.grains[k].number != b.grains[k].number) return false;
  }
  return true;
}

}  // namespace

Scene between(const Scene& a, const Scene& b, double part, double interval_s) {
  if (!are_alike(a, b)) return a;
  Scene scene = a;
  const double s = part, s2 = s * s, s3 = s2 * s;
  for (std::size_t k = 0; k < scene.grains.size(); ++k) {
    const PlacedGrain &from = a.grains[k], &to = b.grains[k];
    scene.grains[k].pose.position =
        (2 * s3 - 3 * s2 + 1) * from.pose.position + (3 * s2 - 2 * s3) * to.pose.position +
        interval_s * ((s3 - 2 * s2 + s) * from.velocity + (s3 - s2) * to.velocity);
    scene.grains[k].pose.orientation = from.pose.orientation.slerp(part, to.pose.orientation);
  }
  for (std::size_t k = 0; k < scene.walls.size(); ++k) {
    const dem::Pose &from = a.walls[k].pose, &to = b.walls[k].pose;
    scene.walls[k].pose.position = (1 - part) * from.position + part * to.position;
    scene.walls[k].pose.orientation = from.orientation.slerp(part, to.orientation);
  }
  return scene;
}

namespace {

constexpr double kMaxFramesPerS = 10000;
constexpr int kMaxFrames = 1'000'000;

/// @throws base::InputError
void check(const RunStates& states, const Shutter& shutter) {
  const auto require = [](bool holds, base::Fault fault) {
    if (!holds) throw base::InputError(std::move(fault)).in("film");
  };
  require(!states.times_s.empty(), {.value = "it has no states", .fix = "those of a run."});
  require(std::is_sorted(states.times_s.begin(), states.times_s.end()),
          {.value = "its states are not in the order of their times",
           .fix = "simulate the run again."});
  require(shutter.frames_per_s > 0 && shutter.frames_per_s <= kMaxFramesPerS,
          {.value = fmt::format("{:g} frames per second", shutter.frames_per_s),
           .rule = fmt::format("above 0, at most {:g}", kMaxFramesPerS),
           .fix = "60."});
  constexpr double kRounding = 1 + 1e-9;
  require(shutter.exposure_s >= 0 && shutter.exposure_s * shutter.frames_per_s <= kRounding,
          {.value = fmt::format("a frame is exposed for {:g} ms", 1e3 * shutter.exposure_s),
           .rule = fmt::format("0 to {:.4g}, the time between two", 1e3 / shutter.frames_per_s),
           .fix = fmt::format("{:.3g}.", 3e2 / shutter.frames_per_s)});
  require(shutter.hold_s >= 0 && shutter.hold_s <= 3600,
          {.value = fmt::format("the first and the last state are held for {:g} s", shutter.hold_s),
           .rule = "0 to 3600",
           .fix = ".5."});
}

}  // namespace

FilmedRun::FilmedRun(RunStates states, const Shutter& shutter)
    : states_(std::move(states)), shutter_(shutter) {
  check(states_, shutter_);
  const std::size_t count = states_.times_s.size();
  const double lasts_s = states_.times_s.back() - states_.times_s.front() + 2 * shutter_.hold_s;
  const double frames = std::floor(lasts_s * shutter_.frames_per_s) + 1;
  if (!(frames <= kMaxFrames)) {
    throw base::InputError({.where = "film",
                            .value = fmt::format("{:.0f} frames", frames),
                            .rule = fmt::format("at most {}", kMaxFrames),
                            .fix = "fewer frames per second."});
  }
  frames_ = static_cast<int>(frames);
  // A sample of moments gives the extent of all: what moves far is caught on its way.
  constexpr std::size_t kLooks = 60;
  std::vector<Scene> looks;
  for (std::size_t k = 0; k < std::min(kLooks, count); ++k) {
    looks.push_back(states_.scene(count <= kLooks ? k : k * (count - 1) / (kLooks - 1)));
  }
  const Bench bench(looks);
  first_ = bench.set(looks.front());
  on_bench_ = [bench](Scene moment) { return bench.set(std::move(moment)); };
}

double FilmedRun::time_s(int frame) const {
  return states_.times_s.front() - shutter_.hold_s + frame / shutter_.frames_per_s +
         .5 * shutter_.exposure_s;
}

const Scene& FilmedRun::state(std::size_t number, std::size_t kept) {
  for (const std::optional<Read>* read : {&one_, &other_}) {
    if (*read && (*read)->number == number) return (*read)->scene;
  }
  std::optional<Read>& place = one_ && one_->number == kept ? other_ : one_;
  place = Read{.number = number, .scene = states_.scene(number)};
  return place->scene;
}

Scene FilmedRun::scene_at(double time_s) {
  const std::vector<double>& times_s = states_.times_s;
  const auto next = std::upper_bound(times_s.begin(), times_s.end(), time_s);
  if (next == times_s.begin()) return on_bench_(state(0, 0));
  if (next == times_s.end()) return on_bench_(state(times_s.size() - 1, times_s.size() - 1));
  const auto number = static_cast<std::size_t>(next - times_s.begin());
  const double interval_s = times_s[number] - times_s[number - 1];
  const double part = (time_s - times_s[number - 1]) / interval_s;
  const Scene& earlier = state(number - 1, number);
  const Scene& later = state(number, number - 1);
  return on_bench_(between(earlier, later, part, interval_s));
}

std::vector<Scene> FilmedRun::moments(int frame, int count) {
  std::vector<Scene> moments;
  for (int k = 0; k < count; ++k) {
    const double part = (k + .5) / count - .5;
    moments.push_back(scene_at(time_s(frame) + part * shutter_.exposure_s));
  }
  return moments;
}

namespace {

/// The largest 1, 2 or 5 times a power of ten that does not exceed a length.
double round_length(double length) {
  const double power = std::pow(10, std::floor(std::log10(length)));
  const double part = length / power;
  return (part >= 5 ? 5 : part >= 2 ? 2 : 1) * power;
}

}  // namespace

FilmTruth film_truth_of(FilmedRun& run, const Camera& camera, const PictureSize& size) {
  constexpr double kPart = .8;  // of the picture's width
  const View view = view_of(run.first(), camera, size);
  const dem::Vector middle = run.first().setting->extent.center();
  FilmTruth truth{.camera = camera,
                  .size = size,
                  .frames_per_s = run.shutter().frames_per_s,
                  .exposure_s = run.shutter().exposure_s,
                  .mm_per_px = view.mm_per_px(view.in_camera(middle).z()),
                  .scale = {},
                  .frames = {}};
  truth.scale_mm = round_length(kPart * truth.mm_per_px * size.width);
  dem::Vector right = view.axes.row(0);
  right.z() = 0;
  right.normalize();
  const dem::Vector half = .5e-3 * truth.scale_mm * right;
  const auto from = view.project(middle - half), to = view.project(middle + half);
  if (from && to) truth.scale = {*from, *to};
  if (run.first().grains.size() > kMaxPlaced) return truth;
  for (int frame = 0; frame < run.frames(); ++frame) {
    FilmTruth::Frame& now = truth.frames.emplace_back();
    now.run_s = run.time_s(frame);
    for (const PlacedGrain& grain : run.scene_at(now.run_s).grains) {
      const auto seen = view.project(grain.pose.position);
      now.grains.push_back({grain.pose.position, seen.value_or(vision::Point{})});
    }
  }
  return truth;
}

}  // namespace repose::render
