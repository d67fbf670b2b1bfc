#include "vision/compare/heap_comparison.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/units.h"
#include "vision/compare/angle_difference.h"
#include "vision/compare/skyline.h"

namespace repose::vision {

namespace {

using Measured = std::array<const ReposeAngle*, 2>;

const char* name_of_picture(int picture) { return picture == 0 ? "first" : "second"; }

void note(HeapComparison& result, std::string code, std::string message) {
  result.warnings.push_back({std::nullopt, {std::move(code), std::move(message)}});
}

void note_side(HeapComparison& result, const SideComparison& side, const char* name,
               const std::array<const Flank*, 2>& flanks) {
  if (side.cover == Coverage::whole) return;
  std::string where;
  for (const int picture : {0, 1}) {
    const Flank& flank = *flanks[static_cast<std::size_t>(picture)];
    const bool is_missing =
        side.cover == Coverage::none ? flank.status == FlankStatus::absent : flank.leaves_frame;
    if (!is_missing) continue;
    if (!where.empty()) where += " and the ";
    where += name_of_picture(picture);
  }
  if (side.cover == Coverage::none) {
    note(result, "side_not_compared",
         fmt::format("There is no {} flank in the {} picture: that side is not compared.", name,
                     where));
  } else {
    note(result, "side_cut",
         fmt::format("The {} foot is out of the frame in the {} picture: that side is compared as "
                     "far as both show it.",
                     name, where));
  }
}

void note_scale(HeapComparison& result, const CompareOptions& options) {
  if (result.unit == LengthUnit::metre) return;
  if (options.scale[0]) {
    note(result, "base_not_seen",
         "The base is not fully visible in both pictures, so its known width gives no scale.");
  }
  note(result, "no_scale",
       fmt::format("Without a scale only shapes are compared, scaled to the same {}: it cannot be "
                   "told which heap is larger.",
                   result.unit == LengthUnit::height ? "height" : "area"));
}

void note_angles(HeapComparison& result, const Measured& measured, const CompareOptions& options) {
  if (measured[0]->window != measured[1]->window || measured[0]->method != measured[1]->method) {
    note(result, "unlike_definitions",
         "The two angles are measured by different methods or windows, which accounts for part of "
         "their difference.");
  }
  if (options.same_measurement) {
    note(result, "same_picture",
         "Both are the same picture, with the same errors, so their difference has none.");
  }
  if (!result.angle) return;
  const bool left = result.left.angle.has_value();
  const bool right = result.right.angle.has_value();
  if (!left && !right) {
    note(result, "unlike_sides",
         "No flank was measured in both pictures: the angles of opposite sides are compared, in "
         "which a camera's roll counts twice.");
  } else if (left != right) {
    note(result, "one_side",
         fmt::format("The angles are those of the {} sides only.", left ? "left" : "right"));
  }
  const auto differs = [](const SideComparison& side) {
    return side.angle && side.angle->verdict == Agreement::different;
  };
  if (result.angle->verdict == Agreement::equivalent &&
      (differs(result.left) || differs(result.right))) {
    note(result, "sides_differ",
         "The mean angles are equivalent, but a side's angle differs: one heap leans.");
  }
}

/// Adds the pictures' own warnings, and what could not be compared and why.
void add_notes(HeapComparison& result, const Measured& measured, const CompareOptions& options) {
  for (const int picture : {0, 1}) {
    const ReposeAngle& heap = *measured[static_cast<std::size_t>(picture)];
    if (heap.status == MeasureStatus::refused) {
      result.warnings.push_back(
          {picture,
           {"angle_refused", "Its outline is compared, but its angle is refused: " + heap.reason}});
    }
    for (const Warning& warning : heap.warnings) result.warnings.push_back({picture, warning});
  }
  note_side(result, result.left, "left", {&measured[0]->left, &measured[1]->left});
  note_side(result, result.right, "right", {&measured[0]->right, &measured[1]->right});
  note_angles(result, measured, options);
  if (result.is_aligned_by_crest && result.iou) {
    note(result, "aligned_by_crest",
         "The outlines are aligned by their crests, which depend on single grains: see what the "
         "best shift changes.");
  }
  note_scale(result, options);
}

struct OutlineScale {
  LengthUnit unit = LengthUnit::root_area;
  std::array<double, 2> unit_per_px = {};
};

/// std::nullopt if the known base was not measured.
std::optional<double> metres_per_px(const ReposeAngle& measured, const PictureScale& scale) {
  if (scale.from == PictureScale::From::pixel) return scale.length_m;
  const auto shows_foot = [](const Flank& flank) {
    return flank.status == FlankStatus::ok && !flank.leaves_frame;
  };
  if (!shows_foot(measured.left) || !shows_foot(measured.right)) return std::nullopt;
  return scale.length_m / *measured.base_px;
}

/// Area of the compared sides [px^2]; std::nullopt if a foot is missing from one of them.
std::optional<double> compared_area(const Skyline& skyline, const Reach& reach) {
  double area = 0;
  const double from = std::min(0.0, skyline.front().along);
  const double to = std::max(0.0, skyline.back().along);
  const std::array stretches = {std::array{from, 0.0}, std::array{0.0, to}};
  for (const std::size_t side : {0, 1}) {
    if (reach.cover[side] == Coverage::part) return std::nullopt;
    if (reach.cover[side] == Coverage::none) continue;
    area += difference_of(skyline, skyline, stretches[side][0], stretches[side][1]).covered;
  }
  if (area <= 0) return std::nullopt;
  return area;
}

/// The given scales; otherwise equal areas of the compared parts; otherwise, if a foot is out of
/// the frame or no side is in both pictures, equal heights. `skylines` are aligned, in px.
OutlineScale outline_scale(const std::array<const ReposeAngle*, 2>& measured,
                           const std::array<Skyline, 2>& skylines, const Reach& reach,
                           const CompareOptions& options) {
  if (options.scale[0] && options.scale[1]) {
    const auto first = metres_per_px(*measured[0], *options.scale[0]);
    const auto second = metres_per_px(*measured[1], *options.scale[1]);
    if (first && second) return {LengthUnit::metre, {*first, *second}};
  }
  const auto first = compared_area(skylines[0], reach);
  const auto second = compared_area(skylines[1], reach);
  if (first && second) {
    return {LengthUnit::root_area, {1 / std::sqrt(*first), 1 / std::sqrt(*second)}};
  }
  return {LengthUnit::height, {1 / *measured[0]->height_px, 1 / *measured[1]->height_px}};
}

constexpr double kWidestShift = 0.25;  // of the wider base
constexpr int kShiftSteps = 50;        // in each direction
constexpr int kShiftHalvings = 12;     // to .0001 % of the base

using Measured = std::array<const ReposeAngle*, 2>;
using Skylines = std::array<Skyline, 2>;

/// Both heaps on level ground, with their axes at 0.
struct Aligned {
  Skylines skylines;  ///< px of each picture
  std::array<double, 2> height = {};
  std::array<Point, 2> axis_px;
  bool by_crest = false;
};

Aligned align(const Measured& measured) {
  const std::array heaps = {standing_heap(*measured[0]), standing_heap(*measured[1])};
  Aligned aligned;
  aligned.by_crest = !heaps[0].axis || !heaps[1].axis;
  for (const std::size_t i : {0, 1}) {
    const double origin = aligned.by_crest ? heaps[i].crest : *heaps[i].axis;
    aligned.skylines[i] = placed(heaps[i].skyline, origin, 1);
    aligned.height[i] = heaps[i].height;
    aligned.axis_px[i] = heaps[i].on_ground(origin);
  }
  return aligned;
}

SkylineDifference difference_on(const Skylines& heaps, const Reach& reach, Side side) {
  const auto [from, to] = reach.stretch(heaps[0], heaps[1], side);
  return difference_of(heaps[0], heaps[1], from, to);
}

SkylineDifference difference_on_both(const Skylines& heaps, const Reach& reach) {
  SkylineDifference total = difference_on(heaps, reach, Side::left);
  total += difference_on(heaps, reach, Side::right);
  return total;
}

/// Finds the shift at which the second heap fits the first best: the best of equal steps, then
/// refined between its neighbours. Judged by the rms of the heights, as the overlap does not change
/// while one outline moves inside the other.
void find_best_shift(HeapComparison& result, const Skylines& heaps, const Reach& reach) {
  const auto rmse_at = [&](double shift) {
    return difference_on_both({heaps[0], placed(heaps[1], -shift, 1)}, reach).rmse();
  };
  const auto width = [](const Skyline& heap) { return heap.back().along - heap.front().along; };
  const double coarse = kWidestShift * std::max(width(heaps[0]), width(heaps[1])) / kShiftSteps;
  double best = 0;
  double best_rmse = rmse_at(0);
  const auto try_shift = [&](double shift) {
    const double rmse = rmse_at(shift);
    if (rmse >= best_rmse) return;
    best = shift;
    best_rmse = rmse;
  };
  for (int i = 1; i <= kShiftSteps; ++i) {
    try_shift(i * coarse);
    try_shift(-i * coarse);
  }
  double step = coarse;
  for (int i = 0; i < kShiftHalvings; ++i) {
    step /= 2;
    const double centre = best;
    try_shift(centre + step);
    try_shift(centre - step);
  }
  result.best_shift = best;
  result.best_shift_rmse = best_rmse;
}

SideComparison compare_side(const Measured& measured, const Skylines& heaps, const Reach& reach,
                            Side side, const CompareOptions& options) {
  SideComparison result;
  const std::size_t at = side == Side::left ? 0 : 1;
  const auto flank = [&](std::size_t i) -> const Flank& {
    return side == Side::left ? measured[i]->left : measured[i]->right;
  };
  result.cover = reach.cover[at];
  if (result.cover != Coverage::none) {
    const SkylineDifference difference = difference_on(heaps, reach, side);
    result.iou = difference.iou();
    result.profile_rmse = difference.rmse();
    result.profile_mean = difference.mean();
  }
  for (const std::size_t i : {0, 1}) {
    if (flank(i).status != FlankStatus::ok || flank(i).leaves_frame) continue;
    result.run_out[i] = side == Side::left ? -heaps[i].front().along : heaps[i].back().along;
  }
  if (flank(0).angle_rad && flank(1).angle_rad) {
    result.angle = angle_difference({*flank(0).angle_rad, flank(0).uncertainty_rad.value_or(0)},
                                    {*flank(1).angle_rad, flank(1).uncertainty_rad.value_or(0)},
                                    options.margin_rad, options.same_measurement);
  }
  return result;
}

/// The angles to subtract: of both sides, or of one side alone.
void compare_angles(HeapComparison& result, const Measured& measured,
                    const CompareOptions& options) {
  const bool left = result.left.angle.has_value();
  const bool right = result.right.angle.has_value();
  std::array<UncertainAngle, 2> angles;
  for (const std::size_t i : {0, 1}) {
    const ReposeAngle& heap = *measured[i];
    const Flank& one = left ? heap.left : heap.right;
    const bool takes_one = left != right && one.angle_rad;
    result.angle_rad[i] = takes_one ? one.angle_rad : heap.angle_rad;
    result.uncertainty_rad[i] = takes_one ? one.uncertainty_rad : heap.uncertainty_rad;
    angles[i] = {result.angle_rad[i].value_or(0), result.uncertainty_rad[i].value_or(0)};
  }
  if (!result.angle_rad[0] || !result.angle_rad[1]) return;
  result.angle =
      angle_difference(angles[0], angles[1], options.margin_rad, options.same_measurement);
}

/// Areas were made equal, so the mean difference of heights is 0 by construction and means nothing.
void forget_made_equal(HeapComparison& result) {
  if (result.unit != LengthUnit::root_area) return;
  result.profile_mean.reset();
  if (result.left.cover == Coverage::none) result.right.profile_mean.reset();
  if (result.right.cover == Coverage::none) result.left.profile_mean.reset();
}

/// All results from the outlines alone, in the unit.
void compare_outlines(HeapComparison& result, const Measured& measured, const Skylines& heaps,
                      const Reach& reach) {
  for (const std::size_t i : {0, 1}) {
    const bool shows_feet = result.left.run_out[i] && result.right.run_out[i];
    if (shows_feet) result.base[i] = *measured[i]->base_px * result.unit_per_px[i];
  }
  const SkylineDifference total = difference_on_both(heaps, reach);
  if (total.length <= 0) return;
  result.iou = total.iou();
  result.profile_rmse = total.rmse();
  result.profile_mean = total.mean();
  const double from = reach.stretch(heaps[0], heaps[1], Side::left)[0];
  const double to = reach.stretch(heaps[0], heaps[1], Side::right)[1];
  const EdgeDistance distance =
      edge_distance(part_of(heaps[0], from, to), part_of(heaps[1], from, to));
  result.hausdorff = distance.largest;
  result.hausdorff_95 = distance.most_of_it;
  find_best_shift(result, heaps, reach);
  forget_made_equal(result);
}

bool has_outline(const ReposeAngle* measured) {
  return measured->status != MeasureStatus::refused || measured->outline_valid;
}

HeapComparison refused(const Measured& measured) {
  HeapComparison result;
  for (const std::size_t i : {0, 1}) {
    if (has_outline(measured[i])) continue;
    if (!result.reason.empty()) result.reason += '\n';
    result.reason +=
        fmt::format("{} picture: {}", i == 0 ? "first" : "second", measured[i]->reason);
  }
  return result;
}

void check(const CompareOptions& options) {
  std::vector<base::Fault> errors = options.problems();
  if (!errors.empty()) throw base::InputError(std::move(errors));
}

bool is_doubtful(const ReposeAngle* measured) { return measured->status != MeasureStatus::ok; }

}  // namespace

std::vector<base::Fault> CompareOptions::problems() const {
  std::vector<base::Fault> errors;
  constexpr double kWidestMargin_rad = 45 * kDegree;
  // Written so that NaN fails.
  if (!(margin_rad > 0 && margin_rad <= kWidestMargin_rad)) {
    errors.push_back({.subject = "margin",
                      .value = fmt::format("= {:g} degrees", margin_rad / kDegree),
                      .rule = "must be more than 0 and at most 45",
                      .fix = "give the difference that you consider negligible, such as 2."});
  }
  if (scale[0].has_value() != scale[1].has_value()) {
    errors.push_back({.value = "only one picture has a scale", .fix = "give both, or none."});
  }
  for (const auto& one : scale) {
    if (one && !(one->length_m > 0 && std::isfinite(one->length_m))) {
      errors.push_back({.subject = "scale",
                        .value = fmt::format("= {:g} m", one->length_m),
                        .rule = "must be more than 0",
                        .fix = "give the length of one pixel, or of the base."});
    }
  }
  return errors;
}

HeapComparison compare_heaps(const ReposeAngle& first, const ReposeAngle& second,
                             const CompareOptions& options) {
  check(options);
  const Measured measured = {&first, &second};
  if (!has_outline(&first) || !has_outline(&second)) return refused(measured);
  HeapComparison result;
  const bool is_any_doubtful = std::any_of(measured.begin(), measured.end(), is_doubtful);
  result.status = is_any_doubtful ? MeasureStatus::flagged : MeasureStatus::ok;

  const Aligned aligned = align(measured);
  result.is_aligned_by_crest = aligned.by_crest;
  result.axis_px = aligned.axis_px;
  const Reach reach = reach_of(first, second);
  const OutlineScale scale = outline_scale(measured, aligned.skylines, reach, options);
  result.unit = scale.unit;
  result.unit_per_px = scale.unit_per_px;
  Skylines heaps;
  for (const std::size_t i : {0, 1}) {
    heaps[i] = placed(aligned.skylines[i], 0, scale.unit_per_px[i]);
    result.height[i] = aligned.height[i] * scale.unit_per_px[i];
  }
  result.left = compare_side(measured, heaps, reach, Side::left, options);
  result.right = compare_side(measured, heaps, reach, Side::right, options);
  compare_angles(result, measured, options);
  compare_outlines(result, measured, heaps, reach);
  add_notes(result, measured, options);
  result.outlines = heaps;
  return result;
}

}  // namespace repose::vision
