#include "vision/measure/flank_verdict.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "base/units.h"
#include "vision/measure/verdict_notes.h"

namespace repose::vision {
namespace {

// Refusals.
constexpr double kFlattest_rad = 4 * kDegree;
constexpr double kSteepest_rad = 65 * kDegree;
constexpr double kLeastR2 = 0.85;
constexpr double kRoundest_rad = 17 * kDegree;  // the upper half of a ball lies 20 degrees flatter
constexpr double kLargestSpread_rad = 12 * kDegree;

// Warnings that ask a person to look.
constexpr double kDoubtfulBend_rad = 10 * kDegree;
constexpr double kUncoveredSpread_rad = 1 * kDegree;  // beyond the interval

constexpr double kHalvesPerWhole = 4;  // standard error of the halves' difference, of the line's:
                                       // 2^1.5 for half the length, times the root of 2 for two
constexpr double kByChance = 2;        // standard errors that the grains' scatter explains

std::string_view name_of(Side side) { return side == Side::left ? "left" : "right"; }

/// How far the flank bends beyond what the grains' scatter explains.
double sure_bend_rad(const FlankFit& flank) {
  const double chance = kByChance * kHalvesPerWhole * flank.fit_error_rad;
  return std::sqrt(std::max(0.0, flank.bend_rad * flank.bend_rad - chance * chance));
}

}  // namespace

std::string reason_against(const FlankFit& flank, Side side) {
  const std::string_view name = name_of(side);
  if (flank.status != FlankStatus::ok) return {};
  if (flank.angle_rad < kFlattest_rad) {
    return fmt::format(
        "the {} side is level ({:.1f} degrees): this is a layer, not a heap. Fix: photograph a "
        "heap "
        "whose flanks end on the ground.",
        name, to_degrees(flank.angle_rad));
  }
  if (flank.angle_rad > kSteepest_rad) {
    return fmt::format(
        "the {} side has a slope of {:.0f} degrees, too steep for loose grains. Fix: cover walls, "
        "gates and tubes with an {}.",
        name, to_degrees(flank.angle_rad), base::field("excluded box"));
  }
  if (flank.bend_rad < -kRoundest_rad) {
    return fmt::format(
        "the {} side is round, {:.0f} degrees flatter at the top than at the foot: not a straight "
        "flank. Fix: check that the picture shows a heap.",
        name, -to_degrees(flank.bend_rad));
  }
  if (flank.window_spread_rad > kLargestSpread_rad) {
    return fmt::format(
        "the {} side's angle changes by {:.0f} degrees with the window: not a straight flank, or a "
        "heap and its plate taken for one object. Fix: use a level camera and a plate of a "
        "different colour from the grains.",
        name, to_degrees(flank.window_spread_rad));
  }
  if (flank.least_squares.r2 < kLeastR2) {
    return fmt::format(
        "the {} side's edge is not a line (r2 {:.2f}). Fix: use a plainer backdrop, or cover what "
        "is in front of the flank with an {}.",
        name, flank.least_squares.r2, base::field("excluded box"));
  }
  return {};
}

void warn_of_flank(ReposeAngle& result, const Reading& reading, Side side) {
  const FlankFit& flank = reading.flank(side);
  const std::string_view name = name_of(side);
  if (flank.status != FlankStatus::ok) {
    note(result, flank.status == FlankStatus::truncated ? "flank_truncated" : "one_flank",
         fmt::format("No {} flank: {}. The angle is that of the other side alone.", name,
                     flank.reason));
    return;
  }
  if (flank.frame_cut) {
    note(result, "flank_cut_by_frame",
         fmt::format("The picture's edge cuts off the {} flank: it is fitted above {:.0f} % of the "
                     "height.",
                     name, 100 * flank.window_from));
  }
  if (flank.apron_cut) {
    note(result, "apron_left_out",
         fmt::format("A thin apron at the {} foot is left out: the line starts at {:.0f} % of the "
                     "height.",
                     name, 100 * flank.window_from));
  }
  if (flank.high_apron) {
    flag(result, "high_apron",
         fmt::format("On the {} the foot levels out at {:.0f} % of the height, too high to be left "
                     "out: the angle is that of flank and foot together.",
                     name, 100 * *flank.high_apron));
  }
  if (sure_bend_rad(flank) > kDoubtfulBend_rad) {
    flag(result, "bent_flank",
         fmt::format("The {} flank is {}: its slope differs by {:.0f} degrees between its lower "
                     "and upper half, so one angle does not describe it.",
                     name, flank.bend_rad > 0 ? "concave" : "convex",
                     std::abs(to_degrees(flank.bend_rad))));
  }
  const Flank& shown = side == Side::left ? result.left : result.right;
  if (flank.window_spread_rad > shown.uncertainty_rad.value_or(0) + kUncoveredSpread_rad) {
    flag(result, "window_sensitive",
         fmt::format("The {} angle changes by {:.1f} degrees with the window, more than its "
                     "interval covers.",
                     name, to_degrees(flank.window_spread_rad)));
  }
}

}  // namespace repose::vision
