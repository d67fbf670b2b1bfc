#include "vision/camera/heap_marks.h"

#include <algorithm>
#include <cmath>

#include "base/distributions.h"

namespace repose::vision {
namespace {

// Where the ground line touches the base, from the axis to the nearest rim, and the half-width of
// that: a base that bows much is stood on the line through its feet, if no edge is found below.
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
  // Segmentations lose what is thinner than a pixel: of a flat foot more than of a steep one.
  const double slope = std::max(0.1, std::tan(measured.angle_rad.value_or(0)));
  return {.foot = std::hypot(working_px / slope, 0.3 * grain),
          .crest = std::hypot(0.5 * working_px, 0.1 * grain),
          .ground = std::hypot(working_px, 0.1 * grain)};
}

}  // namespace

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

}  // namespace repose::vision
