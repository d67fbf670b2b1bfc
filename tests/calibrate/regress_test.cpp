#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>

#include "calibrate/statistics/regress/regression.h"
#include "tests/calibrate/hazelnut_runs.h"
#include "tests/support/error_of.h"

namespace repose::calibrate {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// As many digits as printed in the study.
constexpr double kFourDigits = 5e-4;

void expect_digits(double value, double expected, double relative = kFourDigits) {
  EXPECT_NEAR(value, expected, relative * std::abs(expected));
}

RunTable line(const std::vector<double>& levels, const std::vector<double>& responses) {
  RunTable table;
  table.name = "line.csv";
  table.factors = {{"x", levels.front(), levels.back()}};
  table.levels = {levels};
  table.response_name = "y";
  table.responses = responses;
  return table;
}

std::string regression_error(const RunTable& table, SurfaceModel model) {
  return error_of([&] { regress(table, model); });
}

TEST(Regression, HazelnutStudysCoefficientsErrorsAndPValues) {
  const Regression fit = regress(hazelnut_runs(), SurfaceModel::quadratic);
  ASSERT_EQ(fit.coefficients.size(), 10U);
  const double values[] = {2.570, 1.064, -16.446, -3.871, 2.198,
                           1.373, 8.567, -.053,   10.942, 7.497};
  const double errors[] = {2.229, 1.479, 1.479, 1.479, 1.933, 1.933, 1.933, 1.440, 1.440, 1.440};
  const double p_values[] = {.2758, .4882,  5.96e-7, .0257,   .2820,
                             .4938, .00127, .9716,   1.84e-5, 3.97e-4};
  for (std::size_t k = 0; k < 10; ++k) {
    const Coefficient& coefficient = fit.coefficients[k];
    EXPECT_NEAR(coefficient.value, values[k], 6e-4) << k;  // three decimals, 8.5675 cut to 8.567
    EXPECT_NEAR(coefficient.standard_error, errors[k], 5e-4) << k;
    ASSERT_TRUE(coefficient.p) << k;
    expect_digits(*coefficient.p, p_values[k], 3e-3);  // three digits
  }
}

TEST(Regression, HazelnutStudysAnalysisOfVariance) {
  const Regression fit = regress(hazelnut_runs(), SurfaceModel::quadratic);
  EXPECT_NEAR(fit.r2, .958624, 1e-6);  // printed truncated, not rounded
  EXPECT_NEAR(fit.r2_adjusted, .9214, 5e-5);
  EXPECT_NEAR(*fit.explained.f, 25.743, 5e-4);
  expect_digits(*fit.explained.p, 9.167e-6);
  EXPECT_NEAR(fit.total.sum_of_squares, 7221.486, 5e-4);
  EXPECT_NEAR(fit.residual.sum_of_squares, 298.793, 5e-4);
  ASSERT_TRUE(fit.pure_error && fit.lack_of_fit);
  EXPECT_NEAR(fit.pure_error->sum_of_squares, 88.33, 5e-3);
  EXPECT_NEAR(fit.lack_of_fit->sum_of_squares, 210.46, 5e-3);
  EXPECT_EQ(fit.pure_error->df, 5);
  EXPECT_EQ(fit.lack_of_fit->df, 5);
  EXPECT_NEAR(*fit.lack_of_fit->f, 2.3828, 5e-5);
  EXPECT_NEAR(*fit.lack_of_fit->p, .18127, 5e-6);
}

TEST(Regression, HazelnutStudyAgreesWithLmOfR) {
  // m <- lm(y ~ x1*x2 + x1*x3 + x2*x3 + I(x1^2) + I(x2^2) + I(x3^2))
  // summary(m); drop1(m, . ~ ., test = "F"); sum((resid(m) / (1 - hatvalues(m)))^2)
  const Regression fit = regress(hazelnut_runs(), SurfaceModel::quadratic);
  constexpr double kEightDigits = 1e-8;
  expect_digits(fit.coefficients[2].value, -16.44559682911015, kEightDigits);
  expect_digits(*fit.coefficients[2].t, -11.1189113286265, kEightDigits);
  expect_digits(*fit.coefficients[2].p, 5.96458505092903e-07, kEightDigits);
  expect_digits(fit.coefficients[2].interval[0], -19.74115987085347, kEightDigits);
  expect_digits(fit.coefficients[2].interval[1], -13.1500337873668, kEightDigits);
  expect_digits(fit.coefficients[8].partial.sum_of_squares, 1726.029963991, kEightDigits);
  expect_digits(fit.coefficients[6].standard_error, 1.93259065818751, kEightDigits);
  expect_digits(fit.residual_sd, 5.46619183864866, kEightDigits);
  expect_digits(*fit.press, 1846.73963963773, kEightDigits);
  expect_digits(*fit.r2_predicted, .744271521737677, kEightDigits);
  // anova(lm(y ~ x2*x3 + I(x2^2) + I(x3^2)), m): all terms of x1 at once
  expect_digits(fit.of_factor[0].sum_of_squares, 69.21902090961, kEightDigits);
  EXPECT_EQ(fit.of_factor[0].df, 4);
  EXPECT_NEAR(*fit.of_factor[0].f, .57916, 5e-6);
  EXPECT_NEAR(*fit.of_factor[0].p, .68461, 5e-6);
}

TEST(Regression, CodingChangesNothingButTheCodedCoefficients) {
  const RunTable coded = hazelnut_runs();
  RunTable natural = coded;
  for (std::size_t i = 0; i < 3; ++i) {
    natural.factors[i] = {coded.factors[i].name, 1e4, 3e4 + static_cast<double>(i)};
    for (double& level : natural.levels[i]) level = natural.factors[i].natural(level);
  }
  const Regression a = regress(coded, SurfaceModel::quadratic);
  const Regression b = regress(natural, SurfaceModel::quadratic);
  for (std::size_t k = 0; k < a.coefficients.size(); ++k) {
    EXPECT_NEAR(a.coefficients[k].value, b.coefficients[k].value, 1e-9) << k;
    EXPECT_NEAR(*a.coefficients[k].p, *b.coefficients[k].p, 1e-9) << k;
    EXPECT_NEAR(a.coefficients[k].natural, a.coefficients[k].value, 1e-12) << k;
  }
  // The natural polynomial gives the same surface.
  const double u[] = {1.3e4, 2.2e4, 2.9e4};
  double value = 0;
  for (const Coefficient& coefficient : b.coefficients) {
    double product = coefficient.natural;
    for (const std::size_t factor : coefficient.term) product *= u[factor];
    value += product;
  }
  std::vector<double> x;
  for (std::size_t i = 0; i < 3; ++i) x.push_back(natural.factors[i].coded(u[i]));
  EXPECT_NEAR(value, b.predicted(x), 1e-6);
}

TEST(Regression, LongleysProblemHasNistsCertifiedValues) {
  // NIST Statistical Reference Datasets, Linear Least Squares Regression: Longley.
  RunTable table;
  table.name = "longley";
  table.levels = {{83.0, 88.5, 88.2, 89.5, 96.2, 98.1, 99.0, 100.0, 101.2, 104.6, 108.4, 110.8,
                   112.6, 114.2, 115.7, 116.9},
                  {234289, 259426, 258054, 284599, 328975, 346999, 365385, 363112, 397469, 419180,
                   442769, 444546, 482704, 502601, 518173, 554894},
                  {2356, 2325, 3682, 3351, 2099, 1932, 1870, 3578, 2904, 2822, 2936, 4681, 3813,
                   3931, 4806, 4007},
                  {1590, 1456, 1616, 1650, 3099, 3594, 3547, 3350, 3048, 2857, 2798, 2637, 2552,
                   2514, 2572, 2827},
                  {107608, 108632, 109773, 110929, 112075, 113270, 115094, 116219, 117388, 118734,
                   120445, 121950, 123366, 125368, 127852, 130081},
                  {1947, 1948, 1949, 1950, 1951, 1952, 1953, 1954, 1955, 1956, 1957, 1958, 1959,
                   1960, 1961, 1962}};
  table.response_name = "y";
  table.responses = {60323, 61122, 60171, 61187, 63221, 63639, 64989, 63761,
                     66019, 67857, 68169, 66513, 68655, 69564, 69331, 70551};
  for (std::size_t i = 0; i < 6; ++i) {
    table.factors.push_back({std::string("x").append(std::to_string(i + 1)),
                             table.levels[i].front() - 1, table.levels[i].back() + 1});
  }
  const Regression fit = regress(table, SurfaceModel::linear);
  const double certified[] = {-3482258.63459582, 15.0618722713733,  -0.358191792925910e-01,
                              -2.02022980381683, -1.03322686717359, -0.511041056535807e-01,
                              1829.15146461355};
  const double errors[] = {890420.383607373,  84.9149257747669,  0.334910077722432e-01,
                           0.488399681651699, 0.214274163161675, 0.226073200069370,
                           455.478499142212};
  for (std::size_t k = 0; k < 7; ++k) {
    expect_digits(fit.coefficients[k].natural, certified[k], 1e-9);
    if (k == 0) continue;
    const double half_range = table.factors[k - 1].half_range();
    expect_digits(fit.coefficients[k].standard_error / half_range, errors[k], 1e-9);
  }
  expect_digits(fit.residual_sd, 304.854073561965, 1e-10);
  expect_digits(fit.r2, .995479004577296, 1e-12);
  expect_digits(*fit.explained.f, 330.285339234588, 1e-9);
}

TEST(Regression, InteractionsAgreeWithLmOfR) {
  // summary(lm(Volume ~ Girth * Height, trees)), R's own data
  RunTable table;
  table.name = "trees";
  table.factors = {{"girth", 8.3, 20.6}, {"height", 63, 87}};
  table.levels = {
      {8.3,  8.6,  8.8,  10.5, 10.7, 10.8, 11,   11, 11.1, 11.2, 11.3, 11.4, 11.4, 11.7, 12,  12.9,
       12.9, 13.3, 13.7, 13.8, 14,   14.2, 14.5, 16, 16.3, 17.3, 17.5, 17.9, 18,   18,   20.6},
      {70, 65, 63, 72, 81, 83, 66, 75, 80, 75, 79, 76, 76, 69, 75, 74,
       85, 86, 71, 64, 78, 80, 74, 72, 77, 81, 82, 80, 80, 80, 87}};
  table.response_name = "volume";
  table.responses = {10.3, 10.3, 10.2, 16.4, 18.8, 19.7, 15.6, 18.2, 22.6, 19.9, 24.2,
                     21,   21.4, 21.3, 19.1, 22.2, 33.8, 27.4, 25.7, 24.9, 34.5, 31.7,
                     36.3, 38.3, 42.6, 55.4, 55.7, 58.3, 51.5, 51,   77};
  const Regression fit = regress(table, SurfaceModel::interaction);
  constexpr double kEightDigits = 1e-8;
  expect_digits(fit.coefficients[0].natural, 69.396315559307382, kEightDigits);
  expect_digits(fit.coefficients[1].natural, -5.855847929653999, kEightDigits);
  expect_digits(fit.coefficients[2].natural, -1.297083371665011, kEightDigits);
  expect_digits(fit.coefficients[3].natural, .134654394364201, kEightDigits);
  expect_digits(*fit.coefficients[3].t, 5.52375862764177, kEightDigits);
  expect_digits(*fit.coefficients[3].p, 7.48410255834492e-06, kEightDigits);
  expect_digits(fit.residual_sd, 2.70855003449835, kEightDigits);
  expect_digits(fit.r2_adjusted, .972849121451891, kEightDigits);
  expect_digits(*fit.explained.f, 359.312206998417, kEightDigits);
  expect_digits(*fit.press, 245.037411392937, kEightDigits);
}

TEST(Regression, LackOfFitAgreesWithAnovaOfR) {
  // C <- lm(dist ~ speed + I(speed^2), cars); anova(C, lm(dist ~ factor(speed), cars))
  // predict(C, data.frame(speed = c(10, 20)), se.fit = TRUE)
  RunTable table = line({4,  4,  7,  7,  8,  9,  10, 10, 10, 11, 11, 12, 12, 12, 12, 13, 13,
                         13, 13, 14, 14, 14, 14, 15, 15, 15, 16, 16, 17, 17, 17, 18, 18, 18,
                         18, 19, 19, 19, 20, 20, 20, 20, 20, 22, 23, 24, 24, 24, 24, 25},
                        {2,  10, 4,  22, 16, 10, 18, 26, 34, 17, 28, 14, 20, 24, 28,  26, 34,
                         34, 46, 26, 36, 60, 80, 20, 26, 54, 32, 40, 32, 40, 50, 42,  56, 76,
                         84, 36, 46, 68, 32, 48, 52, 56, 64, 66, 54, 70, 92, 93, 120, 85});
  const Regression fit = regress(table, SurfaceModel::quadratic);
  constexpr double kEightDigits = 1e-8;
  expect_digits(fit.coefficients[0].natural, 2.47013778506630, kEightDigits);
  expect_digits(fit.coefficients[1].natural, .913287614242585, kEightDigits);
  expect_digits(fit.coefficients[2].natural, .0999593020698439, kEightDigits);
  expect_digits(fit.residual_sd, 15.17607012432766, kEightDigits);
  expect_digits(fit.r2, .66733081652621, kEightDigits);
  expect_digits(fit.pure_error->sum_of_squares, 6764.783333333, kEightDigits);
  EXPECT_EQ(fit.lack_of_fit->df, 16);
  EXPECT_NEAR(*fit.lack_of_fit->f, 1.1628, 5e-5);
  EXPECT_NEAR(*fit.lack_of_fit->p, .34758, 5e-6);
  expect_digits(*fit.press, 12151.4587300074, kEightDigits);
  const double at_10 = fit.factors[0].coded(10), at_20 = fit.factors[0].coded(20);
  expect_digits(fit.standard_error({&at_10, 1}), 3.08507551048992, kEightDigits);
  expect_digits(fit.standard_error({&at_20, 1}), 2.86647836326184, kEightDigits);
}

TEST(Regression, AnExactFitHasNoTests) {
  const Regression fit = regress(line({0, 1, 2, 3, 4}, {1, 3, 5, 7, 9}), SurfaceModel::linear);
  EXPECT_TRUE(fit.is_exact);
  EXPECT_NEAR(fit.coefficients[1].natural, 2, 1e-12);
  EXPECT_FALSE(fit.coefficients[1].p);
  EXPECT_FALSE(fit.explained.f);
  EXPECT_NEAR(fit.r2, 1, 1e-12);
}

TEST(Regression, EqualRepeatsLeaveNothingToTestTheFitWith) {
  const Regression fit =
      regress(line({0, 0, 1, 1, 2, 2}, {1, 1, 2, 2, 5, 5}), SurfaceModel::linear);
  ASSERT_TRUE(fit.lack_of_fit);
  EXPECT_FALSE(fit.lack_of_fit->f);
  EXPECT_TRUE(fit.explained.f);
}

TEST(Regression, WithoutRepeatsThereIsNoPureError) {
  const Regression fit = regress(line({0, 1, 2, 3}, {1, 2.5, 2.6, 4}), SurfaceModel::linear);
  EXPECT_FALSE(fit.pure_error);
  EXPECT_FALSE(fit.lack_of_fit);
}

TEST(Regression, ARunThatAloneHoldsATermHasNoPredictedR2) {
  RunTable table = line({0, 0, 0, 1}, {1, 2, 1.5, 7});
  EXPECT_FALSE(regress(table, SurfaceModel::linear).press);
}

TEST(Regression, AllErrorsAreNamedAtOnce) {
  RunTable table = line({1, 1, 1}, {5, 5, 5});
  table.factors = {{"x", 0, 2}};
  const std::string error = regression_error(table, SurfaceModel::quadratic);
  EXPECT_THAT(error, AllOf(HasSubstr("line.csv: x is 1 in every run"),
                           HasSubstr("line.csv: y is 5 in every run"),
                           HasSubstr("3 runs for the 3 terms")));
}

TEST(Regression, WhatTheDesignCannotTellApartIsNamed) {
  const RunTable two_levels = line({-1, -1, 1, 1, -1, 1}, {1, 2, 3, 4, 2, 3});
  EXPECT_THAT(regression_error(two_levels, SurfaceModel::quadratic),
              AllOf(HasSubstr("cannot tell"), HasSubstr("Fix: ")));
  EXPECT_EQ(regression_error(two_levels, SurfaceModel::linear), "");

  // Steepest ascent: the factors increase together.
  RunTable together = line({0, .1, .2, .3, .4}, {1, 2, 4, 3, 5});
  together.factors = {{"a", 0, .4}, {"b", 0, .04}};
  together.levels.push_back({0, .01, .02, .03, .04});
  EXPECT_THAT(regression_error(together, SurfaceModel::linear),
              AllOf(HasSubstr("cannot tell"), Not(HasSubstr("constant"))));
}

/// A central composite design in two blocks: Myers and Montgomery, Response Surface Methodology, as
/// ChemReact in R's package rsm (Lenth 2009, J. Stat. Softw. 32, 7).
RunTable chemical_reaction() {
  RunTable table;
  table.name = "reaction.csv";
  table.factors = {{"x1", 80, 90}, {"x2", 170, 180}};
  table.levels = {{80, 80, 90, 90, 85, 85, 85, 85, 85, 85, 92.07, 77.93, 85, 85},
                  {170, 180, 170, 180, 175, 175, 175, 175, 175, 175, 175, 175, 182.07, 167.93}};
  table.response_name = "yield";
  table.responses = {80.5, 81.5, 82.0, 83.5, 83.9, 84.3, 84.0,
                     79.7, 79.8, 79.5, 78.4, 75.6, 78.5, 77.0};
  table.blocks = Blocks{"block", {"B1", "B2"}, {0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1}};
  return table;
}

TEST(RegressionBlocks, AgreeWithRsmOfR) {
  // summary(rsm(Yield ~ Block + SO(x1, x2), data = CR)), whose intercept is that of block B1
  const Regression fit = regress(chemical_reaction(), SurfaceModel::quadratic);
  ASSERT_TRUE(fit.blocks);
  constexpr double kSixDecimals = 6e-7;
  EXPECT_NEAR(fit.coefficients[0].value, 84.095427 - 4.457530 / 2, kSixDecimals);
  const double values[] = {.932541, .577712, .125000, -1.308555, -.933442};
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(fit.coefficients[k + 1].value, values[k], kSixDecimals) << k;
  }
  EXPECT_NEAR(fit.coefficients[1].standard_error, .057699, kSixDecimals);
  EXPECT_NEAR(fit.blocks->effects[0].value, 4.457530 / 2, kSixDecimals);
  EXPECT_NEAR(fit.blocks->effects[1].value, -4.457530 / 2, kSixDecimals);
  EXPECT_NEAR(fit.blocks->effects[1].standard_error, .087226 / 2, kSixDecimals);
  EXPECT_EQ(fit.blocks->variance.df, 1);
  EXPECT_NEAR(fit.blocks->variance.sum_of_squares, 69.531, 5e-4);
  EXPECT_NEAR(fit.explained.sum_of_squares, 9.626 + .063 + 17.791, 2e-3);
  EXPECT_EQ(fit.residual.df, 7);
  EXPECT_NEAR(fit.residual.sum_of_squares, .186, 5e-4);
  EXPECT_EQ(fit.pure_error->df, 4);
  EXPECT_NEAR(*fit.lack_of_fit->f, .5307, 5e-5);
  EXPECT_NEAR(*fit.lack_of_fit->p, .6851, 5e-5);
  EXPECT_NEAR(fit.total.sum_of_squares,
              fit.blocks->variance.sum_of_squares + fit.explained.sum_of_squares +
                  fit.residual.sum_of_squares,
              1e-9);
}

TEST(RegressionBlocks, AShiftOfABlockMovesNothingButItsEffect) {
  RunTable table = chemical_reaction();
  const Regression before = regress(table, SurfaceModel::quadratic);
  for (std::size_t run = 7; run < 14; ++run) table.responses[run] += 10;
  const Regression after = regress(table, SurfaceModel::quadratic);
  for (std::size_t k = 1; k < before.coefficients.size(); ++k) {
    EXPECT_NEAR(after.coefficients[k].value, before.coefficients[k].value, 1e-9);
    EXPECT_NEAR(*after.coefficients[k].p, *before.coefficients[k].p, 1e-9);
  }
  EXPECT_NEAR(after.coefficients[0].value, before.coefficients[0].value + 5, 1e-9);
  EXPECT_NEAR(after.r2, before.r2, 1e-9);
  EXPECT_NEAR(*after.r2_predicted, *before.r2_predicted, 1e-9);
  EXPECT_NEAR(after.runs[8].fitted, before.runs[8].fitted + 10, 1e-9);
}

TEST(RegressionBlocks, WhatBlocksMixUpIsNamed) {
  RunTable same = line({0, 0, 0, 1, 1, 1}, {1, 2, 3, 5, 6, 7});
  same.blocks = Blocks{"day", {"Mon", "Tue"}, {0, 0, 0, 1, 1, 1}};
  EXPECT_THAT(regression_error(same, SurfaceModel::linear),
              AllOf(HasSubstr("cannot tell"), HasSubstr("choose no blocks")));
  same.blocks->labels = {"Mon"};
  same.blocks->of_runs.assign(6, 0);
  EXPECT_THAT(regression_error(same, SurfaceModel::linear), HasSubstr("day is the same in every"));
  RunTable flat = line({0, 1, 2, 0, 1, 2}, {1, 1, 1, 5, 5, 5});
  flat.blocks = Blocks{"day", {"Mon", "Tue"}, {0, 0, 0, 1, 1, 1}};
  EXPECT_THAT(regression_error(flat, SurfaceModel::linear),
              HasSubstr("y only differs between the blocks of day"));
}

TEST(Regression, NumbersThatAreNoneAreRefused) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(regression_error(line({0, 1, 2, 3}, {1, kNan, 2, 3}), SurfaceModel::linear),
              HasSubstr("y has values that are not finite"));
  EXPECT_THAT(regression_error(line({0, 1, kNan, 3}, {1, 1, 2, 3}), SurfaceModel::linear),
              HasSubstr("x has values that are not finite"));
  EXPECT_THAT(regression_error(line({0, 1}, {1}), SurfaceModel::linear),
              HasSubstr("2 values for 1 runs"));
  RunTable empty;
  empty.name = "empty";
  EXPECT_THAT(regression_error(empty, SurfaceModel::quadratic), HasSubstr("0 factors"));
}

}  // namespace
}  // namespace repose::calibrate
