#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/experiment/picture_angles.h"
#include "dem/experiment/protocol.h"
#include "render/renderer.h"
#include "render/scene/camera.h"
#include "render/scene/scene.h"
#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"

/// The angle of a simulated heap as a camera would give it: silhouettes from all around, each
/// measured like a photograph.
namespace repose::calibrate {

/// Sides from which a heap is drawn, unless asked otherwise.
/// With more, neighbouring views show the same grains: the scatter between heaps is what remains.
inline constexpr int kHeapViews = 9;

/// A level camera on a stand before the heap.
struct HeapCamera {
  double distance_m = 0;  ///< from the heap's middle, along the floor
  double height_m = 0;    ///< of the lens above the ground

  bool operator==(const HeapCamera&) const = default;
};

/// None: pictures are taken from far away.
std::optional<HeapCamera> camera_of(const dem::HeapProtocol& protocol);

/// How pictures of a heap are taken.
struct HeapViewing {
  /// Sides, equally spaced over half a turn; the first is the XZ view. 0: no pictures.
  int views = kHeapViews;
  /// None: it is so far away that its rays are parallel.
  std::optional<HeapCamera> camera = {};
};

/// A heap seen from one side.
struct HeapView {
  double azimuth_rad = 0;  ///< as in render/scene/camera.h
  PictureAngle picture;
};

/// A picture of a heap, and what was measured in it.
struct TakenView {
  vision::Picture picture;
  vision::ReposeAngle angle;
};

/// A heap, and how all pictures of it are taken: at one scale, with bare ground beside the grains.
class HeapViewSession {
 public:
  /// @throws base::InputError  the scene has no grains, or some reach as far as the camera.
  HeapViewSession(render::Scene scene, const HeapViewing& viewing);

  int views() const { return views_; }
  /// In the heap's middle plane.
  double m_per_px() const { return m_per_px_; }

  TakenView take(render::Renderer& renderer, int view,
                 const vision::MeasureOptions& options = {}) const;

  /// Draws one view and measures it; keeps it with what was measured where a file is named.
  /// Several views may be measured at once, each with its own renderer.
  HeapView measure(render::Renderer& renderer, int view,
                   const std::filesystem::path& overlay_file = {}) const;

 private:
  double azimuth_rad(int view) const;
  render::Camera camera_at(double azimuth_rad) const;

  render::Scene scene_;
  int views_;
  render::OrthographicCamera far_;
  std::optional<render::LabStand> stand_;  ///< none: the camera is far away
  double m_per_px_ = 0;
  render::PictureSize size_;
};

/// All views of a heap, the same at any number of threads.
/// @param report  is told the fraction done, from any thread; false interrupts it
/// @throws dem::Interrupted  `report` asked for it.
/// @throws std::runtime_error  this machine cannot draw.
std::vector<HeapView> measure_views(const HeapViewSession& session, int threads,
                                    const std::function<bool(double fraction)>& report);

/// Mean of the views as of any pictures, by a definition of base/angle_definition.h; empty: by the
/// usual one.
PictureMean mean_of_views(std::span<const HeapView> views, const std::string& definition = {});

/// At least half of the views gave a number by it: it is what a photograph is compared with.
bool is_well_pictured(std::span<const HeapView> views, const std::string& definition = {});

}  // namespace repose::calibrate
