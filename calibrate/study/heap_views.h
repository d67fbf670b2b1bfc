#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "calibrate/statistics/summary.h"
#include "render/renderer.h"
#include "render/scene/camera.h"
#include "render/scene/scene.h"
#include "vision/measure/repose_angle.h"

/// The angle of a simulated heap as a camera would give it: silhouettes from all around, each
/// measured like a photograph.
namespace repose::calibrate {

/// A heap seen from one side.
struct HeapView {
  double azimuth_rad = 0;  ///< as in render/scene/camera.h
  vision::MeasureStatus status = vision::MeasureStatus::refused;
  std::optional<double> angle_rad;
};

/// A heap, and how all pictures of it are taken: at one scale, with bare ground beside the grains.
class HeapViewSession {
 public:
  /// @param views  sides, equally spaced over half a turn; the first is the XZ view
  /// @throws std::invalid_argument  the scene has no grains.
  HeapViewSession(render::Scene scene, int views);

  int views() const { return views_; }

  /// Draws one view and measures it; keeps it with what was measured where a file is named.
  /// Several views may be measured at once, each with its own renderer.
  HeapView measure(render::Renderer& renderer, int view,
                   const std::filesystem::path& overlay_file = {}) const;

 private:
  render::Scene scene_;
  int views_;
  render::OrthographicCamera camera_;
  render::PictureSize size_;
};

int count(std::span<const HeapView> views, vision::MeasureStatus status);

/// At least half of the views gave a number: it is what a photograph is compared with.
bool is_well_pictured(std::span<const HeapView> views);

/// Mean and scatter of the views that gave a number, flagged ones too: to leave out just the views
/// from which a heap looks hollow or low would move the mean. In degrees; none without a number.
std::optional<calibrate::Summary> angle_deg(std::span<const HeapView> views);

}  // namespace repose::calibrate
