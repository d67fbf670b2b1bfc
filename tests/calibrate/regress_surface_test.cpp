#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "calibrate/fit/points.h"
#include "calibrate/statistics/design/design.h"
#include "calibrate/statistics/regress/surface.h"
#include "tests/calibrate/hazelnut_runs.h"

namespace repose::calibrate {
namespace {

using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;

/// The surface y(u) at the points of a central composite design, with alternating deviations of
/// +-noise.
template <typename Surface>
RunTable runs_on(const std::vector<Factor>& factors, const Surface& surface, double noise) {
  RunTable table;
  table.name = "made-up";
  table.factors = factors;
  table.levels.resize(factors.size());
  table.response_name = "y";
  double sign = 1;
  for (const DesignRun& run : central_composite(factors).runs) {
    std::vector<double> u;
    for (std::size_t i = 0; i < factors.size(); ++i) {
      u.push_back(factors[i].natural(run.coded[i]));
      table.levels[i].push_back(u.back());
    }
    table.responses.push_back(surface(u) + sign * noise);
    sign = -sign;
  }
  return table;
}

const std::vector<Factor> kTwo = {{"a", -1, 1}, {"b", -1, 1}};

Regression fit(const RunTable& table) { return regress(table, SurfaceModel::quadratic); }

std::vector<std::string> codes_of(const Regression& regression, std::optional<double> target = {}) {
  std::optional<TargetSet> set;
  if (target) set = solve_target(regression, {*target});
  std::vector<std::string> codes;
  for (const SurfaceDiagnostic& diagnostic :
       diagnostics_of(regression, canonical_form(regression), extremes_in_box(regression), set)) {
    codes.push_back(diagnostic.code);
  }
  return codes;
}

TEST(CanonicalForm, HazelnutStudysSurfaceIsASaddle) {
  const auto form = canonical_form(fit(hazelnut_runs()));
  ASSERT_TRUE(form && form->stationary);
  ASSERT_EQ(form->axes.size(), 3U);
  EXPECT_EQ(form->shape, SurfaceShape::saddle);
  // Twice these values are the Hessian's eigenvalues.
  EXPECT_NEAR(2 * form->axes[0].curvature, -.346, 5e-4);
  EXPECT_NEAR(2 * form->axes[1].curvature, 9.21, 5e-3);
  EXPECT_NEAR(2 * form->axes[2].curvature, 27.9, 5e-2);
}

TEST(CanonicalForm, AgreesWithR) {
  // B from coef(m); eigen(B); -solve(B, b[2:4]) / 2; sqrt(g' vcov(m) g) * qt(.975, 10)
  const auto form = canonical_form(fit(hazelnut_runs()));
  ASSERT_TRUE(form && form->stationary);
  EXPECT_NEAR(form->axes[0].curvature, -.172757909779548, 1e-9);
  EXPECT_NEAR(form->axes[1].curvature, 4.603083331027326, 1e-9);
  EXPECT_NEAR(form->axes[2].curvature, 13.956280248733192, 1e-9);
  EXPECT_NEAR(form->axes[0].uncertainty, 3.20772692823403, 1e-8);
  EXPECT_NEAR(form->axes[2].uncertainty, 3.20802777291539, 1e-8);
  EXPECT_FALSE(form->axes[0].is_certain());
  EXPECT_TRUE(form->axes[1].is_certain());
  EXPECT_NEAR(form->axes[0].direction[0], .9957103427226182, 1e-9);
  EXPECT_NEAR(form->stationary->coded[0], 7.468192433499322, 1e-8);
  EXPECT_NEAR(form->stationary->coded[1], .216560161101515, 1e-8);
  EXPECT_NEAR(form->stationary->coded[2], -.549158551935657, 1e-8);
  EXPECT_FALSE(form->is_inside);
}

TEST(CanonicalForm, NamesMinimumAndMaximum) {
  const auto bowl = [](const std::vector<double>& u) {
    return 3 + std::pow(u[0] - .3, 2) + 2 * std::pow(u[1] + .1, 2);
  };
  const auto low = canonical_form(fit(runs_on(kTwo, bowl, .01)));
  EXPECT_EQ(low->shape, SurfaceShape::minimum);
  EXPECT_TRUE(low->is_inside);
  EXPECT_NEAR(low->stationary->natural[0], .3, .02);
  EXPECT_NEAR(low->stationary->natural[1], -.1, .02);
  const auto hill = [&](const std::vector<double>& u) { return -bowl(u); };
  EXPECT_EQ(canonical_form(fit(runs_on(kTwo, hill, .01)))->shape, SurfaceShape::maximum);
}

/// One factor on 7 levels, y = (u - .3)^2 with scatter.
RunTable parabola(double noise) {
  RunTable table;
  table.name = "parabola";
  table.factors = {{"u", -1, 1}};
  table.response_name = "y";
  table.levels.resize(1);
  constexpr int kRuns = 7;
  for (int k = 0; k < kRuns; ++k) {
    const double u = -1 + 2. * k / (kRuns - 1);
    table.levels[0].push_back(u);
    table.responses.push_back(std::pow(u - .3, 2) + (k % 2 == 0 ? noise : -noise));
  }
  return table;
}

TEST(StationaryRegion, OfOneFactorIsThatOfARatioOfTwoNormals) {
  // -b1 / (2 b2): Fieller's interval, where (b1 + 2 b2 x)^2 = t^2 var(b1 + 2 b2 x).
  const Regression regression = fit(parabola(.05));
  const auto region = stationary_region(regression);
  ASSERT_TRUE(region && region->is_in_box);
  const double b1 = regression.coefficients[1].value, b2 = regression.coefficients[2].value;
  const double v1 = std::pow(regression.coefficients[1].standard_error, 2);
  const double v2 = std::pow(regression.coefficients[2].standard_error, 2);
  const double t2 = std::pow(regression.student_t, 2);  // b1 and b2 are independent here
  const double a = 4 * (b2 * b2 - t2 * v2), b = 4 * b1 * b2, c = b1 * b1 - t2 * v1;
  const double root = std::sqrt(b * b - 4 * a * c);
  EXPECT_NEAR(region->ranges[0][0].value(), (-b - root) / (2 * a), .0041);
  EXPECT_NEAR(region->ranges[0][1].value(), (-b + root) / (2 * a), .0041);
  EXPECT_LE(region->ranges[0][0].value(), (-b - root) / (2 * a)) << "outwards";
}

TEST(StationaryRegion, HoldsTheTruthNineteenTimesInTwenty) {
  calibrate::Random random(5);
  int held = 0;
  constexpr int kTables = 400;
  for (int k = 0; k < kTables; ++k) {
    RunTable table = parabola(0);
    for (double& response : table.responses) response += .05 * random.normal();
    const auto region = stationary_region(fit(table));
    ASSERT_TRUE(region);
    if (!region->is_in_box) continue;
    const auto& [low, high] = region->ranges.front();
    held += (!low || *low <= .3) && (!high || *high >= .3) ? 1 : 0;
  }
  EXPECT_NEAR(held, .95 * kTables, 13) << "three standard deviations of chance";
}

TEST(StationaryRegion, OfARidgeReachesTheEndOfTheRuns) {
  const auto ridge = [](const std::vector<double>& u) { return std::pow(u[1] - .2, 2); };
  const auto region = stationary_region(fit(runs_on(kTwo, ridge, .05)));
  ASSERT_TRUE(region && region->is_in_box);
  EXPECT_FALSE(region->ranges[0][0] || region->ranges[0][1]);
  EXPECT_NEAR(region->ranges[1][0].value(), .1, .1);
  EXPECT_NEAR(region->ranges[1][1].value(), .3, .1);
}

TEST(StationaryRegion, OfASlopeIsNowhere) {
  const auto slope = [](const std::vector<double>& u) { return 5 * u[0] + u[1]; };
  const auto region = stationary_region(fit(runs_on(kTwo, slope, .05)));
  ASSERT_TRUE(region);
  EXPECT_FALSE(region->is_in_box);
  EXPECT_THAT(region->ranges, IsEmpty());
}

TEST(StationaryRegion, IsNotToldOfExactFitsAndOtherModels) {
  const auto bowl = [](const std::vector<double>& u) { return u[0] * u[0] + u[1] * u[1]; };
  EXPECT_FALSE(stationary_region(fit(runs_on(kTwo, bowl, 0))));
  EXPECT_FALSE(stationary_region(regress(hazelnut_runs(), SurfaceModel::linear)));
}

TEST(CanonicalForm, OnlyQuadraticModelsHaveOne) {
  EXPECT_FALSE(canonical_form(regress(hazelnut_runs(), SurfaceModel::interaction)));
}

TEST(BoxExtremes, HazelnutStudysMinimumIsNegative) {
  const SurfacePoint least = extremes_in_box(fit(hazelnut_runs())).least;
  EXPECT_NEAR(least.value, -8.76366528132547, 1e-9);  // R: optim(..., method = "L-BFGS-B")
  EXPECT_DOUBLE_EQ(least.coded[0], -1.682);
  EXPECT_NEAR(least.coded[1], .977773247, 1e-6);
  EXPECT_NEAR(least.coded[2], -.146554427, 1e-6);
  EXPECT_GT(least.uncertainty, 0);
}

TEST(BoxExtremes, NoPointOfAFineGridIsLowerOrHigher) {
  const Regression regression = fit(hazelnut_runs());
  const BoxExtremes extremes = extremes_in_box(regression);
  constexpr int kSteps = 20;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      for (int k = 0; k <= kSteps; ++k) {
        const auto level = [](int step) { return 1.682 * (2.0 * step / kSteps - 1); };
        const double x[] = {level(i), level(j), level(k)};
        const double value = regression.predicted(x);
        ASSERT_GE(value, extremes.least.value - 1e-9);
        ASSERT_LE(value, extremes.greatest.value + 1e-9);
      }
    }
  }
}

TEST(BoxExtremes, APlanesAreCorners) {
  const auto plane = [](const std::vector<double>& u) { return 2 * u[0] - u[1]; };
  const Regression regression = regress(runs_on(kTwo, plane, .01), SurfaceModel::linear);
  const BoxExtremes extremes = extremes_in_box(regression);
  const double corner = std::sqrt(2.0);  // the axial points' alpha
  EXPECT_NEAR(extremes.least.coded[0], -corner, 1e-12);
  EXPECT_NEAR(extremes.least.coded[1], corner, 1e-12);
}

TEST(Target, OneFactorsParabolaIsSolved) {
  // The study's drop: h = 1.403 - 42.794 e + 217.095 e^2 at nine levels is 9.42 mm at e = .3145.
  RunTable table;
  table.name = "drop";
  table.factors = {{"e", .01, .41}};
  table.levels.resize(1);
  table.response_name = "height_mm";
  for (int k = 0; k < 9; ++k) {
    const double e = .01 + .05 * k;
    table.levels[0].push_back(e);
    table.responses.push_back(1.403 - 42.794 * e + 217.095 * e * e + (k % 2 == 0 ? .05 : -.05));
  }
  const Regression regression = fit(table);
  const TargetSet set = solve_target(regression, {9.42});
  ASSERT_EQ(set.through_centre.size(), 1U);
  const Crossing& crossing = set.through_centre.front();
  EXPECT_NEAR(crossing.point.natural[0], .3145, 1e-3);
  EXPECT_NEAR(crossing.point.value, 9.42, 1e-9);
  ASSERT_TRUE(crossing.interval[0] && crossing.interval[1]);
  EXPECT_GT(*crossing.interval[1] - *crossing.interval[0], 2e-4);
  EXPECT_LT(*crossing.interval[1] - *crossing.interval[0], .02);
  // Rebounds predicted near e = .1 are negative, as with the study's own quadratic.
  EXPECT_LT(extremes_in_box(regression).least.value, 0);
  ASSERT_EQ(set.ranges.size(), 1U);
  EXPECT_EQ(set.ranges[0].size(), 1U);
}

TEST(Target, AParabolaMayBeCrossedTwice) {
  RunTable table;
  table.factors = {{"x", 0, 4}};
  table.levels = {{0, 1, 2, 3, 4}};
  table.response_name = "y";
  table.responses = {4, 1, 0, 1, 4.001};
  const TargetSet set = solve_target(fit(table), {1});
  ASSERT_EQ(set.through_centre.size(), 2U);
  EXPECT_NEAR(set.through_centre[0].point.natural[0], 1, .01);
  EXPECT_NEAR(set.through_centre[1].point.natural[0], 3, .01);
}

TEST(Target, TheIntervalOfALineIsFiellers) {
  // A line y = a + b x: Fieller's ends solve (b x - d)^2 = t^2 s^2 (1/n + x^2 / Sxx) for centred x.
  RunTable table;
  table.factors = {{"x", -2, 2}};
  table.levels = {{-2, -1, 0, 1, 2}};
  table.response_name = "y";
  table.responses = {-4.2, -1.9, .1, 2.2, 3.8};
  const Regression line = regress(table, SurfaceModel::linear);
  const double mean = 0, slope = 20.1 / 10, target = 1, t = 3.182446, s = line.residual_sd;
  const double a = slope * slope - t * t * s * s / 10;
  const double b = -2 * slope * (target - mean);
  const double c = (target - mean) * (target - mean) - t * t * s * s / 5;
  const double root = std::sqrt(b * b - 4 * a * c);
  const TargetSet set = solve_target(line, {target});
  ASSERT_EQ(set.through_centre.size(), 1U);
  EXPECT_NEAR(*set.through_centre[0].interval[0], (-b - root) / (2 * a), 1e-6);
  EXPECT_NEAR(*set.through_centre[0].interval[1], (-b + root) / (2 * a), 1e-6);
}

TEST(Target, AnUncertainTargetWidensTheIntervalUntilTheRunsEnd) {
  RunTable table;
  table.factors = {{"x", -2, 2}};
  table.levels = {{-2, -1, 0, 1, 2}};
  table.response_name = "y";
  table.responses = {-4.2, -1.9, .1, 2.2, 3.8};
  const Regression line = regress(table, SurfaceModel::linear);
  const auto width = [&](double uncertainty) {
    const Crossing at = solve_target(line, {1, uncertainty}).through_centre.front();
    return *at.interval[1] - *at.interval[0];
  };
  EXPECT_NEAR(width(1), std::hypot(width(0) / 2, 1 / 2.01) * 2, .02);
  const Crossing open = solve_target(line, {3.5, 1}).through_centre.front();
  EXPECT_TRUE(open.interval[0]);
  EXPECT_FALSE(open.interval[1]) << "no run beyond 2";
}

TEST(Target, RangesHoldTheWholeSet) {
  // y = a^2 + b^2 at 1: the unit circle in a box of +- sqrt(2).
  const auto bowl = [](const std::vector<double>& u) { return u[0] * u[0] + u[1] * u[1]; };
  const Regression regression = fit(runs_on(kTwo, bowl, 0));
  const TargetSet circle = solve_target(regression, {1});
  for (const auto& ranges : circle.ranges) {
    ASSERT_EQ(ranges.size(), 1U);
    EXPECT_NEAR(ranges[0][0], -1, 1e-6);
    EXPECT_NEAR(ranges[0][1], 1, 1e-6);
  }
  // Above 2 the set consists of four corners: each factor has two intervals.
  const TargetSet corners = solve_target(regression, {3});
  for (const auto& ranges : corners.ranges) {
    ASSERT_EQ(ranges.size(), 2U);
    EXPECT_NEAR(ranges[0][0], -std::sqrt(2.0), 1e-6);
    EXPECT_NEAR(ranges[0][1], -1, 1e-6);
    EXPECT_NEAR(ranges[1][0], 1, 1e-6);
  }
}

TEST(Target, EveryPointGivenMeetsItWithinTheBox) {
  const Regression regression = fit(hazelnut_runs());
  const TargetSet set = solve_target(regression, {30});
  EXPECT_GT(set.grid.size(), 20U);
  for (const Crossing& crossing : set.grid) {
    EXPECT_NEAR(crossing.point.value, 30, 1e-9);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LE(std::abs(crossing.point.coded[i]), 1.682);
      EXPECT_TRUE(std::any_of(set.ranges[i].begin(), set.ranges[i].end(),
                              [&](const auto& range) {
                                return crossing.point.coded[i] >= range[0] - 1e-6 &&
                                       crossing.point.coded[i] <= range[1] + 1e-6;
                              }))
          << i << ' ' << crossing.point.coded[i];
    }
  }
}

TEST(Target, OutOfReachIsSaid) {
  const Regression regression = fit(hazelnut_runs());
  const TargetSet set = solve_target(regression, {500});
  EXPECT_FALSE(set.is_reached);
  EXPECT_THAT(set.grid, IsEmpty());
  EXPECT_THAT(codes_of(regression, 500), Contains("target_not_reached"));
}

TEST(SurfaceDiagnostics, HazelnutStudysAnalysisIsDoubted) {
  const std::vector<std::string> codes = codes_of(fit(hazelnut_runs()), 5);
  for (const char* code :
       {"absolute_error", "impossible_values", "no_effect", "ridge", "saddle", "not_determined"}) {
    EXPECT_THAT(codes, Contains(code));
  }
  EXPECT_THAT(codes, Not(Contains("lack_of_fit")));
}

TEST(SurfaceDiagnostics, AGoodSurfaceIsNotDoubted) {
  const auto bowl = [](const std::vector<double>& u) {
    return 20 + 2 * u[0] + 3 * std::pow(u[0] - .1, 2) + 4 * std::pow(u[1] - .2, 2);
  };
  EXPECT_THAT(codes_of(fit(runs_on(kTwo, bowl, .1))), IsEmpty());
}

TEST(SurfaceDiagnostics, ASmoothResponseThatTouchesZeroIsNoAbsoluteError) {
  const auto bowl = [](const std::vector<double>& u) {
    return 10 * (u[0] * u[0] + u[1] * u[1]) + .06;
  };
  EXPECT_THAT(codes_of(fit(runs_on(kTwo, bowl, .05))), Not(Contains("absolute_error")));
  const auto kink = [](const std::vector<double>& u) { return std::abs(20 * u[0] + 3 * u[1]); };
  EXPECT_THAT(codes_of(fit(runs_on(kTwo, kink, 0))), Contains("absolute_error"));
  // The same without the absolute value.
  const auto plane = [](const std::vector<double>& u) { return 20 * u[0] + 3 * u[1]; };
  EXPECT_THAT(codes_of(fit(runs_on(kTwo, plane, .1))), Not(Contains("absolute_error")));
}

TEST(SurfaceDiagnostics, AModelThatIsTooLowDoesNotFit) {
  const auto bowl = [](const std::vector<double>& u) { return 9 + u[0] * u[0]; };
  const Regression regression = regress(runs_on(kTwo, bowl, .01), SurfaceModel::linear);
  EXPECT_THAT(codes_of(regression), Contains("lack_of_fit"));
}

}  // namespace
}  // namespace repose::calibrate
