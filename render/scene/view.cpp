#include "render/scene/view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "base/input_error.h"
#include "render/scene/extent.h"

namespace repose::render {
namespace {

using dem::Vector;

/// Drivers silently draw nothing beyond this.
constexpr int kLongestSide = 16384;
/// A picture of this many pixels takes about 2 GB while it is drawn.
constexpr std::int64_t kMaxPixels = 64'000'000;
/// Left free on each side of the grains, as a fraction of the picture's width or height.
constexpr double kMargin = .1;
/// The smallest slope to which distortion may flatten the picture.
constexpr double kMinSlope = .1;

void check(const PictureSize& size) {
  std::vector<base::Fault> problems = size.problems();
  if (!problems.empty()) throw base::InputError(std::move(problems));
}

void check_number(const char* name, double value, double least, double most, const char* fix) {
  if (value >= least && value <= most) return;
  throw base::InputError({.where = "camera",
                          .subject = name,
                          .value = fmt::format("is {:g}", value),
                          .rule = fmt::format("from {:g} to {:g}", least, most),
                          .fix = fix});
}

/// Rows: right, down, into the picture.
Eigen::Matrix3d axes_at(double azimuth_rad, double pitch_rad, double roll_rad) {
  const Eigen::Matrix3d walk = Eigen::AngleAxisd(-azimuth_rad, Vector::UnitZ()).toRotationMatrix();
  Eigen::Matrix3d level;
  level << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  const Eigen::Matrix3d pitch = Eigen::AngleAxisd(pitch_rad, Vector::UnitX()).toRotationMatrix();
  const Eigen::Matrix3d roll = Eigen::AngleAxisd(roll_rad, Vector::UnitZ()).toRotationMatrix();
  return roll * pitch * level * walk;
}

void require_grains(bool has_some) {
  if (has_some) return;
  throw base::InputError({.where = "scene",
                          .value = "it has no grains to be seen",
                          .fix = "a state in which some are left."});
}

Eigen::AlignedBox3d bounds_to_fit(const Scene& scene, const Eigen::Matrix3d& axes) {
  const Eigen::AlignedBox3d bounds = grain_bounds(scene, axes);
  require_grains(!bounds.isEmpty() && bounds.sizes().allFinite());
  return bounds;
}

/// Chooses what the camera leaves open so that all grains are visible.
void fit(View& view, const Scene& scene, const OrthographicCamera& camera) {
  const Eigen::AlignedBox3d bounds = bounds_to_fit(scene, view.axes);
  const Vector extent = bounds.sizes();
  const double room = 1 - 2 * kMargin;
  const double fitting =
      std::min(room * view.size.width / extent.x(), room * view.size.height / extent.y());
  if (!camera.mm_per_px) view.scale = fitting;
  if (!camera.middle_m) view.eye = view.axes.transpose() * bounds.center();
}

View orthographic(const Scene& scene, const OrthographicCamera& camera, const PictureSize& size) {
  check_number("azimuth_rad", camera.azimuth_rad, -1e6, 1e6, "0");
  View view{.size = size, .axes = axes_at(camera.azimuth_rad, 0, 0)};
  if (camera.mm_per_px) {
    check_number("mm_per_px", *camera.mm_per_px, 1e-6, 1e6, "leave it out to see all grains.");
    view.scale = 1e3 / *camera.mm_per_px;
  }
  if (camera.middle_m) view.eye = *camera.middle_m;
  if (camera.mm_per_px && camera.middle_m) {
    require_grains(scene.setting || !scene.grains.empty());  // their extent is not needed
  } else {
    fit(view, scene, camera);
  }
  for (const double coordinate : view.eye) {
    check_number("middle_m", coordinate, -1e4, 1e4, "leave it out to see all grains.");
  }
  view.middle = {.5 * size.width, .5 * size.height};
  return view;
}

double slope_at(const View& view, double r) {
  const double r2 = r * r;
  return 1 + 3 * view.k1 * r2 + 5 * view.k2 * r2 * r2;
}

/// Finds the radius up to which the distortion is invertible; it must cover the whole picture.
void limit_distortion(View& view) {
  const double corner = std::hypot(view.middle.x, view.middle.y) / view.scale;
  constexpr int kSteps = 1000;
  constexpr double kFarthest = 2;  // corner distances: a barrel lens sees beyond its picture
  view.greatest_r = kFarthest * corner;
  for (int k = 0; k <= kSteps; ++k) {
    const double r = kFarthest * corner * k / kSteps;
    if (slope_at(view, r) >= kMinSlope) continue;
    view.greatest_r = kFarthest * corner * std::max(0, k - 1) / kSteps;
    break;
  }
  if (distorted_r(view, view.greatest_r) >= corner) return;
  throw base::InputError(
      {.where = "camera",
       .value = fmt::format("the distortion k1 = {:g}, k2 = {:g} folds the picture before its "
                            "corner ({:.3g} focal lengths from the axis)",
                            view.k1, view.k2, corner),
       .fix = "smaller numbers, or a longer focal length."});
}

/// Vertical, containing all grains of a scene.
struct Cylinder {
  Vector middle;
  double radius = 0;
  double half_height = 0;
};

Cylinder cylinder_around(const Scene& scene) {
  Cylinder around{.middle = bounds_to_fit(scene, Eigen::Matrix3d::Identity()).center()};
  const std::vector<double> reaches_m = reaches_of(scene);
  for (const PlacedGrain& grain : scene.grains) {
    const Vector away = grain.pose.position - around.middle;
    const double own = reaches_m[static_cast<std::size_t>(grain.shape)];
    around.radius = std::max(around.radius, std::hypot(away.x(), away.y()) + own);
    around.half_height = std::max(around.half_height, std::abs(away.z()) + own);
  }
  return around;
}

/// The scale at which an object of this half size fits into the picture.
double fitting_px_per_m(double half_width_m, double half_height_m, const PictureSize& size) {
  const double room = 1 - 2 * kMargin;
  return std::min(.5 * room * size.width / half_width_m, .5 * room * size.height / half_height_m);
}

/// Distance of the near side of an object that extends `reach_m` from its middle: that side must
/// fit.
double nearest_of(double distance_m, double reach_m) {
  return std::max(distance_m - reach_m, .1 * distance_m);
}

/// The eye must not be between or in grains, nor below the ground.
void check_outside(const Scene& scene, const Vector& eye) {
  bool has_above = false, has_below = false;
  const std::vector<double> reaches_m = reaches_of(scene);
  for (const PlacedGrain& grain : scene.grains) {
    const double reach = reaches_m[static_cast<std::size_t>(grain.shape)];
    const Vector away = eye - grain.pose.position;
    if (away.norm() <= reach) has_above = has_below = true;
    if (std::hypot(away.x(), away.y()) > reach) continue;
    (away.z() > 0 ? has_below : has_above) = true;
  }
  if (has_above && has_below) {
    throw base::InputError(
        {.where = "camera",
         .value = fmt::format("at ({:.4g}, {:.4g}, {:.4g}) m it is inside the heap", eye.x(),
                              eye.y(), eye.z()),
         .fix = "a greater distance."});
  }
  const auto ground = ground_m(scene);
  if (ground && eye.z() <= *ground) {
    throw base::InputError(
        {.where = "camera",
         .value = fmt::format("at z = {:.4g} m it is under the ground, {:.4g} m", eye.z(), *ground),
         .fix = "a height above 0."});
  }
}

View perspective(const Scene& scene, const PerspectiveCamera& camera, const PictureSize& size) {
  constexpr double kHalfTurn = std::numbers::pi / 2;
  check_number("azimuth_rad", camera.azimuth_rad, -1e6, 1e6, "0");
  check_number("pitch_rad", camera.pitch_rad, -kHalfTurn, kHalfTurn, "0");
  check_number("roll_rad", camera.roll_rad, -2 * kHalfTurn, 2 * kHalfTurn, "0");
  check_number("focal_mm", camera.focal_mm, 1, 1e5, "85, for a picture 36 mm wide.");
  check_number("k1", camera.k1, -1e3, 1e3, "0");
  check_number("k2", camera.k2, -1e3, 1e3, "0");
  for (const double coordinate : camera.position_m) {
    check_number("position_m", coordinate, -1e4, 1e4, "a place beside the heap.");
  }
  bounds_to_fit(scene, Eigen::Matrix3d::Identity());
  check_outside(scene, camera.position_m);
  View view{.size = size,
            .axes = axes_at(camera.azimuth_rad, camera.pitch_rad, camera.roll_rad),
            .eye = camera.position_m,
            .is_perspective = true,
            .scale = camera.focal_mm / kFilmWidth_mm * size.width,
            .middle = {.5 * size.width, .5 * size.height},
            .k1 = camera.k1,
            .k2 = camera.k2};
  limit_distortion(view);
  return view;
}

}  // namespace

std::vector<base::Fault> PictureSize::problems() const {
  if (width >= 1 && height >= 1 && width <= kLongestSide && height <= kLongestSide &&
      std::int64_t{width} * height <= kMaxPixels) {
    return {};
  }
  return {{.subject = "picture size",
           .value = fmt::format("= {} x {} pixels", width, height),
           .rule = fmt::format("each side from 1 to {}, {} megapixels at most", kLongestSide,
                               kMaxPixels / 1'000'000),
           .fix = "1920 x 1080 is usual."}};
}

double distorted_r(const View& view, double r) {
  const double inside = std::min(r, view.greatest_r), r2 = inside * inside;
  const double seen = inside * (1 + view.k1 * r2 + view.k2 * r2 * r2);
  return seen + (r - inside) * slope_at(view, inside);
}

std::optional<vision::Point> View::project(const Vector& point) const {
  const Vector local = in_camera(point);
  if (!is_perspective)
    return vision::Point{middle.x + scale * local.x(), middle.y + scale * local.y()};
  if (!(local.z() > 0)) return std::nullopt;
  const double x = local.x() / local.z(), y = local.y() / local.z();
  const double r = std::hypot(x, y);
  const double factor = scale * (r > 0 ? distorted_r(*this, r) / r : 1);
  return vision::Point{middle.x + factor * x, middle.y + factor * y};
}

double View::mm_per_px(double depth_m) const {
  return 1e3 * (is_perspective ? depth_m : 1) / scale;
}

View view_of(const Scene& scene, const Camera& camera, const PictureSize& size) {
  check(size);
  if (const auto* level = std::get_if<OrthographicCamera>(&camera)) {
    return orthographic(scene, *level, size);
  }
  return perspective(scene, std::get<PerspectiveCamera>(camera), size);
}

PerspectiveCamera camera_on(const LabStand& stand, const Scene& scene, const PictureSize& size) {
  check(size);
  check_number("distance_m", stand.distance_m, 1e-4, 1e4, "about three heap widths.");
  constexpr double kSteepest = 1.4;  // so that the grains stay in the middle of the picture
  check_number("pitch_rad", stand.pitch_rad.value_or(0), -kSteepest, kSteepest, "0");
  const Eigen::Matrix3d axes = axes_at(stand.azimuth_rad, 0, 0);
  const Eigen::AlignedBox3d bounds = bounds_to_fit(scene, axes);
  const double ground = ground_m(scene).value_or(-bounds.max().y());
  const Vector extent = bounds.sizes();
  Vector eye = bounds.center();
  const double pitch = stand.pitch_rad.value_or(0);
  if (stand.height_m) {
    eye.y() = -(ground + *stand.height_m);
  } else {
    eye.y() -= stand.distance_m * std::tan(pitch);
  }
  eye.z() -= stand.distance_m;
  const double nearest_m = nearest_of(stand.distance_m, .5 * extent.z());
  const double fitting = fitting_px_per_m(.5 * extent.x(), .5 * extent.y(), size);
  return {.position_m = axes.transpose() * eye,
          .azimuth_rad = stand.azimuth_rad,
          .pitch_rad = pitch,
          .focal_mm = stand.focal_mm.value_or(fitting * nearest_m / size.width * kFilmWidth_mm)};
}

OrthographicCamera fitted_all_around(const OrthographicCamera& camera, const Scene& scene,
                                     const PictureSize& size) {
  check(size);
  const Cylinder around = cylinder_around(scene);
  const double px_per_m = fitting_px_per_m(around.radius, around.half_height, size);
  return {.azimuth_rad = camera.azimuth_rad,
          .mm_per_px = camera.mm_per_px.value_or(1e3 / px_per_m),
          .middle_m = camera.middle_m.value_or(around.middle)};
}

LabStand fitted_stand(const LabStand& stand, const Scene& scene, const PictureSize& size) {
  check(size);
  const Cylinder around = cylinder_around(scene);
  if (!(stand.distance_m > around.radius)) {
    throw base::InputError(
        {.where = "camera",
         .subject = "distance_m",
         .value = fmt::format("is {:g}", stand.distance_m),
         .rule =
             fmt::format("above {:.3g}, as far as grains reach from their middle", around.radius),
         .fix = "the distance from the heap's middle to the lens."});
  }
  const double bottom = around.middle.z() - around.half_height;
  const double ground = ground_m(scene).value_or(bottom);
  const double eye = stand.height_m ? ground + *stand.height_m : around.middle.z();
  const double half_height =
      std::max({eye - ground, eye - bottom, around.middle.z() + around.half_height - eye});
  const double nearest_m = nearest_of(stand.distance_m, around.radius);
  LabStand fitted = stand;
  fitted.focal_mm =
      fitting_px_per_m(around.radius, half_height, size) * nearest_m / size.width * kFilmWidth_mm;
  return fitted;
}

}  // namespace repose::render
