#include "vision/measure/uncertainty.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/distributions.h"

namespace repose::vision {
namespace {

constexpr double kFloor_rad = 0.06 * std::numbers::pi / 180;
constexpr double kWindowFraction = 0.5;

double student_95(double degrees_of_freedom) {
  return base::student_t_quantile(.975, std::max(1.0, degrees_of_freedom));
}

double grains_95(const FlankFit& flank) {
  return student_95(flank.degrees_of_freedom) * flank.fit_error_rad;
}

/// For the mean of two flanks.
double grains_95(const FlankFit& left, const FlankFit& right) {
  const double l = left.fit_error_rad * left.fit_error_rad;
  const double r = right.fit_error_rad * right.fit_error_rad;
  if (l + r <= 0) return 0;
  const double freedom =
      base::df_of_sum({l, left.degrees_of_freedom}, {r, right.degrees_of_freedom});
  return student_95(freedom) * std::sqrt(l + r) / 2;
}

/// The change with the window beyond what the grains' scatter explains. The halves of a bent flank
/// are steeper and flatter than its line by about half of the bend: the choice of the window may
/// move the number by that much.
double window_95(const FlankFit& flank) {
  const double spread = flank.window_spread_rad;
  const double chance = 2 * flank.fit_error_rad;
  const double sure = std::sqrt(std::max(0.0, spread * spread - chance * chance));
  return std::max(kWindowFraction * sure, std::min(sure, flank.sure_bend_rad() / 2));
}

/// Effect of a window that lies too high: how much the flank bends over half of it.
double unseen_foot_95(const FlankFit& flank, const Ground& ground) {
  return ground.behind ? std::abs(flank.bend_rad) : 0;
}

/// How far an edge whose position is only roughly known may turn the line: both ends may be off.
double place_95(const FlankFit& flank, const Segmentation& segmentation) {
  if (segmentation.deviation_px <= 0 || flank.counted() < 2) return 0;
  const double run = std::abs(flank.along[flank.counted() - 1] - flank.along.front());
  const double length = run * std::hypot(1, flank.robust.slope);
  return base::kNormal95 * std::numbers::sqrt2 * segmentation.deviation_px / std::max(1.0, length);
}

double combined(std::initializer_list<double> parts) {
  double squares = kFloor_rad * kFloor_rad;
  for (const double part : parts) squares += part * part;
  return std::sqrt(squares);
}

double side_95(const FlankFit& flank, const Reading& reading, double disagreement_rad) {
  if (flank.status != FlankStatus::ok) return 0;
  const Ground& ground = reading.body.ground;
  return flank.apron_rad +
         combined({grains_95(flank), window_95(flank), unseen_foot_95(flank, ground),
                   place_95(flank, reading.segmentation), base::kNormal95 * ground.deviation_rad,
                   disagreement_rad});
}

/// @param best  the reading these flanks belong to, by whichever definition
Uncertainty uncertainty_with(const FlankFit& left, const FlankFit& right,
                             const Disagreement& disagreement, const Reading& best) {
  const Ground& ground = best.body.ground;
  Uncertainty u;
  u.left_rad = side_95(left, best, disagreement.left_rad);
  u.right_rad = side_95(right, best, disagreement.right_rad);
  if (left.status == FlankStatus::ok && right.status == FlankStatus::ok) {
    u.mean_rad =
        (left.apron_rad + right.apron_rad) / 2 +
        combined(
            {grains_95(left, right), (window_95(left) + window_95(right)) / 2,
             (unseen_foot_95(left, ground) + unseen_foot_95(right, ground)) / 2,
             std::hypot(place_95(left, best.segmentation), place_95(right, best.segmentation)) / 2,
             disagreement.mean_rad});
  } else {
    u.mean_rad = left.status == FlankStatus::ok ? u.left_rad : u.right_rad;
  }
  return u;
}

}  // namespace

Uncertainty uncertainty_of(const SelectedCandidate& choice) {
  return uncertainty_with(choice.best.left, choice.best.right, choice.disagreement, choice.best);
}

Uncertainty uncertainty_of(const SelectedFlanks& flanks, const Reading& best) {
  return uncertainty_with(flanks.flanks.left, flanks.flanks.right, flanks.disagreement, best);
}

}  // namespace repose::vision
