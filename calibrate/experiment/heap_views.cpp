#include "calibrate/experiment/heap_views.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <utility>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "dem/experiment/experiment.h"
#include "dem/experiment/placing.h"
#include "vision/drawing/overlay.h"

namespace repose::calibrate {

std::optional<HeapCamera> camera_of(const dem::HeapProtocol& protocol) {
  if (!protocol.camera_distance_m) return std::nullopt;
  return HeapCamera{.distance_m = *protocol.camera_distance_m,
                    .height_m = protocol.camera_height_m};
}

HeapViewSession::HeapViewSession(render::Scene scene, const HeapViewing& viewing)
    : scene_(std::move(scene)), views_(viewing.views) {
  // More pixels to a grain than these are not looked at by what measures, and take time to draw.
  constexpr double kGrain_px = 40;
  constexpr render::PictureSize kLargest{.width = 1920, .height = 1080};
  far_ = render::fitted_all_around({}, scene_, kLargest);
  double fitting = *far_.mm_per_px / 1000;
  if (viewing.camera) {
    stand_ = render::fitted_stand(render::LabStand{.distance_m = viewing.camera->distance_m,
                                                   .height_m = viewing.camera->height_m},
                                  scene_, kLargest);
    fitting = stand_->distance_m * render::kFilmWidth_mm / (*stand_->focal_mm * kLargest.width);
  }
  m_per_px_ = std::max(fitting, dem::diameter_m(scene_.shapes.front()) / kGrain_px);
  const auto reduced = [&](int pixels) {
    return static_cast<int>(std::ceil(pixels * fitting / m_per_px_));
  };
  far_.mm_per_px = 1000 * m_per_px_;
  size_ = {.width = reduced(kLargest.width), .height = reduced(kLargest.height)};
}

render::Camera HeapViewSession::camera_at(double azimuth_rad) const {
  if (stand_) {
    render::LabStand stand = *stand_;
    stand.azimuth_rad = azimuth_rad;
    return render::camera_on(stand, scene_, size_);
  }
  render::OrthographicCamera camera = far_;
  camera.azimuth_rad = azimuth_rad;
  return camera;
}

double HeapViewSession::azimuth_rad(int view) const { return std::numbers::pi * view / views_; }

TakenView HeapViewSession::take(render::Renderer& renderer, int view,
                                const vision::MeasureOptions& options) const {
  const render::Camera camera = camera_at(azimuth_rad(view));
  TakenView taken;
  taken.picture = renderer.draw(scene_, camera, size_, render::SilhouetteStyle{}).picture;
  taken.angle = vision::measure_repose_angle(taken.picture, options);
  return taken;
}

HeapView HeapViewSession::measure(render::Renderer& renderer, int view,
                                  const std::filesystem::path& overlay_file) const {
  const auto [picture, angle] = take(renderer, view);
  if (!overlay_file.empty()) {
    const vision::OverlayNotes notes{.title = overlay_file.filename().string(), .excluded = {}};
    vision::write_picture(overlay_file, vision::draw_overlay(picture, angle, notes));
  }
  return {.azimuth_rad = azimuth_rad(view), .picture = picture_angle_of(angle)};
}

// Why kHeapViews is 9: over six small heaps the mean of 9 views was .1 degrees (sd .3, worst .4)
// from that of 18, where these heaps scatter by 4 degrees.
std::vector<HeapView> measure_views(const HeapViewSession& session, int threads,
                                    const std::function<bool(double fraction)>& report) {
  std::vector<HeapView> views(static_cast<std::size_t>(session.views()));
  // Contexts are costly to make, and each belongs to one thread.
  tbb::enumerable_thread_specific<render::Renderer> renderers;
  std::atomic<int> done = 0;
  std::atomic<bool> is_interrupted = false;
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(0, session.views(), [&](int view) {
      if (is_interrupted) return;
      views[static_cast<std::size_t>(view)] = session.measure(renderers.local(), view);
      if (!report(static_cast<double>(++done) / session.views())) is_interrupted = true;
    });
  });
  if (is_interrupted) throw dem::Interrupted("interrupted while pictures were measured");
  return views;
}

PictureMean mean_of_views(std::span<const HeapView> views, const std::string& definition) {
  std::vector<PictureAngle> pictures;
  pictures.reserve(views.size());
  for (const HeapView& view : views) pictures.push_back(view.picture);
  return mean_of_pictures(pictures, definition);
}

bool is_well_pictured(std::span<const HeapView> views, const std::string& definition) {
  return !views.empty() &&
         2 * mean_of_views(views, definition).refused <= static_cast<int>(views.size());
}

}  // namespace repose::calibrate
