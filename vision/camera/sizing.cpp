#include "vision/camera/sizing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

#include "base/distributions.h"
#include "base/units.h"
#include "vision/camera/heap_marks.h"
#include "vision/measure/camera_pitch.h"
#include "vision/measure/working_picture.h"

namespace repose::vision {
namespace {

/// Lengths that follow from one set of inputs; those that do not exist are 0.
struct Lengths {
  double mm_per_px = 0;
  double height = 0;
  double base = 0;
  double left = 0;
  double right = 0;

  Eigen::VectorXd numbers() const {
    Eigen::VectorXd all(6);
    all << mm_per_px, height, base, cone_volume_ml(base, height), left, right;
    return all;
  }
};

/// Directions as one sees them who stands upright and looks along the view's plane's normal.
struct Upright {
  Eigen::Vector3d ahead;
  Eigen::Vector3d right;
  Eigen::Vector3d up;

  explicit Upright(const HeapView& view)
      : ahead(view.normal), right(view.normal.cross(view.up)), up(view.up) {}

  double azimuth(const Eigen::Vector3d& direction) const {
    return std::atan2(direction.dot(right), direction.dot(ahead));
  }
  /// Height over distance along the ground.
  double slope(const Eigen::Vector3d& direction) const {
    return direction.dot(up) / std::hypot(direction.dot(right), direction.dot(ahead));
  }
};

Lengths lengths_by_view(const HeapView& view, const Marks& marks, double front_part) {
  const Upright upright(view);
  const auto azimuth = [&](Point place) { return upright.azimuth(view.direction(place)); };
  const double crest_azimuth = azimuth(marks.crest);
  const bool shows_both = marks.left_foot && marks.right_foot;
  const double axis_azimuth =
      shows_both ? (azimuth(*marks.left_foot) + azimuth(*marks.right_foot)) / 2 : crest_azimuth;
  const double distance = view.distance_mm / std::cos(axis_azimuth);  // along the ground

  Lengths lengths;
  const double crest_aside = distance * std::tan(crest_azimuth - axis_azimuth);
  double radius = 0;
  if (shows_both) {
    const double half = (azimuth(*marks.right_foot) - azimuth(*marks.left_foot)) / 2;
    radius = distance * std::sin(half);
    lengths.base = 2 * radius;
    lengths.left = radius + crest_aside;
    lengths.right = radius - crest_aside;
  } else {
    if (marks.left_foot) {
      lengths.left = distance * std::sin(crest_azimuth - azimuth(*marks.left_foot));
    }
    if (marks.right_foot) {
      lengths.right = distance * std::sin(azimuth(*marks.right_foot) - crest_azimuth);
    }
    radius = std::max(lengths.left, lengths.right);
  }
  const double ground_slope = upright.slope(view.direction(marks.below_crest));
  const double crest_slope = upright.slope(view.direction(marks.crest));
  const double to_crest = distance / std::cos(crest_azimuth - axis_azimuth);
  const double nearest = std::max(0.0, to_crest - front_part * radius);
  lengths.height = to_crest * crest_slope - nearest * ground_slope;
  // Where the axis meets the ground, along the lens's axis.
  const Eigen::Vector3d below = view.direction(marks.below_crest);
  lengths.mm_per_px = view.distance_mm / below.dot(view.normal) / view.focal_px;
  return lengths;
}

/// Of numbers(): what exists.
HeapSizes described(const Eigen::VectorXd& values, const Eigen::MatrixXd& covariance,
                    const Marks& marks) {
  const auto estimate = [&](Eigen::Index i) {
    return Estimate{values[i], base::kNormal95 * std::sqrt(covariance(i, i))};
  };
  HeapSizes sizes;
  sizes.mm_per_px = estimate(0);
  sizes.height_mm = estimate(1);
  if (marks.left_foot) sizes.left_run_out_mm = estimate(4);
  if (marks.right_foot) sizes.right_run_out_mm = estimate(5);
  if (!marks.left_foot || !marks.right_foot) return sizes;
  sizes.base_mm = estimate(2);
  sizes.cone_volume_ml = estimate(3);
  return sizes;
}

double distance_between(Point a, Point b) { return std::hypot(a.x - b.x, a.y - b.y); }

/// Why a measured heap has no sizes; empty when it has.
std::string reason_against(const ReposeAngle& measured) {
  if (measured.status == MeasureStatus::refused) return "the heap could not be measured.";
  if (!measured.ground || !measured.crest) return "no heap was found.";
  if (measured.hides_foot) {
    return "the heap's foot is hidden by the edge that was taken for the ground. Fix: raise the "
           "camera's view of the plate, or draw the ground line.";
  }
  const Marks marks = marks_of(measured);
  const double height_px = distance_between(marks.crest, marks.below_crest);
  constexpr double kFarBelow = 0.3;  // of the height: more than a round base's rim lies lower
  if (rise_of_feet(measured, marks).value_or(0) > kFarBelow * height_px) {
    return "the ground line lies far below the heap's foot: it may be another edge, such as a "
           "table's. Fix: draw the ground line.";
  }
  return {};
}

/// As parallel rays have it, but for the rim and how near the camera may be.
struct PlainView {
  double mm_per_px = 0;
  double rim_slope = 0;  ///< of the sight to the base, below the horizon
  double narrowing = 1;  ///< of the base, which a near eye sees wider than it is
};

Lengths lengths_by_scale(const PlainView& view, const Marks& marks, double front_part) {
  Lengths lengths{.mm_per_px = view.mm_per_px};
  const double scale = view.mm_per_px;
  if (marks.left_foot) {
    lengths.left = scale * view.narrowing * distance_between(*marks.left_foot, marks.below_crest);
  }
  if (marks.right_foot) {
    lengths.right = scale * view.narrowing * distance_between(*marks.right_foot, marks.below_crest);
  }
  const bool shows_both = marks.left_foot && marks.right_foot;
  if (shows_both) lengths.base = lengths.left + lengths.right;
  const double radius = shows_both ? lengths.base / 2 : std::max(lengths.left, lengths.right);
  lengths.height = scale * distance_between(marks.crest, marks.below_crest) -
                   front_part * radius * view.rim_slope;
  return lengths;
}

/// Slope of the sight to the base, and its half-width.
Estimate rim_slope_of(const ReposeAngle& measured) {
  constexpr double kBowError_rad = 1.5 * kDegree;
  constexpr double kUnseen_rad = 1.5 * kDegree;  // between level and 3 degrees
  if (measured.base_bow && *measured.base_bow > 0) {
    return {std::tan(pitch_from_bow(*measured.base_bow)), kBowError_rad};
  }
  return {std::tan(kUnseen_rad), kUnseen_rad};
}

}  // namespace

double cone_volume_ml(double base_mm, double height_mm) {
  constexpr double kMl_per_mm3 = 1e-3;
  return kMl_per_mm3 * std::numbers::pi * base_mm * base_mm * height_mm / 12;
}

double working_pixel(int width, int height, const Hints& hints) {
  const int longest =
      hints.heap ? std::max(hints.heap->width, hints.heap->height) : std::max(width, height);
  return std::max(1.0, static_cast<double>(longest) / kWorkingSide);
}

HeapSizes sizes_by_view(const ReposeAngle& measured, const Inputs& inputs,
                        const std::function<HeapView(const Eigen::VectorXd&)>& view_of,
                        double scale_part, double working_px) {
  HeapSizes sizes;
  sizes.reason = reason_against(measured);
  if (!sizes.reason.empty()) return sizes;
  const Marks marks = marks_of(measured);
  Inputs all = inputs;
  const MarkInputs of_marks(all, measured, working_px);
  const Eigen::Index scale = added(all, 1, scale_part / base::kNormal95);
  const Lengths on_axis = lengths_by_view(view_of(inputs.values), marks, 0);
  const Lengths at_rim = lengths_by_view(view_of(inputs.values), marks, 1);
  const double rim_px = (on_axis.height - at_rim.height) / on_axis.mm_per_px;
  const Estimate part = front_part_of(measured, marks, rim_px, working_px);
  const Eigen::Index front = added(all, part.value, part.uncertainty / base::kNormal95);
  const auto numbers = [&](const Eigen::VectorXd& values) -> Eigen::VectorXd {
    HeapView view = view_of(values);
    view.distance_mm *= values[scale];
    return lengths_by_view(view, of_marks.applied(marks, values), values[front]).numbers();
  };
  return described(numbers(all.values), propagated(all, numbers), marks);
}

HeapSizes sizes_by_scale(const ReposeAngle& measured, const Estimate& mm_per_px,
                         double working_px) {
  HeapSizes sizes;
  sizes.reason = reason_against(measured);
  if (!sizes.reason.empty()) return sizes;
  const Marks marks = marks_of(measured);
  // 1 of a far camera; of the nearest one R / D less: asin.
  const double most = 1 - std::sqrt(1 - 1 / (kNearestCamera * kNearestCamera));
  Inputs all;
  const MarkInputs of_marks(all, measured, working_px);
  const Eigen::Index scale = added(all, mm_per_px.value, mm_per_px.uncertainty / base::kNormal95);
  const Estimate slope = rim_slope_of(measured);
  const Eigen::Index rim = added(all, slope.value, slope.uncertainty / base::kNormal95);
  const Eigen::Index narrowing = added(all, 1 - most / 2, most / 2 / base::kNormal95);
  const double rim_px = lengths_by_scale({.mm_per_px = 1}, marks, 0).base / 2 * slope.value;
  const Estimate part = front_part_of(measured, marks, rim_px, working_px);
  const Eigen::Index front = added(all, part.value, part.uncertainty / base::kNormal95);
  const auto numbers = [&](const Eigen::VectorXd& values) -> Eigen::VectorXd {
    const PlainView view{
        .mm_per_px = values[scale], .rim_slope = values[rim], .narrowing = values[narrowing]};
    return lengths_by_scale(view, of_marks.applied(marks, values), values[front]).numbers();
  };
  return described(numbers(all.values), propagated(all, numbers), marks);
}

}  // namespace repose::vision
