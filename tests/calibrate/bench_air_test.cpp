#include <cmath>
#include <string>

#include <gmock/gmock.h>

#include "base/air_drag.h"
#include "calibrate/bench/bench_readings.h"
#include "calibrate/study/study_record.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/study/grain_source.h"
#include "tests/calibrate/sphere_study.h"
#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using repose::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class BenchAir : public ::testing::Test {
 protected:
  /// Balls of 20 mm dropped from 100 mm: the study of 1000 kg/m3, with another density.
  dem::Study study(const std::string& measured, double density = 20) const {
    std::string text = test::kSphereStudy;
    const std::string was = "{ mean = 25, sd = 1, n = 5 }";
    text.replace(text.find(was), was.size(), measured);
    return dem::read_study(folder_.write("study.toml", text),
                           {"particle.density_kg_m3 = " + std::to_string(density)});
  }

  static dem::Measured drops(const dem::Study& study, const std::vector<FilmReading>& films = {}) {
    const dem::ClumpFile grain = dem::build_grain(study.grain);
    return dem::measured_in(
        as_measured(
            study, grain.shape,
            {.sheets = read_sheets(study, NoRows::refused), .pictures = {}, .films = films}),
        dem::experiment_of<dem::DropProtocol>());
  }

  TemporaryFolder folder_;
};

// Foam balls: v^2 before the impact is (g / k) (1 - exp(-2 k H)), after it (g / k) (exp(2 k h) - 1)
// with k = 3 Cd p / (4 q d) and Cd about .5 at Reynolds numbers of 900 to 1800.
TEST_F(BenchAir, HeightsAreThoseOfAFallWithoutAir) {
  const dem::Measured corrected = drops(study("{ mean = 25, sd = 1, n = 5 }"));
  const double k = .75 * .47 * 1.204 / (20 * .02);
  const double expected = 100 * std::expm1(2 * k * .025) / -std::expm1(-2 * k * .1);
  EXPECT_NEAR(*corrected.mean, expected, .15 * (expected - 25));
  EXPECT_GT(*corrected.sd, 1);
  ASSERT_EQ(corrected.systematic.size(), 1U);
  EXPECT_NEAR(corrected.systematic[0].sd, .07 * (*corrected.mean - 25), 1e-9);
  EXPECT_THAT(corrected.systematic[0].note,
              AllOf(HasSubstr("25 mm read in air count as"), HasSubstr("in_air = false")));
  const dem::Measured single = drops(study("{ values = [25, 25] }"));
  EXPECT_NEAR(single.values.at(1), *corrected.mean, 1e-12);
}

TEST_F(BenchAir, WhatIsFreeOfItIsLeftAlone) {
  const dem::Measured told = drops(study("{ mean = 25, sd = 1, n = 5, in_air = false }"));
  EXPECT_EQ(told.mean, 25);
  EXPECT_THAT(told.systematic, IsEmpty());
  folder_.write("drops.csv", std::string("drop_mm,rebound_mm,in_air\n100,25,0\n100,26,0\n"));
  EXPECT_THAT(drops(study("{ readings = \"drops.csv\" }")).values, ::testing::ElementsAre(25, 26));
  folder_.write("a.mp4", std::string("not looked at here"));
  const std::vector<FilmReading> films = {{.experiment = "drop",
                                           .file = "a.mp4",
                                           .status = "ok",
                                           .value = 25,
                                           .uncertainty = 1,
                                           .reason = {}}};
  EXPECT_THAT(drops(study("{ videos = [\"a.mp4\"] }"), films).values, ::testing::ElementsAre(25));
}

TEST_F(BenchAir, SheetsAreReadInAirUnlessTheySayOtherwise) {
  folder_.write("drops.csv", std::string("drop_mm,rebound_mm\n100,25\n100,26\n"));
  EXPECT_GT(drops(study("{ readings = \"drops.csv\" }")).values.at(0), 25.5);
  folder_.write("drops.csv", std::string("drop_mm,rebound_mm,in_air\n100,25,0\n100,26,1\n"));
  EXPECT_THAT(error_of([&] { drops(study("{ readings = \"drops.csv\" }")); }),
              HasSubstr("in_air differs from row to row"));
}

TEST_F(BenchAir, ReboundsThatNoGrainHasInAirAreRefused) {
  EXPECT_THAT(
      error_of([&] { drops(study("{ mean = 97, sd = 1, n = 5 }")); }),
      AllOf(HasSubstr("[experiment.drop]: a rebound of 97 mm"), HasSubstr("in_air = false")));
}

TEST_F(BenchAir, IsSaidAndCountsInTheUncertaintyOfTheMean) {
  const dem::Study read = study("{ mean = 25, sd = 1, n = 5 }");
  const dem::ClumpFile grain = dem::build_grain(read.grain);
  const Observable drop = problem_of(without_air(read, grain.shape), grain, budget_named("quick"))
                              .problem.observables.at(0);
  EXPECT_GT(drop.systematic_sd, 0);
  EXPECT_THAT(drop.systematic.at(0).note, HasSubstr("the drag of the air is taken out"));
  EXPECT_NEAR(with_systematic(drop, standard_uncertainty(drop)),
              std::hypot(*drop.sd / std::sqrt(5), drop.systematic_sd), 1e-12);
}

// d rise / d read by finite differences: correcting the heights scales the ruler's error with them.
TEST_F(BenchAir, WhatReadingsShareIsRaisedWithThem) {
  const dem::Measured low = drops(study("{ mean = 24.9, bias_sd = 0.4 }"));
  const dem::Measured high = drops(study("{ mean = 25.1, bias_sd = 0.4 }"));
  const double slope = (*high.mean - *low.mean) / .2;
  ASSERT_EQ(low.systematic.size(), 2U);
  EXPECT_EQ(low.systematic[0].name, "bias_sd");
  EXPECT_EQ(low.systematic[1].name, "air_drag");
  EXPECT_GT(slope, 1.001);
  EXPECT_NEAR(low.systematic[0].sd, .4 * slope, 1e-3);
}

TEST_F(BenchAir, OnlyDropsMayBeFreeOfIt) {
  const auto read = [&] {
    dem::read_study(folder_.write("study.toml", test::kSphereStudy),
                    {"experiment.tilt.measured = { mean = 20, in_air = false }"});
  };
  EXPECT_THAT(error_of(read), HasSubstr("only of drop, drop_on_grains"));
}

// Prolate, twice as long as wide: surface 2 pi b^2 (1 + a / (b e) asin(e)), e^2 = 1 - b^2 / a^2.
TEST(FallingGrain, HasTheSphericityOfItsEllipsoid) {
  EXPECT_NEAR(falling_grain(dem::sphere_shape(.01), 1000).sphericity, 1, 1e-12);
  EXPECT_NEAR(falling_grain(dem::sphere_shape(.01), 1000).diameter_m, .02, 1e-12);
  dem::ClumpShape prolate = dem::sphere_shape(.01);
  const double a2 = 4e-4, b2 = 1e-4;
  prolate.gyration_m2 = {2 * b2 / 5, (a2 + b2) / 5, (a2 + b2) / 5};
  const double e = std::sqrt(.75);
  const double surface = 2 * (1 + 2 / e * std::asin(e));
  EXPECT_NEAR(falling_grain(prolate, 1000).sphericity, 4 * std::pow(2, 2. / 3) / surface, .011);
}

}  // namespace
}  // namespace repose::calibrate
