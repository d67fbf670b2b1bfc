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

/// The angle of a heap: from the places of its grains, by the line that pictures are measured with;
/// and as a camera would give it, in silhouettes from all around, each measured like a photograph.
/// The mean of several pictures has one rule for simulated heaps and those of a bench, since they
/// are compared with each other.
namespace repose::calibrate {

/// What one picture gave.
struct PictureAngle {
  vision::MeasureStatus status = vision::MeasureStatus::refused;
  std::optional<double> angle_rad;
  /// By the other definitions of base/angle_definition.h, by name; those that it allows.
  std::map<std::string, double> other_rad = {};
};

PictureAngle picture_angle_of(const vision::ReposeAngle& measured);

/// By a definition; empty: by the usual one. None of a picture that is refused.
std::optional<double> angle_by(const PictureAngle& picture, const std::string& definition);

/// Whether a picture's angle counts towards a mean: every one that could be measured does, flagged
/// ones too. A flag says that a heap looks low or hollow from there, or that its interval is wide;
/// it does not make the number wrong, and to leave out just those moves the mean: of six simulated
/// heaps seen from many sides, the views without a flag read 1.3 degrees less than all. Their
/// number is said wherever there is a mean, and each keeps its own, wider interval.
bool counts_in_mean(vision::MeasureStatus status);
/// The same, of a status by its name in JSON: "flagged".
bool counts_in_mean(std::string_view status);

struct PictureMean {
  std::optional<Summary> angle_deg;  ///< none when no picture counts
  int flagged = 0;                   ///< of those that count
  int refused = 0;                   ///< or without an angle by the definition
};

PictureMean mean_of_pictures(std::span<const PictureAngle> pictures,
                             const std::string& definition = {});

/// Sides from which a heap is drawn, unless asked otherwise.
/// With more, neighbouring views show the same grains: the scatter between heaps is what remains.
inline constexpr int kHeapViews = 9;

/// How pictures of a heap are taken.
struct HeapViewing {
  /// Sides, equally spaced over half a turn; the first is the XZ view. 0: no pictures.
  int views = kHeapViews;
  /// None: it is so far away that its rays are parallel.
  std::optional<dem::LevelCamera> camera = {};
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

/// All empty where less than half of the flanks could be fitted, two a view: the grains still stand
/// as they stood in the tube, or lie in a layer. The few that lean then say nothing of a heap.
struct PositionAngle {
  std::optional<double> angle_deg;          ///< mean of the views that have a flank
  std::optional<double> between_views_deg;  ///< standard deviation; none of a single view
  std::optional<double> first_view_deg;     ///< of the first view alone; none without a flank
  std::optional<double> base_radius_m;  ///< from the crest to where the lines meet the ground; mean
  int flanks = 0;                       ///< how many there were to fit
  /// By the other definitions of base/angle_definition.h, by name: the mean of the views, where at
  /// least half of them allow it. Only if options.has_definitions.
  std::map<std::string, double> other_deg;
};

/// A view's angle is the mean of its flanks'. Without `options.grain` it is as a silhouette of the
/// same view is measured: of 26 views of 8 simulated heaps 23 lay within .11 degrees, the worst 2.4
/// off. A silhouette does not show its grains either: with their known size 19 did, the worst 3.5
/// off.
/// @throws base::InputError  as vision::measure_outline().
PositionAngle position_angle(std::span<const dem::Envelope> envelopes,
                             const vision::OutlineOptions& options = {});

}  // namespace repose::calibrate
