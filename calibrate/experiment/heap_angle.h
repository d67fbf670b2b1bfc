#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/statistics/summary.h"
#include "dem/experiment/experiment_table.h"
#include "render/renderer.h"
#include "render/scene/camera.h"
#include "render/scene/scene.h"
#include "vision/measure/outline_angle.h"
#include "vision/measure/repose_angle.h"
#include "vision/picture/picture.h"

/// The angle of a heap: from the positions of its grains, with the same line fit as for pictures;
/// and as a camera would see it, in silhouettes from all around, each measured like a photograph.
/// The mean of several pictures follows one rule for simulated heaps and those of a bench, since
/// they are compared with each other.
namespace repose::calibrate {

/// The angle measured in one picture.
struct PictureAngle {
  vision::MeasureStatus status = vision::MeasureStatus::refused;
  std::optional<double> angle_rad;
  /// By the other definitions of base/angle_definition.h, keyed by name; only those that the
  /// picture allows.
  std::map<std::string, double> other_rad = {};
};

PictureAngle picture_angle_of(const vision::ReposeAngle& measured);

/// By a definition; empty: the default. std::nullopt if the picture is refused.
std::optional<double> angle_by(const PictureAngle& picture, const std::string& definition);

/// Whether a picture's angle counts towards a mean: every measurable one does, flagged ones too. A
/// flag means that a heap looks low or concave from there, or that its interval is wide; the number
/// is not wrong, and leaving these out biases the mean: for six simulated heaps seen from many
/// directions, the unflagged views read 1.3 degrees less than all views. The number of flagged
/// pictures is reported with every mean, and each keeps its own, wider interval.
bool counts_in_mean(vision::MeasureStatus status);
/// The same for a status by its name in JSON: "flagged".
bool counts_in_mean(std::string_view status);

struct PictureMean {
  std::optional<Summary> angle_deg;  ///< std::nullopt if no picture counts
  int flagged = 0;                   ///< of those that count
  int refused = 0;                   ///< or without an angle by this definition
};

PictureMean mean_of_pictures(std::span<const PictureAngle> pictures,
                             const std::string& definition = {});

/// Default number of directions from which a heap is drawn. With more, neighbouring views show the
/// same grains, and only the scatter between heaps remains.
inline constexpr int kHeapViews = 9;

/// How pictures of a heap are taken.
struct HeapViewing {
  /// Number of directions, equally spaced over half a turn; the first is the XZ view. 0: no
  /// pictures.
  int views = kHeapViews;
  /// std::nullopt: so far away that its rays are parallel.
  std::optional<dem::LevelCamera> camera = {};
};

/// A heap seen from one side.
struct HeapView {
  double azimuth_rad = 0;  ///< as in render/scene/camera.h
  PictureAngle picture;
};

/// A picture of a heap, and its measurement.
struct TakenView {
  vision::Picture picture;
  vision::ReposeAngle angle;
};

/// A heap, and how all pictures of it are taken: at one scale, with bare ground beside the grains.
class HeapViewSession {
 public:
  /// @throws base::InputError  the scene has no grains, or some extend as far as the camera.
  HeapViewSession(render::Scene scene, const HeapViewing& viewing);

  int views() const { return views_; }
  /// In the heap's middle plane.
  double m_per_px() const { return m_per_px_; }

  TakenView take(render::Renderer& renderer, int view,
                 const vision::MeasureOptions& options = {}) const;

  /// Draws one view and measures it; saves it with its overlay if a file is named. Several views
  /// may be measured concurrently, each with its own renderer.
  HeapView measure(render::Renderer& renderer, int view,
                   const std::filesystem::path& overlay_file = {}) const;

 private:
  double azimuth_rad(int view) const;
  render::Camera camera_at(double azimuth_rad) const;

  render::Scene scene_;
  int views_;
  render::OrthographicCamera far_;
  std::optional<render::LabStand> stand_;  ///< std::nullopt: the camera is far away
  double m_per_px_ = 0;
  render::PictureSize size_;
};

/// Measures all views of a heap; the result does not depend on the number of threads.
/// @param report  called with the completed fraction, from any thread; returning false interrupts
///   it
/// @throws dem::Interrupted  `report` asked for it.
/// @throws std::runtime_error  this machine cannot draw.
std::vector<HeapView> measure_views(const HeapViewSession& session, int threads,
                                    const std::function<bool(double fraction)>& report);

/// Mean of the views, as for any pictures, by a definition of base/angle_definition.h; empty: the
/// default.
PictureMean mean_of_views(std::span<const HeapView> views, const std::string& definition = {});

/// Whether at least half of the views gave a number by this definition, so that photographs are
/// compared with their mean.
bool is_well_pictured(std::span<const HeapView> views, const std::string& definition = {});

/// All empty if less than half of the flanks (two per view) could be fitted: the grains still stand
/// as in the tube, or lie in a layer. A few sloping flanks then do not make a heap.
struct PositionAngle {
  std::optional<double> angle_deg;          ///< mean of the views that have a flank
  std::optional<double> between_views_deg;  ///< standard deviation; std::nullopt for a single view
  std::optional<double> first_view_deg;  ///< of the first view alone; std::nullopt without a flank
  std::optional<double> base_radius_m;  ///< from the crest to where the lines meet the ground; mean
  int flanks = 0;                       ///< number that could be fitted
  /// By the other definitions of base/angle_definition.h, keyed by name: the mean of the views, if
  /// at least half of them allow it. Only if options.has_definitions.
  std::map<std::string, double> other_deg;
};

/// A view's angle is the mean of its flanks' angles. Without `options.grain` it agrees with the
/// measured silhouette of the same view, which does not show the grain size either: for 26 views of
/// 8 simulated heaps, 23 lay within .11 degrees, the worst 2.4 off; with the known grain size 19
/// did, the worst 3.5 off.
/// @throws base::InputError  as vision::measure_outline().
PositionAngle position_angle(std::span<const dem::Envelope> envelopes,
                             const vision::OutlineOptions& options = {});

}  // namespace repose::calibrate
