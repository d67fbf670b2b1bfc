#include "render/run/film_truth.h"

#include <cmath>

#include "render/scene/view.h"

namespace repose::render {
namespace {

/// 1, 2 or 5 times a power of ten, at most a length.
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
  if (run.first().grains.size() > kMostPlaced) return truth;
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
