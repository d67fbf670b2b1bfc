#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/input_error.h"
#include "dem/vector.h"

/// Camera models and positions.
///
/// At azimuth 0 the camera looks along +y: x is to the right and z upwards, the XZ view. Increasing
/// azimuth moves the camera counter-clockwise round the heap, seen from above.
namespace repose::render {

struct PictureSize {
  int width = 1920;
  int height = 1080;

  /// Empty if usable; otherwise what is wrong, the rule, and what to do.
  std::vector<base::Fault> problems() const;
};

/// Horizontal, parallel rays: the scale is the same at all depths.
struct OrthographicCamera {
  double azimuth_rad = 0;
  /// Millimetres per pixel; if not given, all grains fit into the picture.
  std::optional<double> mm_per_px = {};
  /// The point shown in the middle of the picture; by default the middle of the grains.
  std::optional<dem::Vector> middle_m = {};
};

/// Width of 35 mm film, to which focal lengths refer.
inline constexpr double kFilmWidth_mm = 36;

/// A laboratory camera with a lens.
struct PerspectiveCamera {
  dem::Vector position_m = dem::Vector::Zero();  ///< of the lens
  double azimuth_rad = 0;                        ///< viewing direction
  double pitch_rad = 0;                          ///< > 0 looks down
  double roll_rad = 0;   ///< > 0 lowers the ground's right end in the picture
  double focal_mm = 85;  ///< for a picture kFilmWidth_mm wide
  /// Radial distortion: a point at distance r from the axis (in focal lengths) is seen at
  /// r (1 + k1 r^2 + k2 r^4). Below 0: barrel. Source: Brown, Photogrammetric Engineering 37 (1971)
  /// 855-866, without its tangential part. Proved by Projection.* in
  /// tests/render/projection_test.cpp.
  double k1 = 0;
  double k2 = 0;
};

using Camera = std::variant<OrthographicCamera, PerspectiveCamera>;

/// A camera on a tripod in front of the grains' middle.
struct LabStand {
  double azimuth_rad = 0;
  double distance_m = 1.5;               ///< from the grains' middle, along the floor
  std::optional<double> height_m = {};   ///< above ground; default: the axis meets the middle
  std::optional<double> pitch_rad = {};  ///< by default level
  std::optional<double> focal_mm = {};   ///< by default the grains fit into the picture
};

struct Scene;

/// The camera on that stand.
/// @throws base::InputError  no grains, or a distance not above 0.
PerspectiveCamera camera_on(const LabStand& stand, const Scene& scene, const PictureSize& size);

/// The same camera with scale and middle set so that all grains fit into the picture from any
/// azimuth, for pictures of a heap from all sides.
/// @throws base::InputError  no grains.
OrthographicCamera fitted_all_around(const OrthographicCamera& camera, const Scene& scene,
                                     const PictureSize& size);

/// The same stand with the focal length set so that all grains and the ground below them fit into
/// the picture from any azimuth.
/// @throws base::InputError  no grains, or some extend as far as the camera.
LabStand fitted_stand(const LabStand& stand, const Scene& scene, const PictureSize& size);

}  // namespace repose::render
