#include "vision/measure/outline_angle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "vision/measure/definitions.h"
#include "vision/measure/flank.h"
#include "vision/measure/profile.h"
#include "vision/measure/repose_angle.h"

namespace repose::vision {

namespace {

/// Height at which a flank's line may meet the crest's axis, over the crest's height. It is 1 for a
/// cone; on average up to 1.7 for heaps of hazelnuts, but 14 and 15 for layers of them. Proved by
/// OutlineAngle.AWidePlateauHasNoFlank and AHeapWithAFlatTopHasFlanks.
constexpr double kHighestAtCrest = 3;
/// A layer's line is nearly level and would end far away; for heaps of hazelnuts the ratio is up to
/// 1.2. Proved by OutlineAngle.TheFootOfALayerIsNearItsEnd.
constexpr double kFarthestFoot = 2;

bool are_finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double value) { return std::isfinite(value); });
}

void check(const Outline& outline, const OutlineOptions& options) {
  MeasureOptions window;
  window.window_from = options.window_from;
  window.window_to = options.window_to;
  std::vector<base::Fault> errors = window.problems();
  if (outline.along.empty() || outline.along.size() != outline.height.size()) {
    errors.push_back({.value = fmt::format("the outline has {} places and {} heights",
                                           outline.along.size(), outline.height.size()),
                      .rule = "one or more, and a height at each place",
                      .fix = "give one height for each place."});
  }
  if (!are_finite(outline.along) || !are_finite(outline.height)) {
    errors.push_back(
        {.value = "the outline has a point that is not a number", .fix = "leave such points out."});
  }
  const auto& along = outline.along;
  if (std::adjacent_find(along.begin(), along.end(), [](double a, double b) { return a >= b; }) !=
      along.end()) {
    errors.push_back(
        {.value = "the outline goes back", .rule = "places ascend", .fix = "sort its points."});
  }
  if (options.grain && !(*options.grain > 0)) {
    errors.push_back({.subject = "grain",
                      .value = fmt::format("= {:g}", *options.grain),
                      .rule = "must be above 0",
                      .fix = "a grain's diameter, or none."});
  }
  if (!errors.empty()) throw base::InputError(std::move(errors));
}

/// Spacing of neighbouring points: the unit in which an outline resembles a picture's edge, which
/// has one point per pixel column.
double spacing_of(const Outline& outline) {
  if (outline.along.size() < 2) return 1;
  const auto gaps = static_cast<double>(outline.along.size() - 1);
  return (outline.along.back() - outline.along.front()) / gaps;
}

Profile profile_of(const Outline& outline, double spacing) {
  Profile profile;
  for (const double along : outline.along) profile.along.push_back(along / spacing);
  for (const double height : outline.height) profile.height.push_back(height / spacing);
  set_crest(profile);
  return profile;
}

/// As for a picture, but level lines and the edges of plateaus are not flanks.
FlankFit fit_of(const Profile& profile, Side side, const FlankOptions& options) {
  FlankFit fit = fit_flank(profile, side, options);
  if (fit.status != FlankStatus::ok) return fit;
  const bool is_level = fit.shown.slope >= -kFlattestSlope;
  const bool is_plateau = fit.shown.intercept > kHighestAtCrest * profile.crest_height;
  if (is_level || is_plateau) fit.status = FlankStatus::absent;
  return fit;
}

std::optional<OutlineFlank> flank_of(const Profile& profile, Side side, double spacing,
                                     const FlankFit& fit) {
  if (fit.status != FlankStatus::ok) return std::nullopt;
  const LineFit& line = fit.shown;
  const double end = side == Side::left ? profile.along.front() : profile.along.back();
  const double reach = std::abs(end - profile.along[profile.crest]);
  const double foot = std::min(-line.intercept / line.slope, kFarthestFoot * reach);
  const auto place = [&](double out) {
    const double along = profile.along[profile.crest] + (side == Side::left ? -out : out);
    return Point{.x = along * spacing, .y = line.y(out) * spacing};
  };
  return OutlineFlank{.angle_rad = fit.angle_rad,
                      .foot = foot * spacing,
                      .line = {place(fit.along.front()), place(fit.along[fit.counted() - 1])}};
}

}  // namespace

std::optional<double> OutlineAngle::angle_rad() const {
  if (left && right) return (left->angle_rad + right->angle_rad) / 2;
  if (left) return left->angle_rad;
  if (right) return right->angle_rad;
  return std::nullopt;
}

OutlineAngle measure_outline(const Outline& outline, const OutlineOptions& options) {
  check(outline, options);
  const double spacing = spacing_of(outline);
  const Profile profile = profile_of(outline, spacing);
  FlankOptions flank;
  flank.window_from = options.window_from;
  flank.window_to = options.window_to;
  if (options.grain) flank.grain = *options.grain / spacing;
  const FlankFit left = fit_of(profile, Side::left, flank);
  const FlankFit right = fit_of(profile, Side::right, flank);
  OutlineAngle angle{.left = flank_of(profile, Side::left, spacing, left),
                     .right = flank_of(profile, Side::right, spacing, right)};
  if (options.has_definitions) {
    angle.definitions = other_definitions(
        FittedEdge{.profile = profile, .left = left, .right = right, .grain = flank.grain});
  }
  return angle;
}

namespace {

constexpr int kHalfGrey = 128;

void check(const Picture& picture, const Box& part) {
  const bool is_inside = part.x >= 0 && part.y >= 0 && part.width >= 1 && part.height >= 1 &&
                         part.width <= picture.width - part.x &&
                         part.height <= picture.height - part.y;
  if (is_inside) return;
  throw base::InputError(
      {.subject = "part",
       .value = fmt::format("= {},{},{},{}", part.x, part.y, part.width, part.height),
       .rule = fmt::format("must lie inside the {} x {} picture", picture.width, picture.height),
       .fix = "give the top-left pixel, width and height in pixels of the picture."});
}

bool is_dark(const Picture& picture, int column, int row) {
  const auto at = 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width) +
                       static_cast<std::size_t>(column));
  const int sum = picture.bgr[at] + picture.bgr[at + 1] + picture.bgr[at + 2];
  return sum < 3 * kHalfGrey;
}

/// Height of the highest dark pixel above the ground; 0 if there is none.
double height_in(const Picture& picture, const Box& part, int column, double ground_y) {
  for (int row = part.y; row < part.y + part.height && row < ground_y; ++row) {
    if (is_dark(picture, column, row)) return ground_y - row;
  }
  return 0;
}

}  // namespace

Outline silhouette_edge(const Picture& silhouette, const Box& part, double ground_y) {
  check(silhouette, part);
  std::vector<double> heights;
  for (int column = part.x; column < part.x + part.width; ++column) {
    heights.push_back(height_in(silhouette, part, column, ground_y));
  }
  const auto highest = std::max_element(heights.begin(), heights.end());
  auto first = highest;
  while (first != heights.begin() && *(first - 1) > 0) --first;
  const auto last = std::find(highest, heights.end(), 0.0);
  Outline outline;
  for (auto height = first; height != last; ++height) {
    const auto column = part.x + static_cast<int>(height - heights.begin());
    outline.along.push_back(column + .5);
    outline.height.push_back(*height);
  }
  return outline;
}

}  // namespace repose::vision
