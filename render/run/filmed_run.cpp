#include "render/run/filmed_run.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "render/run/between.h"
#include "render/scene/bench.h"

namespace repose::render {
namespace {

constexpr double kMostFramesPerS = 10000;
constexpr int kMostFrames = 1'000'000;

/// @throws std::invalid_argument
void check(const RunStates& states, const Shutter& shutter) {
  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw std::invalid_argument("film: " + what);
  };
  require(!states.times_s.empty(), "it has no states. Fix: those of a run.");
  require(std::is_sorted(states.times_s.begin(), states.times_s.end()),
          "its states are not in the order of their times. Fix: simulate the run again.");
  require(shutter.frames_per_s > 0 && shutter.frames_per_s <= kMostFramesPerS,
          fmt::format("{:g} frames per second. Rule: above 0, at most {:g}. Fix: 60.",
                      shutter.frames_per_s, kMostFramesPerS));
  constexpr double kRounding = 1 + 1e-9;
  require(shutter.exposure_s >= 0 && shutter.exposure_s * shutter.frames_per_s <= kRounding,
          fmt::format("a frame is exposed for {:g} ms. Rule: 0 to {:.4g}, the time between two. "
                      "Fix: {:.3g}.",
                      1e3 * shutter.exposure_s, 1e3 / shutter.frames_per_s,
                      3e2 / shutter.frames_per_s));
  require(shutter.hold_s >= 0 && shutter.hold_s <= 3600,
          fmt::format("the first and the last state are held for {:g} s. Rule: 0 to 3600. Fix: .5.",
                      shutter.hold_s));
}

}  // namespace

FilmedRun::FilmedRun(RunStates states, const Shutter& shutter)
    : states_(std::move(states)), shutter_(shutter) {
  check(states_, shutter_);
  const std::size_t count = states_.times_s.size();
  const double lasts_s = states_.times_s.back() - states_.times_s.front() + 2 * shutter_.hold_s;
  const double frames = std::floor(lasts_s * shutter_.frames_per_s) + 1;
  if (!(frames <= kMostFrames)) {
    throw std::invalid_argument(
        fmt::format("film: {:.0f} frames. Rule: at most {}. Fix: fewer frames per second.", frames,
                    kMostFrames));
  }
  frames_ = static_cast<int>(frames);
  // Some moments tell where all of them are: what moves far is seen on its way.
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

}  // namespace repose::render
