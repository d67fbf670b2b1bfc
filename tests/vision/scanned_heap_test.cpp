#include "vision/scan/scanned_heap.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "base/units.h"
#include "tests/support/drawn_scan.h"
#include "tests/support/error_of.h"

namespace repose::vision {
namespace {

using testing::cone_surface;
using testing::cone_volume;
using ::testing::Contains;
using testing::drawn_scan;
using ::testing::Field;
using ::testing::HasSubstr;
using testing::kept;
using testing::ScanDraft;
using testing::turned;

constexpr double kConeAngle_deg = 27, kConeHeight = 80;  // mm
const double kConeVolume_ml = cone_volume(kConeAngle_deg, kConeHeight) / 1000;
const double kConeFoot = kConeHeight / std::tan(kConeAngle_deg * kDegree);

using ThreePoints = std::array<base::Corner, 3>;
using ScanPoints = std::vector<base::Corner>;

ScanDraft cone_draft() { return {.surface = cone_surface(kConeAngle_deg, kConeHeight)}; }

ScannedHeap measured_scan(ScanPoints points, const ScanOptions& options = {.unit_mm = 1}) {
  Scan scan;
  scan.points = std::move(points);
  return measure_scan(scan, options);
}

/// The cone's angle and volume are within their intervals, and these are narrow.
void expect_cone(const ScannedHeap& heap, double angle_within_deg = .3,
                 double volume_within = .01) {
  ASSERT_NE(heap.angle.status, MeasureStatus::refused) << heap.angle.reason;
  const double off = to_degrees(*heap.angle.angle_rad) - kConeAngle_deg;
  EXPECT_LT(std::abs(off), to_degrees(*heap.angle.uncertainty_rad));
  EXPECT_LT(to_degrees(*heap.angle.uncertainty_rad), angle_within_deg);
  ASSERT_TRUE(heap.volume_ml.has_value()) << heap.size_reason;
  EXPECT_LT(std::abs(heap.volume_ml->value - kConeVolume_ml), heap.volume_ml->uncertainty);
  EXPECT_LT(heap.volume_ml->uncertainty, volume_within * kConeVolume_ml);
}

auto scan_warns(const std::string& code) { return Contains(Field(&Warning::code, code)); }

TEST(ScannedHeap, AConesAngleAndVolume) {
  const ScannedHeap heap = measured_scan(drawn_scan(cone_draft()));
  EXPECT_EQ(heap.angle.status, MeasureStatus::ok);
  expect_cone(heap);
  EXPECT_NEAR(heap.base_mm->value, 2 * kConeFoot, heap.base_mm->uncertainty);
  EXPECT_NEAR(heap.height_mm->value, kConeHeight, .05 * kConeHeight);
  EXPECT_EQ(heap.azimuths.size(), std::size_t{kAzimuths});
  EXPECT_LT(to_degrees(*heap.azimuth_sd_rad), .6);
  EXPECT_NEAR(heap.ground->normal[2], 1, 1e-4);
}

TEST(ScannedHeap, HoweverItIsTurned) {
  const ScanPoints points = drawn_scan(cone_draft());
  expect_cone(measured_scan(turned(points)));
  ScanPoints upside_down = points, mirrored = points;
  for (base::Corner& point : upside_down) point = {point[0], -point[1], -point[2]};
  for (base::Corner& point : mirrored) point[0] = -point[0];
  const ScannedHeap down = measured_scan(upside_down);
  expect_cone(down);
  EXPECT_LT(down.ground->normal[2], -.999);
  expect_cone(measured_scan(mirrored));
}

TEST(ScannedHeap, InMetres) {
  const ScannedHeap heap = measured_scan(turned(drawn_scan(cone_draft()), .001), {.unit_mm = 1000});
  expect_cone(heap);
}

TEST(ScannedHeap, WithoutAUnitThereAreNoSizes) {
  const ScannedHeap heap = measured_scan(drawn_scan(cone_draft()), {});
  EXPECT_EQ(heap.angle.status, MeasureStatus::ok);
  EXPECT_FALSE(heap.volume_ml || heap.height_mm || heap.base_mm);
  EXPECT_THAT(heap.size_reason, HasSubstr("unit"));
}

TEST(ScannedHeap, TheSamePointsGiveTheSame) {
  const ScanPoints points = turned(drawn_scan(cone_draft()));
  const ScannedHeap one = measured_scan(points), other = measured_scan(points);
  EXPECT_EQ(*one.angle.angle_rad, *other.angle.angle_rad);
  EXPECT_EQ(*one.angle.uncertainty_rad, *other.angle.uncertainty_rad);
  EXPECT_EQ(one.volume_ml->value, other.volume_ml->value);
}

/// h = H (1 - r / R)^p: V = 2 pi H R^2 / ((p + 1) (p + 2)).
TEST(ScannedHeap, AHollowHeapsVolumeIsItsOwn) {
  constexpr double kPower = 1.5, kRadius = 160;
  ScanDraft draft = cone_draft();
  draft.surface = [](double x, double y) {
    return kConeHeight * std::pow(std::max(0.0, 1 - std::hypot(x, y) / kRadius), kPower);
  };
  const ScannedHeap heap = measured_scan(drawn_scan(draft));
  const double volume_ml =
      2 * std::numbers::pi * kConeHeight * kRadius * kRadius / ((kPower + 1) * (kPower + 2)) / 1000;
  EXPECT_NEAR(heap.volume_ml->value, volume_ml, heap.volume_ml->uncertainty);
  EXPECT_LT(heap.volume_ml->uncertainty, .01 * volume_ml);
  // The chord between 20 and 80 % of the height, which is close to the least-squares line.
  const auto place = [](double part) { return kRadius * (1 - std::pow(part, 1 / kPower)); };
  const double chord_deg = to_degrees(std::atan(.6 * kConeHeight / (place(.2) - place(.8))));
  EXPECT_NEAR(to_degrees(*heap.angle.angle_rad), chord_deg, 1);
}

TEST(ScannedHeap, StraysInTheAirChangeLittle) {
  ScanPoints points = drawn_scan(cone_draft());
  testing::add_outliers(points, points.size() / 50, 400);
  expect_cone(measured_scan(turned(points)));
}

TEST(ScannedHeap, ASmallHoleIsFilledAndItsAzimuthsLeftOut) {
  const auto is_seen = [](const base::Corner& at) { return std::hypot(at[0] - 70, at[1]) > 20; };
  const ScannedHeap heap = measured_scan(kept(drawn_scan(cone_draft()), is_seen));
  expect_cone(heap);
  EXPECT_GT(heap.hole_share, .01);
  EXPECT_THAT(heap.angle.warnings, scan_warns("azimuths_unseen"));
}

TEST(ScannedHeap, LargeHolesAreRefused) {
  const auto is_seen = [](const base::Corner& at) {
    const double out = std::hypot(at[0], at[1]);
    return out < .15 * kConeFoot || out > .75 * kConeFoot;
  };
  const ScannedHeap heap = measured_scan(kept(drawn_scan(cone_draft()), is_seen));
  EXPECT_EQ(heap.angle.status, MeasureStatus::refused);
  EXPECT_THAT(heap.angle.reason, HasSubstr("holes are too large"));
}

TEST(ScannedHeap, WhereTheScanCutsItOffItHasNoVolume) {
  const auto is_seen = [](const base::Corner& at) { return at[0] < .4 * kConeFoot; };
  const ScannedHeap heap = measured_scan(kept(drawn_scan(cone_draft()), is_seen));
  EXPECT_EQ(heap.angle.status, MeasureStatus::flagged);
  EXPECT_NEAR(to_degrees(*heap.angle.angle_rad), kConeAngle_deg,
              to_degrees(*heap.angle.uncertainty_rad));
  EXPECT_FALSE(heap.volume_ml.has_value());
  EXPECT_THAT(heap.size_reason, HasSubstr("cuts the base off"));
}

TEST(ScannedHeap, AFloorOrAWallWithMorePointsIsNotTheGround) {
  ScanPoints table =
      kept(drawn_scan(cone_draft()), [](const auto& at) { return std::abs(at[0]) < 230; });
  ScanDraft floor{.surface = [](double, double) { return -700; }, .half_side = 900};
  for (const base::Corner& at : drawn_scan(floor)) {
    if (std::abs(at[0]) > 300) table.push_back(at);
  }
  expect_cone(measured_scan(turned(table)));
  ScanPoints walled = drawn_scan(cone_draft());
  for (const base::Corner& at : drawn_scan({.surface = [](double, double) { return 0; }})) {
    walled.push_back({at[0], 260 + at[2], at[1] + 260});
  }
  expect_cone(measured_scan(turned(walled)));
}

TEST(ScannedHeap, GroundThatAPersonPointsAt) {
  const ScanPoints points = drawn_scan(cone_draft());
  const ScannedHeap heap = measured_scan(
      points, {.unit_mm = 1, .ground = ThreePoints{{{250, 250, 0}, {-250, 250, 0}, {0, -250, 0}}}});
  expect_cone(heap);
  EXPECT_THAT(error_of([&] {
                measured_scan(points, {.ground = ThreePoints{{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}}});
              }),
              HasSubstr("on one line"));
}

struct ScanRefusal {
  const char* name;
  ScanPoints points;
  const char* reason;
};

std::vector<ScanRefusal> scan_refusals() {
  const ScanPoints points = drawn_scan(cone_draft());
  ScanDraft two = cone_draft(), box = cone_draft(), ball = cone_draft();
  two.surface = [](double x, double y) {
    return std::max({0.0, 60 - std::hypot(x - 140, y) / 2, 60 - std::hypot(x + 140, y) / 2});
  };
  box.surface = [](double x, double y) {
    return std::abs(x) < 100 && std::abs(y) < 60 ? 50.0 : 0.0;
  };
  ball.surface = [](double x, double y) { return std::sqrt(std::max(0.0, 1e4 - x * x - y * y)); };
  ScanDraft flat = cone_draft();
  flat.surface = [](double, double) { return 0; };
  const auto without_ground = [](const base::Corner& at) { return at[2] > 2; };
  return {{"none", {}, "too few points"},
          {"few", {points.begin(), points.begin() + 3000}, "too few points"},
          {"one place", ScanPoints(5000, base::Corner{1, 2, 3}), "at one place"},
          {"ground only", drawn_scan(flat), "ground only"},
          {"no ground", kept(points, without_ground), "cut off at the scan's edge"},
          {"two heaps", drawn_scan(two), "2 bodies of like size"},
          {"box", drawn_scan(box), "falls off vertically"},
          {"ball", drawn_scan(ball), "round"}};
}

TEST(ScannedHeap, WhatIsNoHeapIsRefusedWithReasonAndRemedy) {
  for (const ScanRefusal& refusal : scan_refusals()) {
    const ScannedHeap heap = measured_scan(refusal.points);
    EXPECT_EQ(heap.angle.status, MeasureStatus::refused) << refusal.name;
    EXPECT_THAT(heap.angle.reason, HasSubstr(refusal.reason)) << refusal.name;
    EXPECT_THAT(heap.angle.reason, HasSubstr(" Fix: ")) << refusal.name;
    EXPECT_FALSE(heap.angle.angle_rad || heap.volume_ml) << refusal.name;
  }
}

TEST(ScannedHeap, BodiesOnBothSidesOfTheGroundLeaveUpUnknown) {
  ScanDraft draft = cone_draft();
  draft.surface = [](double x, double y) {
    return std::max(0.0, 60 - std::hypot(x - 140, y) / 2) -
           std::max(0.0, 60 - std::hypot(x + 140, y) / 2);
  };
  const ScannedHeap heap = measured_scan(drawn_scan(draft));
  EXPECT_EQ(heap.angle.status, MeasureStatus::refused);
  EXPECT_THAT(heap.angle.reason, HasSubstr("which side of the ground is up"));
}

TEST(ScannedHeap, WindowsAndUnitsThatCannotBeMeantAreRefused) {
  EXPECT_THAT(error_of([] { measured_scan({}, {.window_from = .8, .window_to = .2}); }),
              HasSubstr("window"));
  EXPECT_THAT(error_of([] { measured_scan({}, {.unit_mm = 0}); }), HasSubstr("unit"));
}

/// Points on a grid of step `step_mm` over a square.
template <class Surface>
ScanPoints sampled(double half_mm, double step_mm, const Surface& surface) {
  ScanPoints points;
  for (double x = -half_mm; x <= half_mm; x += step_mm) {
    for (double y = -half_mm; y <= half_mm; y += step_mm) points.push_back({x, y, surface(x, y)});
  }
  return points;
}

double cone_at(double x, double y) {
  return std::max(0., kConeHeight - std::hypot(x, y) * std::tan(kConeAngle_deg * kDegree));
}

TEST(ScannedHeap, AScanThatIsBentAsAWholeHasWiderIntervals) {
  for (const double bow : {-5e-5, -2e-5, 2e-5, 5e-5}) {  // up to 3.4 mm at the square's edge
    const ScannedHeap heap = measured_scan(
        sampled(260, 2, [&](double x, double y) { return cone_at(x, y) + bow * (x * x + y * y); }));
    ASSERT_TRUE(heap.volume_ml.has_value()) << bow << ": " << heap.size_reason;
    EXPECT_LT(std::abs(heap.volume_ml->value - kConeVolume_ml), heap.volume_ml->uncertainty) << bow;
    EXPECT_LT(std::abs(to_degrees(*heap.angle.angle_rad) - kConeAngle_deg),
              to_degrees(*heap.angle.uncertainty_rad))
        << bow;
  }
}

TEST(ScannedHeap, ADiscAsWideAsTheHeapIsFlaggedAsAStep) {
  const auto on_disc = [](double height_mm) {
    return measured_scan(sampled(260, 2, [&](double x, double y) {
      return cone_at(x, y) + (std::hypot(x, y) < kConeFoot ? height_mm : 0);
    }));
  };
  EXPECT_THAT(on_disc(25).angle.warnings, scan_warns("step_at_foot"));
  EXPECT_EQ(on_disc(25).angle.status, MeasureStatus::flagged);
  for (const Warning& warning : on_disc(25).angle.warnings) {
    EXPECT_TRUE(std::ranges::none_of(warning.message, [](char letter) {
      return std::iscntrl(static_cast<unsigned char>(letter)) != 0;
    })) << warning.message;
  }
  EXPECT_THAT(on_disc(0).angle.warnings, ::testing::Not(scan_warns("step_at_foot")));
}

/// A cone on ground that is raised within `width` times the foot's radius.
ScannedHeap on_ledge(double width, double height_mm, double aside_mm = 0) {
  return measured_scan(sampled(330, 1.5, [&](double x, double y) {
    return cone_at(x, y) + (std::hypot(x - aside_mm, y) < width * kConeFoot ? height_mm : 0);
  }));
}

TEST(ScannedHeap, ADiscWiderThanTheHeapIsFlagged) {
  for (const auto& [width, height_mm, aside_mm] :
       {std::array{1.15, 3., 0.}, {1.15, 10., 0.}, {1.4, 6., 0.}, {1.4, 12., 0.}, {1.3, 8., 8.}}) {
    const ScannedHeap heap = on_ledge(width, height_mm, aside_mm);
    ASSERT_NE(heap.angle.status, MeasureStatus::refused) << heap.angle.reason;
    const bool is_seen_through =
        heap.volume_ml && std::abs(heap.volume_ml->value - kConeVolume_ml) <
                              heap.volume_ml->uncertainty + .01 * kConeVolume_ml;
    if (is_seen_through) continue;  // the ledge was taken as the ground
    EXPECT_THAT(heap.angle.warnings, scan_warns("ledge_at_foot")) << width << ' ' << height_mm;
    EXPECT_EQ(heap.angle.status, MeasureStatus::flagged);
  }
}

TEST(ScannedHeap, AHollowThatTheHeapStandsInIsFlagged) {
  const ScannedHeap heap = on_ledge(1.15, -6);
  EXPECT_THAT(heap.angle.warnings, scan_warns("ledge_at_foot"));
  EXPECT_EQ(heap.angle.status, MeasureStatus::flagged);
}

TEST(ScannedHeap, ToesThatFallAwayGraduallyAreNoLedges) {
  const ScannedHeap hollow = measured_scan(
      sampled(400, 2, [](double x, double y) { return 80 * std::exp(-std::hypot(x, y) / 70); }));
  EXPECT_THAT(hollow.angle.warnings, ::testing::Not(scan_warns("ledge_at_foot")));
  EXPECT_THAT(on_ledge(1, 0).angle.warnings, ::testing::Not(scan_warns("ledge_at_foot")));
}

TEST(ScannedHeap, MetresThatAreSaidToBeMillimetresAreFlagged) {
  Scan scan;
  for (base::Corner at : drawn_scan(cone_draft())) {
    for (double& part : at) part /= 1000;
    scan.points.push_back(at);
  }
  const ScannedHeap heap = measure_scan(scan, {.unit_mm = 1});
  EXPECT_THAT(heap.angle.warnings, scan_warns("unlikely_size"));
  EXPECT_THAT(measure_scan(scan, {.unit_mm = 1000}).angle.warnings,
              ::testing::Not(scan_warns("unlikely_size")));
}

// The floor has more points than the table and is taken as the ground: the top of the body on it is
// a plateau.
TEST(ScannedHeap, AHeapOnASmallTableFarAboveTheFloorIsRefused) {
  constexpr double kFoot = 60, kTable = 85, kFloor = -300;
  const ScannedHeap heap = measured_scan(sampled(200, 1, [](double x, double y) {
    const double cone = std::max(0., (kFoot - std::hypot(x, y)) * std::tan(28 * kDegree));
    return std::max(std::abs(x), std::abs(y)) < kTable ? cone : kFloor;
  }));
  EXPECT_EQ(heap.angle.status, MeasureStatus::refused);
  EXPECT_THAT(heap.angle.reason, HasSubstr("Fix: "));
}

TEST(ScannedHeap, AUnitAgainstTheFilesOwnIsRefused) {
  Scan scan;
  scan.points = drawn_scan(cone_draft());
  scan.unit_mm = 1000;
  EXPECT_THAT(error_of([&] { measure_scan(scan, {.unit_mm = 1}); }),
              HasSubstr("the file says that one unit is 1000 mm"));
}

}  // namespace
}  // namespace repose::vision
