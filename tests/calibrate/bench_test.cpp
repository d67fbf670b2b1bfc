#include "calibrate/statistics/bench/bench.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>

#include <gmock/gmock.h>

#include "tests/support/error_of.h"

namespace repose::calibrate {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kRad = std::numbers::pi / 180;

std::string row_name(std::size_t number) {
  return std::string("row ").append(std::to_string(number));
}

std::vector<BenchReading> readings(const std::vector<std::vector<double>>& rows) {
  std::vector<BenchReading> readings;
  for (const std::vector<double>& row : rows) {
    readings.push_back({row_name(readings.size() + 1), row, ""});
  }
  return readings;
}

std::string bench_error(BenchTest test, const std::vector<std::vector<double>>& rows) {
  return error_of([&] { evaluate_bench(test, readings(rows)); });
}

TEST(BenchFormulas, HazelnutStudysMeansGiveItsCoefficients) {
  EXPECT_NEAR(restitution_of(.5, .00942), .137, 5e-4);
  EXPECT_NEAR(sliding_friction_of(22.70 * kRad), .418, 5e-4);
  EXPECT_NEAR(rolling_friction_of(20 * kRad, .150, .32281), .1106, 5e-5);
}

TEST(BenchFormulas, AgreeWithClosedForms) {
  // A ball that keeps the fraction e of its speed rises to e^2 H.
  EXPECT_DOUBLE_EQ(restitution_of(2, .81 * 2), .9);
  EXPECT_DOUBLE_EQ(restitution_of(1, 0), 0);
  EXPECT_NEAR(sliding_friction_of(45 * kRad), 1, 1e-15);
  // L = S (sin b - mu cos b) / mu, the closed form of the engine's roll.
  const double mu = .04, s = .15, b = 20 * kRad;
  EXPECT_NEAR(rolling_friction_of(b, s, s * (std::sin(b) - mu * std::cos(b)) / mu), mu, 1e-15);
  // Stopping at the foot: mu = tan(b).
  EXPECT_NEAR(rolling_friction_of(b, s, 0), std::tan(b), 1e-15);
  EXPECT_DOUBLE_EQ(density_of(.003, 3e-6), 1000);
  // A bar of 1 cm2, 10 cm long, of 210 GPa, shortens by 10 um under 2100 N, and its 1 cm of width
  // grows by 3 um with nu = .3.
  EXPECT_NEAR(young_modulus_of(2100, 1e-4, 1e-5, .1), 2.1e11, 1);
  EXPECT_NEAR(poisson_ratio_of(.3e-6, .01, 1e-5, .1), .3, 1e-12);
  EXPECT_DOUBLE_EQ(geometric_mean_diameter_of(4, 2, 1), 2);
  EXPECT_DOUBLE_EQ(sphericity_of(4, 2, 1), .5);
  EXPECT_DOUBLE_EQ(sphericity_of(3, 3, 3), 1);
}

// Simulated by the engine: a ball of R = 10 mm rolls down 20 degrees from S = 150 mm (restitution
// .01, sliding friction 1).
TEST(BenchFormulas, RollingFrictionWithTheFootIsThatOfTheSimulation) {
  for (const auto& [mu, stopped_mm] :
       {std::pair{.02, 2173.4}, std::pair{.05, 782.7}, std::pair{.1, 321.5}}) {
    EXPECT_NEAR(rolled_distance_m(mu, 20 * kRad, .15, .01) / (1e-3 * stopped_mm), 1, 1e-3);
    EXPECT_NEAR(rolling_friction_of(20 * kRad, .15, 1e-3 * stopped_mm, .01) / mu, 1, 1e-3);
  }
  EXPECT_NEAR(rolling_friction_of(20 * kRad, .15, .7824), .05556, 5e-6) << "without";
}

TEST(BenchFormulas, RollingFrictionWithTheFootIsTheInverseOfTheDistance) {
  for (const double incline : {2., 20., 45., 70.}) {
    for (const double mu : {.001, .03, .2}) {
      if (mu >= std::tan(incline * kRad)) continue;
      const double stopped = rolled_distance_m(mu, incline * kRad, .3, .004);
      EXPECT_NEAR(rolling_friction_of(incline * kRad, .3, stopped, .004), mu, 1e-9 * mu) << incline;
    }
  }
  // The foot of a gentle slope takes no speed: only the offset of the contact point is left.
  const double mu = .001, b = .5 * kRad;
  EXPECT_NEAR(rolled_distance_m(mu, b, .3, 1e-6), .3 * (std::sin(b) - mu * std::cos(b)) / mu,
              1e-3 * .3);
  EXPECT_NEAR(foot_distance_m(90 * kRad, .01), .01, 1e-12) << "a ball in a corner";
}

TEST(Bench, ADiameterTakesOutTheFoot) {
  std::vector<BenchReading> rows = readings({{20, 150, 782.4}});
  const BenchResult without = evaluate_bench(bench_test_named("rolling"), rows);
  EXPECT_NEAR(without.quantities.front().repeats.mean, .05556, 5e-6);
  EXPECT_THAT(without.notes, Contains(AllOf(HasSubstr("foot of the incline is neglected"),
                                            HasSubstr("0.05 for one of 20 mm"))));
  rows.front().optional = {{"diameter_mm", 20}};
  const BenchResult with = evaluate_bench(bench_test_named("rolling"), rows);
  EXPECT_NEAR(with.quantities.front().repeats.mean, .05, 5e-5);
  EXPECT_THAT(with.notes, Contains(HasSubstr("without that mu_r would be 0.05556")));
  rows.front().optional = {{"diameter_mm", 2000}};
  EXPECT_THAT(error_of([&] { evaluate_bench(bench_test_named("rolling"), rows); }),
              AllOf(HasSubstr("row 1: released_mm = 150: a ball of diameter_mm = 2000"),
                    HasSubstr("176.3 mm from the foot")));
}

/// As in simulations: Roll.AGrainThatStaysOnTheIncline*.
TEST(Bench, AGrainThatStaysOnTheInclineCountsAsZero) {
  std::vector<BenchReading> rows = readings({{20, 150, 782.4}, {20, 150, 0}});
  const double tangent = std::tan(20 * kRad);
  const BenchResult without = evaluate_bench(bench_test_named("rolling"), rows);
  EXPECT_NEAR(without.quantities.front().repeats.mean, (.05556 + tangent) / 2, 5e-6);
  EXPECT_THAT(without.notes, Contains(AllOf(HasSubstr("1 of 2 stayed on the incline"),
                                            HasSubstr("the mean is a lower bound"))));
  for (BenchReading& row : rows) row.optional = {{"diameter_mm", 20}};
  const BenchResult with = evaluate_bench(bench_test_named("rolling"), rows);
  EXPECT_NEAR(with.quantities.front().repeats.mean, (.05 + tangent) / 2, 5e-5);
  rows.back().values.back() = -150;
  EXPECT_THAT(error_of([&] { evaluate_bench(bench_test_named("rolling"), rows); }),
              AllOf(HasSubstr("row 2: stopped_mm = -150"),
                    HasSubstr("0 of a grain that stayed on the incline")));
}

TEST(Bench, TheGrainsSizeAndDensityTakeOutTheAir) {
  std::vector<BenchReading> rows = readings({{500, .458 * .458 * 500}});
  const BenchResult without = evaluate_bench(bench_test_named("restitution"), rows);
  EXPECT_NEAR(without.quantities.front().repeats.mean, .458, 1e-9);
  EXPECT_THAT(without.notes, Contains(HasSubstr("The air's drag is neglected")));
  rows.front().optional = {{"diameter_mm", 2}, {"density_kg_m3", 1100}};
  const BenchResult with = evaluate_bench(bench_test_named("restitution"), rows);
  EXPECT_NEAR(with.quantities.front().repeats.mean, .5, 5e-4);
  EXPECT_THAT(with.notes,
              Contains(AllOf(HasSubstr("without that e would be 0.458"), HasSubstr("± 0.003"))));
  rows.front().optional = {{"in_air", 0}};
  const BenchResult tracked = evaluate_bench(bench_test_named("restitution"), rows);
  EXPECT_NEAR(tracked.quantities.front().repeats.mean, .458, 1e-9);
  EXPECT_THAT(tracked.notes, Contains(HasSubstr("free of the air's drag")));
}

TEST(Bench, OptionalColumnsAreCheckedToo) {
  std::vector<BenchReading> rows = readings({{500, 100}, {500, 110}});
  const auto error = [&] {
    return error_of([&] { evaluate_bench(bench_test_named("restitution"), rows); });
  };
  rows[0].optional = {{"diameter_mm", 2}};
  rows[1].optional = {{"diameter_mm", 2}};
  EXPECT_THAT(error(), HasSubstr("row 2: diameter_mm is given without density_kg_m3"));
  rows[0].optional = rows[1].optional = {{"diameter_mm", -2}, {"density_kg_m3", 1100}};
  EXPECT_THAT(error(), HasSubstr("row 1: diameter_mm = -2"));
  rows[0].optional = {};
  rows[1].optional = {{"diameter_mm", 2}, {"density_kg_m3", 1100}};
  EXPECT_THAT(error(), HasSubstr("row 1: has no diameter_mm, which other readings have"));
  rows[0].optional = rows[1].optional = {{"in_air", .5}};
  EXPECT_THAT(error(), HasSubstr("in_air = 0.5"));
  rows = readings({{500, 480}});
  rows[0].optional = {{"diameter_mm", .2}, {"density_kg_m3", 50}};
  EXPECT_THAT(error(), HasSubstr("cannot rise so high in air"));
}

TEST(Bench, ReadingsAreInTheUnitsOfTheirNames) {
  const auto value = [](BenchTest test, const std::vector<double>& row) {
    return evaluate_bench(test, readings({row})).quantities.front().repeats.mean;
  };
  EXPECT_NEAR(value(bench_test_named("restitution"), {500, 9.42}), .1372589, 1e-7);
  EXPECT_NEAR(value(bench_test_named("sliding"), {22.70}), .4183, 5e-5);
  EXPECT_NEAR(value(bench_test_named("rolling"), {20, 150, 322.81}), .1106, 5e-5);
  EXPECT_NEAR(value(bench_test_named("density"), {2.553, 40, 43}), 851, 1e-9);
  EXPECT_NEAR(value(bench_test_named("drop_on_grains"), {200, 31}), 31, 1e-12);
  EXPECT_NEAR(value(bench_test_named("tilt_on_grains"), {44.8}), 44.8, 1e-12);
  EXPECT_NEAR(value(bench_test_named("roll_on_grains"), {39.1}), 39.1, 1e-12);
  EXPECT_NEAR(value(bench_test_named("fill"), {1530}), 1530, 1e-12);
  EXPECT_NEAR(value(bench_test_named("draw_down"), {71.5}), 71.5, 1e-12);
  EXPECT_NEAR(value(bench_test_named("pendulum"), {30, 30}), 1, 1e-12);
  // e = .5: the struck ball takes three quarters of the speed, and of the sine of half the angle.
  EXPECT_NEAR(value(bench_test_named("pendulum"), {60, 44.0486256}), .5, 1e-7);
  // 1000 N on a contact spot of 4 mm, compressed by a tenth of its height.
  EXPECT_NEAR(value(bench_test_named("young"), {1000, 4, 18, 1.8}),
              1000 / (4e-6 * std::numbers::pi) / .1, 1);
  EXPECT_NEAR(value(bench_test_named("poisson"), {18, 2, 17, .38 * 2. / 18 * 17}), .38, 1e-12);
}

TEST(Bench, RepeatsHaveMeanScatterAndStudentsInterval) {
  const BenchResult result = evaluate_bench(bench_test_named("sliding"),
                                            readings({{22.1}, {22.9}, {23.1}, {22.3}, {22.6}}));
  const auto& [n, mean, sd, uncertainty] = result.quantities.front().repeats;
  EXPECT_EQ(n, 5);
  ASSERT_TRUE(sd && uncertainty);
  EXPECT_NEAR(mean, .41628005810256, 1e-13);
  EXPECT_NEAR(*uncertainty / *sd, 2.776445 / std::sqrt(5.0), 1e-6);  // t(.975; 4)
}

TEST(Bench, OneReadingHasNoScatter) {
  const BenchResult result = evaluate_bench(bench_test_named("sliding"), readings({{22.7}}));
  EXPECT_FALSE(result.quantities.front().repeats.sd);
  EXPECT_FALSE(result.quantities.front().repeats.mean_uncertainty);
  EXPECT_THAT(result.notes, Contains(HasSubstr("One reading")));
}

TEST(Bench, EqualReadingsAreSaidToHideTheScatter) {
  const BenchResult result =
      evaluate_bench(bench_test_named("sliding"), readings({{22}, {22}, {22}}));
  EXPECT_THAT(result.notes, Contains(HasSubstr("are the same")));
}

TEST(Bench, IntervalsThatReachTooFarAreSaid) {
  const BenchResult result =
      evaluate_bench(bench_test_named("restitution"), readings({{500, 1}, {500, 90}}));
  EXPECT_THAT(result.notes, Contains(HasSubstr("impossible")));
}

TEST(Bench, DropsThatDifferAreNamed) {
  std::vector<BenchReading> rows = readings({{500, 180}, {505, 190}, {301, 193}, {496, 170}});
  rows[2].place = "drops.csv:4";
  EXPECT_THAT(evaluate_bench(bench_test_named("restitution"), rows).notes,
              Contains(AllOf(HasSubstr("1 of 4 drops"), HasSubstr("drops.csv:4 (301 mm)"))));
  rows.erase(rows.begin() + 2);
  EXPECT_THAT(evaluate_bench(bench_test_named("restitution"), rows).notes,
              Not(Contains(HasSubstr("another height"))));
}

TEST(Bench, RepeatsOnOneSampleAreAveragedFirst) {
  std::vector<BenchReading> rows = readings({{1, 0, 1}, {1.2, 0, 1}, {2, 0, 1}});
  rows[0].sample = rows[1].sample = "A";
  rows[2].sample = "B";
  const BenchResult result = evaluate_bench(bench_test_named("density"), rows);
  const BenchQuantity& density = result.quantities.front();
  EXPECT_EQ(density.repeats.n, 2);
  EXPECT_NEAR(density.values[0], 1100, 1e-9);
  EXPECT_NEAR(density.repeats.mean, 1550, 1e-9);
  EXPECT_THAT(result.notes, Contains(HasSubstr("3 readings of 2 samples")));
}

TEST(Bench, SizesGiveDiameterAndSphericity) {
  const BenchResult result = evaluate_bench(
      bench_test_named("size"), readings({{22.48, 18.23, 17.46}, {22.48, 18.23, 17.46}}));
  ASSERT_EQ(result.quantities.size(), 5U);
  EXPECT_NEAR(result.quantities[3].repeats.mean, std::cbrt(22.48 * 18.23 * 17.46), 1e-12);
  EXPECT_NEAR(result.quantities[4].repeats.mean, .8572, 5e-5);
}

TEST(Bench, ImpossibleReadingsAreRefusedAllAtOnce) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(bench_error(bench_test_named("restitution"),
                          {{500, 510}, {500, 9}, {0, 9}, {500, -1}, {kNan, 1}}),
              AllOf(HasSubstr("row 1: rebound_mm = 510 is more than drop_mm = 500"),
                    HasSubstr("row 3: drop_mm = 0"), HasSubstr("row 4: rebound_mm = -1"),
                    HasSubstr("row 5: drop_mm = nan")));
  EXPECT_THAT(bench_error(bench_test_named("sliding"), {{90}, {0}, {120}}),
              AllOf(HasSubstr("row 1: angle_deg = 90"), HasSubstr("row 2: angle_deg = 0"),
                    HasSubstr("row 3: angle_deg = 120")));
  EXPECT_THAT(bench_error(bench_test_named("rolling"), {{20, -1, 5}, {95, 150, 300}}),
              AllOf(HasSubstr("released_mm = -1"), HasSubstr("incline_deg = 95")));
  EXPECT_THAT(bench_error(bench_test_named("poisson"),
                          {{10, 1, 10, .5}, {10, 1, 10, -1.2}, {10, 11, 10, 1}}),
              AllOf(HasSubstr("row 1: Poisson's ratio would be 0.5"),
                    HasSubstr("row 2: Poisson's ratio would be -1.2"),
                    HasSubstr("row 3: shortening_mm = 11")));
  EXPECT_THAT(bench_error(bench_test_named("density"), {{3, 40, 39}, {3, 0, 3000}}),
              AllOf(HasSubstr("no liquid was displaced"), HasSubstr("no grain is")));
  EXPECT_THAT(bench_error(bench_test_named("young"), {{10, 2, 5, 5}}),
              HasSubstr("compression_mm = 5"));
  EXPECT_THAT(bench_error(bench_test_named("size"), {{10, 12, 9}}), HasSubstr("not the longest"));
  EXPECT_THAT(bench_error(bench_test_named("pendulum"), {{30, 31}, {30, -1}}),
              AllOf(HasSubstr("swing_deg = 31 is more than release_deg = 30"),
                    HasSubstr("swing_deg = -1")));
  EXPECT_THAT(bench_error(bench_test_named("fill"), {{-5}}), HasSubstr("bulk_density_kg_m3 = -5"));
  EXPECT_THAT(bench_error(bench_test_named("draw_down"), {{0}, {100}}),
              AllOf(HasSubstr("row 1: discharged_percent = 0"),
                    HasSubstr("row 2: discharged_percent = 100")));
  EXPECT_THAT(bench_error(bench_test_named("size"), {}), HasSubstr("no readings"));
  EXPECT_THAT(bench_error(bench_test_named("size"), {{1, 2}}),
              HasSubstr("2 values are given for 3 columns"));
}

TEST(Bench, AuxeticAndBouncelessGrainsArePossible) {
  EXPECT_EQ(bench_error(bench_test_named("poisson"), {{10, 1, 10, -.3}}), "");
  EXPECT_EQ(bench_error(bench_test_named("restitution"), {{500, 0}, {500, 500}}), "");
}

}  // namespace
}  // namespace repose::calibrate
