#include "vision/measure/uncertainty.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/distributions.h"
#include "tests/vision/pictures.h"

namespace repose::vision {
namespace {

constexpr double kFloor_rad = 0.06 * kDegree;
// Student's 97.5 % quantiles, from a table.
constexpr double kStudent10 = 2.2281;
constexpr double kStudent20 = 2.0860;

FlankFit flank_with_error(double fit_error_rad) {
  FlankFit fit;
  fit.status = FlankStatus::ok;
  fit.fit_error_rad = fit_error_rad;
  fit.degrees_of_freedom = 10;
  return fit;
}

SelectedCandidate choice_with_errors(double left_error_rad, double right_error_rad) {
  SelectedCandidate choice;
  choice.best.left = flank_with_error(left_error_rad);
  choice.best.right = flank_with_error(right_error_rad);
  return choice;
}

TEST(Uncertainty, IsNeverBelowTheFloor) {
  const Uncertainty u = uncertainty_of(choice_with_errors(0, 0));
  EXPECT_DOUBLE_EQ(u.left_rad, kFloor_rad);
  EXPECT_DOUBLE_EQ(u.mean_rad, kFloor_rad);
}

TEST(Uncertainty, GrainsCountByStudentsFactor) {
  const Uncertainty u = uncertainty_of(choice_with_errors(0.01, 0.02));
  EXPECT_NEAR(u.left_rad, std::hypot(kStudent10 * 0.01, kFloor_rad), 1e-6);  // table's digits
  EXPECT_NEAR(u.right_rad, std::hypot(kStudent10 * 0.02, kFloor_rad), 1e-6);
}

TEST(Uncertainty, AnEdgeThatIsRoughlyKnownTurnsTheLine) {
  SelectedCandidate choice = choice_with_errors(0.01, 0.01);
  for (FlankFit* fit : {&choice.best.left, &choice.best.right}) {
    fit->along = {0, 40};
    fit->robust.slope = -0.75;  // 50 px long
  }
  const Uncertainty before = uncertainty_of(choice);
  choice.best.segmentation.deviation_px = 2;
  const Uncertainty after = uncertainty_of(choice);
  const double turn = base::kNormal95 * std::sqrt(2) * 2 / 50;
  EXPECT_NEAR(after.left_rad, std::hypot(before.left_rad, turn), 1e-9);
  EXPECT_NEAR(after.mean_rad, std::hypot(before.mean_rad, turn / std::sqrt(2)), 1e-9);
}

TEST(Uncertainty, MeanOfTwoFlanksHasBothTheirPoints) {
  const Uncertainty u = uncertainty_of(choice_with_errors(0.01, 0.01));
  EXPECT_NEAR(u.mean_rad, std::hypot(kStudent20 * 0.01 / std::sqrt(2), kFloor_rad), 1e-6);
}

TEST(Uncertainty, GroundTiltEntersTheSidesButNotTheirMean) {
  SelectedCandidate choice = choice_with_errors(0.01, 0.01);
  const Uncertainty before = uncertainty_of(choice);
  choice.best.body.ground.deviation_rad = 0.02;
  const Uncertainty after = uncertainty_of(choice);
  EXPECT_EQ(after.mean_rad, before.mean_rad);
  EXPECT_NEAR(after.left_rad, std::hypot(before.left_rad, base::kNormal95 * 0.02), 1e-9);
  EXPECT_NEAR(after.right_rad, std::hypot(before.right_rad, base::kNormal95 * 0.02), 1e-9);
}

TEST(Uncertainty, OfOneFlankHasTheGroundTilt) {
  SelectedCandidate choice = choice_with_errors(0.01, 0.01);
  choice.best.right.status = FlankStatus::truncated;
  choice.best.body.ground.deviation_rad = 0.02;
  const Uncertainty u = uncertainty_of(choice);
  EXPECT_EQ(u.mean_rad, u.left_rad);
  EXPECT_GT(u.mean_rad, base::kNormal95 * 0.02);
  EXPECT_EQ(u.right_rad, 0);
}

TEST(Uncertainty, GrowsWhereSegmentationsDisagree) {
  SelectedCandidate choice = choice_with_errors(0.01, 0.01);
  const Uncertainty before = uncertainty_of(choice);
  choice.disagreement.mean_rad = 0.03;
  choice.disagreement.left_rad = 0.05;
  const Uncertainty after = uncertainty_of(choice);
  EXPECT_NEAR(after.mean_rad, std::hypot(before.mean_rad, 0.03), 1e-9);
  EXPECT_NEAR(after.left_rad, std::hypot(before.left_rad, 0.05), 1e-9);
  EXPECT_EQ(after.right_rad, before.right_rad);
}

TEST(Uncertainty, WindowCountsBeyondWhatTheGrainsExplain) {
  SelectedCandidate choice = choice_with_errors(0.01, 0.01);
  const Uncertainty before = uncertainty_of(choice);
  choice.best.left.window_spread_rad = 0.02;  // two standard errors: chance
  EXPECT_EQ(uncertainty_of(choice).left_rad, before.left_rad);
  choice.best.left.window_spread_rad = 0.1;
  EXPECT_NEAR(uncertainty_of(choice).left_rad,
              std::hypot(before.left_rad, 0.5 * std::sqrt(0.1 * 0.1 - 0.02 * 0.02)), 1e-9);
}

TEST(Uncertainty, TheWindowsPartDoesNotAverageOut) {
  SelectedCandidate choice = choice_with_errors(0, 0);
  choice.best.left.window_spread_rad = choice.best.right.window_spread_rad = 0.1;
  const Uncertainty u = uncertainty_of(choice);
  EXPECT_NEAR(u.mean_rad, u.left_rad, 1e-12);
}

TEST(Uncertainty, OfABentFlankTheWindowCountsInFullUpToHalfTheBend) {
  SelectedCandidate choice = choice_with_errors(0, 0);
  FlankFit& left = choice.best.left;
  left.window_spread_rad = 0.04;
  const auto window = [&](double bend_rad) {
    left.bend_rad = bend_rad;
    const double all = uncertainty_of(choice).left_rad;
    return std::sqrt(all * all - kFloor_rad * kFloor_rad);
  };
  EXPECT_NEAR(window(0), 0.02, 1e-9);
  EXPECT_NEAR(window(0.06), 0.03, 1e-9);
  EXPECT_NEAR(window(-0.06), 0.03, 1e-9);
  EXPECT_NEAR(window(0.2), 0.04, 1e-9);
}

TEST(Uncertainty, AnApronCountsInFullAndDoesNotAverageOut) {
  SelectedCandidate choice = choice_with_errors(0.01, 0.01);
  const Uncertainty before = uncertainty_of(choice);
  choice.best.left.apron_rad = 0.1;
  choice.best.right.apron_rad = 0.06;
  const Uncertainty after = uncertainty_of(choice);
  EXPECT_NEAR(after.left_rad, before.left_rad + 0.1, 1e-9);
  EXPECT_NEAR(after.mean_rad, before.mean_rad + 0.08, 1e-9);
}

TEST(Uncertainty, AnEdgeBehindTheHeapCountsByTheFlanksBend) {
  SelectedCandidate choice = choice_with_errors(0.01, 0.01);
  choice.best.left.bend_rad = -0.04;
  choice.best.right.bend_rad = 0.02;
  const Uncertainty before = uncertainty_of(choice);
  choice.best.body.ground.behind = true;
  const Uncertainty after = uncertainty_of(choice);
  EXPECT_NEAR(after.left_rad, std::hypot(before.left_rad, 0.04), 1e-9);
  EXPECT_NEAR(after.right_rad, std::hypot(before.right_rad, 0.02), 1e-9);
  EXPECT_NEAR(after.mean_rad, std::hypot(before.mean_rad, 0.03), 1e-9);
}

}  // namespace
}  // namespace repose::vision
