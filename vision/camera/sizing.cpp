#include "vision/camera/sizing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>

#include "base/distributions.h"
#include "base/units.h"
#include "vision/camera/heap_view.h"
#include "vision/measure/camera_pitch.h"
#include "vision/measure/repose_angle.h"
#include "vision/measure/scale_bar.h"
#include "vision/measure/working_picture.h"

/// The places of a picture that determine a heap's sizes, and how well they are known.

namespace repose::vision {

namespace {

/// The places that determine a size [px].
struct Marks {
  std::optional<Point> left_foot;
  std::optional<Point> right_foot;
  Point crest;
  Point below_crest;  ///< on the ground line
};

/// Errors of the marks, as inputs.
class MarkInputs {
 public:
  /// Adds them, with the typical deviations of segmentations.
  /// @param working_px  see working_pixel()
  MarkInputs(Inputs& inputs, const ReposeAngle& measured, double working_px);

  /// The marks shifted by the inputs' values.
  Marks applied(const Marks& marks, const Eigen::VectorXd& values) const;

 private:
  Eigen::Index left_ = 0, right_ = 0, crest_ = 0, ground_ = 0;
};

// Where the ground line touches the base, from the axis to the nearest rim, and the half-width of
// that: if a base bows strongly and no edge is found below it, the ground line goes through its
// ends.
constexpr double kFrontPart = 0.75;

constexpr double kFrontPartDeviation = 0.4;

constexpr double kMuchBowed = 0.035;

constexpr double kBowedPart = 0.4;

constexpr double kBowedPartDeviation = 0.5;

Point moved(Point point, double x, double y) { return {point.x + x, point.y + y}; }

/// Standard deviations of the marks [px].
struct MarkDeviations {
  double foot = 0;
  double crest = 0;
  double ground = 0;
};

MarkDeviations deviations_of(const ReposeAngle& measured, double working_px) {
  const double grain = measured.grain_px.value_or(0);
  // Segmentations lose whatever is thinner than a pixel: more of a flat foot than of a steep one.
  const double slope = std::max(0.1, std::tan(measured.angle_rad.value_or(0)));
  return {.foot = std::hypot(working_px / slope, 0.3 * grain),
          .crest = std::hypot(0.5 * working_px, 0.1 * grain),
          .ground = std::hypot(working_px, 0.1 * grain)};
}

/// For a heap with a ground line and a crest.
Marks marks_of(const ReposeAngle& measured) {
  const Segment& ground = *measured.ground;
  const auto shows_foot = [](const Flank& flank) {
    return flank.status == FlankStatus::ok && !flank.leaves_frame;
  };
  Marks marks{.left_foot = {}, .right_foot = {}, .crest = *measured.crest, .below_crest = {}};
  if (shows_foot(measured.left)) marks.left_foot = ground.from;
  if (shows_foot(measured.right)) marks.right_foot = ground.to;
  const double dx = ground.to.x - ground.from.x;
  const double dy = ground.to.y - ground.from.y;
  const double part =
      ((marks.crest.x - ground.from.x) * dx + (marks.crest.y - ground.from.y) * dy) /
      (dx * dx + dy * dy);
  marks.below_crest = {ground.from.x + part * dx, ground.from.y + part * dy};
  return marks;
}

/// Height of the outline's ends above the ground line: a round base is widest at its middle, and
/// the lowest grains protrude most at half their size above the ground [px].
std::optional<double> rise_of_feet(const ReposeAngle& measured, const Marks& marks) {
  if (measured.upper_edge.empty()) return std::nullopt;
  const Segment& ground = *measured.ground;
  const double dx = ground.to.x - ground.from.x;
  const double dy = ground.to.y - ground.from.y;
  const auto height = [&](Point point) {
    return ((point.x - ground.from.x) * dy - (point.y - ground.from.y) * dx) / std::hypot(dx, dy);
  };
  double sum = 0;
  int count = 0;
  const auto add = [&](bool is_seen, Point end) {
    if (!is_seen) return;
    sum += height(end);
    ++count;
  };
  add(marks.left_foot.has_value(), measured.upper_edge.front());
  add(marks.right_foot.has_value(), measured.upper_edge.back());
  if (count == 0) return std::nullopt;
  return sum / count - measured.grain_px.value_or(0) / 2;
}

/// Appends an input and returns its index.
Eigen::Index added(Inputs& inputs, double value, double deviation) {
  const Eigen::Index number = inputs.values.size();
  inputs.values.conservativeResize(number + 1);
  inputs.covariance.conservativeResize(number + 1, number + 1);
  inputs.covariance.row(number).setZero();
  inputs.covariance.col(number).setZero();
  inputs.values[number] = value;
  inputs.covariance(number, number) = deviation * deviation;
  return number;
}

MarkInputs::MarkInputs(Inputs& inputs, const ReposeAngle& measured, double working_px) {
  const MarkDeviations deviation = deviations_of(measured, working_px);
  left_ = added(inputs, 0, deviation.foot);
  right_ = added(inputs, 0, deviation.foot);
  crest_ = added(inputs, 0, deviation.crest);
  ground_ = added(inputs, 0, deviation.ground);
}

Marks MarkInputs::applied(const Marks& marks, const Eigen::VectorXd& values) const {
  Marks here = marks;
  if (here.left_foot) here.left_foot = moved(*here.left_foot, values[left_], 0);
  if (here.right_foot) here.right_foot = moved(*here.right_foot, values[right_], 0);
  here.crest = moved(here.crest, 0, values[crest_]);
  here.below_crest = moved(here.below_crest, 0, values[ground_]);
  return here;
}

/// Where the ground line touches the base: the typical value and that from the outline's ends,
/// weighted by their inverse variances.
/// @param rim_px  how much lower than the axis the nearest rim is in the picture
Estimate front_part_of(const ReposeAngle& measured, const Marks& marks, double rim_px,
                       double working_px) {
  const bool is_bowed = measured.base_bow.value_or(0) > kMuchBowed;
  const Estimate usual = is_bowed ? Estimate{kBowedPart, kBowedPartDeviation}
                                  : Estimate{kFrontPart, kFrontPartDeviation};
  const std::optional<double> rise = rise_of_feet(measured, marks);
  if (!rise || rim_px <= 0) return usual;
  const Estimate seen{
      *rise / rim_px,
      base::kNormal95 * std::hypot(working_px, 0.3 * measured.grain_px.value_or(0)) / rim_px};
  const double of_usual = 1 / (usual.uncertainty * usual.uncertainty);
  const double of_seen = 1 / (seen.uncertainty * seen.uncertainty);
  return {(of_usual * usual.value + of_seen * seen.value) / (of_usual + of_seen),
          1 / std::sqrt(of_usual + of_seen)};
}

/// Lengths that follow from one set of inputs; missing ones are 0.
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

/// Horizontal and vertical directions, facing along the normal of the view's plane.
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

/// Turns numbers() into sizes, as far as they exist.
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

/// Why a measured heap has no sizes; empty if it has.
std::string reason_against(const ReposeAngle& measured) {
  if (measured.status == MeasureStatus::refused) return "the heap could not be measured.";
  if (!measured.ground || !measured.crest) return "no heap was found.";
  if (measured.foot_occluded) {
    return "the heap's foot is hidden by the edge that was taken for the ground. Fix: raise the "
           "camera's view of the plate, or draw the ground line.";
  }
  const Marks marks = marks_of(measured);
  const double height_px = distance_between(marks.crest, marks.below_crest);
  constexpr double kFarBelow = 0.3;  // of the height: more than a round base's rim can be lower
  if (rise_of_feet(measured, marks).value_or(0) > kFarBelow * height_px) {
    return "the ground line lies far below the heap's foot: it may be another edge, such as a "
           "table's. Fix: draw the ground line.";
  }
  return {};
}

/// Parallel projection, except for the rim and the camera's possible nearness.
struct PlainView {
  double mm_per_px = 0;
  double rim_slope = 0;  ///< of the line of sight to the base, below the horizon
  double narrowing = 1;  ///< of the base, which appears wider to a near camera
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

/// Slope of the line of sight to the base, with its half-width.
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
  // 1 for a distant camera; less for the nearest, by R / D: asin.
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
