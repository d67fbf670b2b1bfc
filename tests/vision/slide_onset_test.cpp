#include "vision/track/slide_onset.h"

#include <cmath>

#include <gmock/gmock.h>

namespace repose::vision {
namespace {

constexpr double kOnset_s = 2.0137;
constexpr double kInterval_s = 1. / 60;
constexpr double kRate_rad_s = .07;

/// At rest, then sliding with a step and a linear growth of acceleration; jittered reproducibly by
/// a few hundredths of a pixel.
std::vector<SlidAt> slide(double step_px_s2, double growth_px_s3, double until_s = 2.6) {
  std::vector<SlidAt> places;
  for (int k = 0; k * kInterval_s < until_s; ++k) {
    const double time_s = k * kInterval_s, t = std::max(0.0, time_s - kOnset_s);
    const double jitter = .04 * std::sin(12.9898 * k * k);
    places.push_back({time_s, jitter + .5 * step_px_s2 * t * t + growth_px_s3 * t * t * t / 6,
                      kRate_rad_s * time_s});
  }
  return places;
}

void expect_onset(const std::vector<SlidAt>& places, double within_s) {
  const auto onset = slide_onset(places, 4, 40);
  ASSERT_TRUE(onset);
  EXPECT_NEAR(onset->time_s, kOnset_s, within_s);
  EXPECT_LE(onset->earliest_s, kOnset_s);
  EXPECT_GE(onset->latest_s, kOnset_s);
  EXPECT_LT(onset->latest_s - onset->earliest_s, 4 * within_s);
}

// To half the time between frames if friction falls at the onset. If it does not, the first tenth
// of a second moves the grain by less than its jitter.
TEST(SlideOnset, IsTracedBackWhereFrictionFalls) { expect_onset(slide(900, 800), kInterval_s / 2); }
TEST(SlideOnset, IsTracedBackWhereFrictionStays) { expect_onset(slide(0, 1200), .04); }

// Friction is constant: x" = g sin(w t) / cos A, so that x = g (w t - sin w t) / (w^2 cos A).
TEST(SlideOnset, IsThatOfCoulombsLawOnATurningPlate) {
  constexpr double kGravity_px_s2 = 9806.65 / .4;
  std::vector<SlidAt> places = slide(0, 0);
  for (SlidAt& one : places) {
    const double turned = kRate_rad_s * std::max(0.0, one.time_s - kOnset_s);
    one.slid_px += kGravity_px_s2 / std::pow(kRate_rad_s, 2) * (turned - std::sin(turned)) /
                   std::cos(kRate_rad_s * kOnset_s);
  }
  expect_onset(places, .03);
}

// Shifted by 6 pixels up the plate, as with a hinge found 40 pixels off.
TEST(SlideOnset, IsTheSameWhereTheHingeIsFoundBesideItsPlace) {
  for (const double step_px_s2 : {900., 0.}) {
    std::vector<SlidAt> places = slide(step_px_s2, 1200);
    for (SlidAt& one : places) {
      one.slid_px += 20 * (std::cos(one.turned_rad) - 1) - 40 * std::sin(one.turned_rad);
    }
    SCOPED_TRACE(step_px_s2);
    expect_onset(places, step_px_s2 > 0 ? kInterval_s / 2 : .04);
    EXPECT_LT(slide_onset(places, 4, 40)->crept_px, .1);
  }
}

TEST(SlideOnset, IsTheSameFromWhereverTheGrainLay) {
  std::vector<SlidAt> moved = slide(900, 800);
  for (SlidAt& one : moved) one.slid_px += .4;
  EXPECT_NEAR(slide_onset(moved, 4, 40)->time_s, slide_onset(slide(900, 800), 4, 40)->time_s, .004);
}

// Frames are missing from before the onset until after it.
TEST(SlideOnset, MayBeAnywhereInAGapAroundIt) {
  std::vector<SlidAt> gap;
  for (const SlidAt& one : slide(900, 800)) {
    if (one.time_s < kOnset_s - .12 || one.time_s > kOnset_s + .1) gap.push_back(one);
  }
  const auto onset = slide_onset(gap, 4, 40);
  ASSERT_TRUE(onset);
  EXPECT_NEAR(onset->unseen_s, .22, 2 * kInterval_s);
  EXPECT_LT(onset->earliest_s, kOnset_s - .1);
  EXPECT_GT(onset->latest_s, kOnset_s + .08);
  EXPECT_NEAR(onset->time_s, kOnset_s, .02);
  EXPECT_EQ(slide_onset(slide(900, 800), 4, 40)->unseen_s, 0);
}

TEST(SlideOnset, IsNotFoundWhereNothingSlidesOrHardlyAnythingIsSeen) {
  EXPECT_FALSE(slide_onset({}, 4, 40));
  EXPECT_FALSE(slide_onset(slide(900, 800, 1.9), 4, 40));
  const std::vector<SlidAt> all = slide(900, 800);
  EXPECT_FALSE(slide_onset({all.begin() + 122, all.end()}, 4, 40)) << "without its rest";
}

TEST(SlideOnset, TellsHowFarTheGrainCreptBefore) {
  std::vector<SlidAt> crept = slide(900, 800);
  for (SlidAt& one : crept) one.slid_px += one.time_s < 1 ? -2 : 0;
  EXPECT_NEAR(slide_onset(crept, 4, 40)->crept_px, 2, .8) << "less what a hinge may explain";
  EXPECT_LT(slide_onset(slide(900, 800), 4, 40)->crept_px, .1);
}

}  // namespace
}  // namespace repose::vision
