#include "calibrate/study/heap_views.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "dem/experiment/placing.h"
#include "vision/drawing/overlay.h"
#include "vision/picture/picture.h"

namespace repose::calibrate {

HeapViewSession::HeapViewSession(render::Scene scene, int views)
    : scene_(std::move(scene)), views_(views) {
  // More pixels to a grain than these are not looked at by what measures, and take time to draw.
  constexpr double kGrain_px = 40;
  constexpr render::PictureSize kLargest{.width = 1920, .height = 1080};
  camera_ = render::fitted_all_around({}, scene_, kLargest);
  const double fitting = *camera_.mm_per_px;
  const double grain_mm = 1e3 * dem::diameter_m(scene_.shapes.front());
  const double mm_per_px = std::max(fitting, grain_mm / kGrain_px);
  const auto reduced = [&](int pixels) {
    return static_cast<int>(std::ceil(pixels * fitting / mm_per_px));
  };
  camera_.mm_per_px = mm_per_px;
  size_ = {.width = reduced(kLargest.width), .height = reduced(kLargest.height)};
}

HeapView HeapViewSession::measure(render::Renderer& renderer, int view,
                                  const std::filesystem::path& overlay_file) const {
  render::OrthographicCamera camera = camera_;
  camera.azimuth_rad = std::numbers::pi * view / views_;
  const vision::Picture picture =
      renderer.draw(scene_, camera, size_, render::SilhouetteStyle{}).picture;
  const vision::ReposeAngle angle = vision::measure_repose_angle(picture);
  if (!overlay_file.empty()) {
    const vision::OverlayNotes notes{.title = overlay_file.filename().string(), .excluded = {}};
    vision::write_picture(overlay_file, vision::draw_overlay(picture, angle, notes));
  }
  return {.azimuth_rad = camera.azimuth_rad, .status = angle.status, .angle_rad = angle.angle_rad};
}

int count(std::span<const HeapView> views, vision::MeasureStatus status) {
  return static_cast<int>(std::count_if(
      views.begin(), views.end(), [&](const HeapView& view) { return view.status == status; }));
}

bool is_well_pictured(std::span<const HeapView> views) {
  const int refused = count(views, vision::MeasureStatus::refused);
  return !views.empty() && 2 * refused <= static_cast<int>(views.size());
}

std::optional<calibrate::Summary> angle_deg(std::span<const HeapView> views) {
  std::vector<double> angles;
  for (const HeapView& view : views) {
    if (view.angle_rad) angles.push_back(*view.angle_rad * 180 / std::numbers::pi);
  }
  if (angles.empty()) return std::nullopt;
  return calibrate::summarise(angles);
}

}  // namespace repose::calibrate
