#include "calibrate/statistics/design/design.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include <gmock/gmock.h>

#include "tests/calibrate/hazelnut_runs.h"
#include "tests/support/error_of.h"

namespace repose::calibrate {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::vector<Factor> factors(int count) {
  std::vector<Factor> factors;
  for (int i = 0; i < count; ++i) factors.push_back({std::string(1, static_cast<char>('a' + i))});
  return factors;
}

/// Mean over the runs of the product of the factors' powers.
double moment(const Design& design, const std::vector<int>& powers) {
  double sum = 0;
  for (const DesignRun& run : design.runs) {
    double product = 1;
    for (std::size_t i = 0; i < powers.size(); ++i) product *= std::pow(run.coded[i], powers[i]);
    sum += product;
  }
  return sum / static_cast<double>(design.runs.size());
}

double closest_pair(const Design& design) {
  double least = std::numeric_limits<double>::infinity();
  for (const DesignRun& a : design.runs) {
    for (const DesignRun& b : design.runs) {
      if (&a == &b) continue;
      double square = 0;
      for (std::size_t i = 0; i < a.coded.size(); ++i)
        square += std::pow(a.coded[i] - b.coded[i], 2);
      least = std::min(least, std::sqrt(square));
    }
  }
  return least;
}

TEST(CentralComposite, IsTheHazelnutStudysDesign) {
  const RunTable study = hazelnut_runs();
  const Design design =
      central_composite(factors(3), {.rule = {}, .alpha = 1.682, .centre_runs = 6});
  ASSERT_EQ(design.runs.size(), 20U);
  for (std::size_t run = 0; run < 20; ++run) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(design.runs[run].coded[i], study.levels[i][run]) << run;
    }
  }
  EXPECT_EQ(design.runs[0].kind, PointKind::cube);
  EXPECT_EQ(design.runs[8].kind, PointKind::axial);
  EXPECT_EQ(design.runs[14].kind, PointKind::centre);
}

TEST(CentralComposite, RotatableOnesHaveTheMomentsOfASphere) {
  for (const int count : {2, 3, 4, 5, 6}) {
    const Design design = central_composite(factors(count));
    // [iiii] = 3 [iijj]: Box and Hunter (1957).
    EXPECT_NEAR(moment(design, {4}), 3 * moment(design, {2, 2}), 1e-12) << count;
    EXPECT_NEAR(moment(design, {1, 1}), 0, 1e-15);
    EXPECT_NEAR(moment(design, {3}), 0, 1e-15);
  }
  const Design three = central_composite(factors(3));
  EXPECT_NEAR(three.runs[9].coded[0], 1.6818, 5e-5);
}

TEST(CentralComposite, OrthogonalOnesHaveUncorrelatedSquares) {
  for (const int count : {2, 3, 4}) {
    for (const int centre : {1, 3, 6}) {
      const Design design = central_composite(
          factors(count), {.rule = AxialRule::orthogonal, .alpha = {}, .centre_runs = centre});
      EXPECT_NEAR(moment(design, {2, 2}), moment(design, {2}) * moment(design, {0, 2}), 1e-12);
    }
  }
}

TEST(CentralComposite, FaceCentredAndInscribedOnesStayInTheRange) {
  const CompositeOptions face{.rule = AxialRule::face, .alpha = {}};
  CompositeOptions inscribed;
  inscribed.is_inscribed = true;
  for (const CompositeOptions& options : {face, inscribed}) {
    double farthest = 0;
    for (const DesignRun& run : central_composite(factors(3), options).runs) {
      for (const double level : run.coded) farthest = std::max(farthest, std::abs(level));
    }
    EXPECT_NEAR(farthest, 1, 1e-12);
  }
}

TEST(BoxBehnken, HasTheNumbersOfRunsOfThePaper) {
  const std::array<std::size_t, 5> runs = {15, 27, 46, 54, 62};
  for (int count = 3; count <= 7; ++count) {
    EXPECT_EQ(box_behnken(factors(count)).runs.size(), runs[static_cast<std::size_t>(count - 3)]);
  }
}

TEST(BoxBehnken, IsBalancedAndHasNoCorners) {
  for (int count = 3; count <= 7; ++count) {
    const Design design = box_behnken(factors(count), 1);
    std::set<std::vector<double>> different;
    for (const DesignRun& run : design.runs) {
      different.insert(run.coded);
      EXPECT_TRUE(std::count(run.coded.begin(), run.coded.end(), 0.0) > 0) << "a corner";
    }
    EXPECT_EQ(different.size(), design.runs.size());
    for (int i = 0; i < count; ++i) {
      std::vector<int> alone(static_cast<std::size_t>(count), 0);
      alone[static_cast<std::size_t>(i)] = 2;
      EXPECT_NEAR(moment(design, alone), moment(design, {2}), 1e-12) << count << ' ' << i;
      for (int j = 0; j < i; ++j) {
        std::vector<int> pair(static_cast<std::size_t>(count), 0);
        pair[static_cast<std::size_t>(i)] = pair[static_cast<std::size_t>(j)] = 2;
        EXPECT_GT(moment(design, pair), 0) << "an interaction that cannot be fitted";
      }
    }
  }
}

TEST(LatinHypercube, UsesEachLevelOfEachFactorOnce) {
  const Design design = latin_hypercube(factors(4), 17, 3);
  for (std::size_t i = 0; i < 4; ++i) {
    std::vector<double> levels;
    for (const DesignRun& run : design.runs) levels.push_back(run.coded[i]);
    std::sort(levels.begin(), levels.end());
    for (int k = 0; k < 17; ++k) {
      EXPECT_NEAR(levels[static_cast<std::size_t>(k)], (2.0 * k + 1) / 17 - 1, 1e-15);
    }
  }
}

TEST(LatinHypercube, IsTheSameForTheSameSeedOnly) {
  const auto coded = [](std::uint64_t seed) {
    std::vector<std::vector<double>> points;
    for (const DesignRun& run : latin_hypercube(factors(3), 12, seed).runs) {
      points.push_back(run.coded);
    }
    return points;
  };
  EXPECT_EQ(coded(1), coded(1));
  EXPECT_NE(coded(1), coded(2));
  // Hard-coded: these must never change, on any machine.
  const auto first = coded(1).front();
  const double expected[] = {-3, 1, 11};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(first[i], expected[i] / 12, 1e-15);
}

TEST(LatinHypercube, ItsPointsKeepTheirDistance) {
  // 25 points in the square: at best a lattice's are .4 sqrt(2) apart; random hypercubes come
  // within .12 to .2 of each other.
  for (const std::uint64_t seed : {1, 2, 3}) {
    EXPECT_GT(closest_pair(latin_hypercube(factors(2), 25, seed)), .33);
  }
}

TEST(Sweep, IsTheHazelnutStudysNineLevels) {
  const Design design = sweep({{"e", .01, .41}}, 9);
  ASSERT_EQ(design.runs.size(), 9U);
  for (int k = 0; k < 9; ++k) {
    EXPECT_NEAR(design.factors[0].natural(design.runs[static_cast<std::size_t>(k)].coded[0]),
                .01 + .05 * k, 1e-15);
  }
}

TEST(Sweep, OtherFactorsStayInTheMiddle) {
  const Design design = sweep(factors(3), 5);
  ASSERT_EQ(design.runs.size(), 15U);
  for (const DesignRun& run : design.runs) {
    EXPECT_GE(std::count(run.coded.begin(), run.coded.end(), 0.0), 2);
  }
}

TEST(LineOfRuns, IsTheHazelnutStudysSteepestAscent) {
  const Design design = line_of_runs({"e", "mu_s", "mu_r"}, {.1, .1, .01}, {.1, .1, .01}, 5);
  ASSERT_EQ(design.runs.size(), 5U);
  for (std::size_t k = 0; k < 5; ++k) {
    const double steps = static_cast<double>(k) + 1;
    const auto& coded = design.runs[k].coded;
    EXPECT_NEAR(design.factors[0].natural(coded[0]), .1 * steps, 1e-15);
    EXPECT_NEAR(design.factors[2].natural(coded[2]), .01 * steps, 1e-15);
  }
}

TEST(LineOfRuns, GoesDownAndLeavesFactorsAlone) {
  const Design design = line_of_runs({"a", "b"}, {5, 7}, {-2, 0}, 3);
  EXPECT_DOUBLE_EQ(design.factors[0].natural(design.runs[2].coded[0]), 1);
  EXPECT_DOUBLE_EQ(design.factors[1].natural(design.runs[2].coded[1]), 7);
}

/// A plane through the corners of a square in natural levels.
Regression plane(double slope_a, double slope_b) {
  RunTable table;
  table.name = "plane";
  table.factors = {{"a", 0, 2}, {"b", 10, 30}};
  table.levels = {{0, 2, 0, 2, 1}, {10, 10, 30, 30, 20}};
  table.response_name = "y";
  for (std::size_t run = 0; run < 5; ++run) {
    table.responses.push_back(slope_a * (table.levels[0][run] - 1) +
                              slope_b * (table.levels[1][run] - 20) / 10 + (run == 4 ? .1 : 0));
  }
  return regress(table, SurfaceModel::linear);
}

TEST(SteepestAscent, GoesInProportionToTheSlopes) {
  const Design design = steepest_ascent(plane(4, -2), 3, .5, false);
  const auto level = [&](std::size_t run, std::size_t factor) {
    return design.factors[factor].natural(design.runs[run].coded[factor]);
  };
  EXPECT_NEAR(level(0, 0), 1, 1e-12);
  EXPECT_NEAR(level(0, 1), 20, 1e-12);
  EXPECT_NEAR(level(1, 0), 1.5, 1e-12);   // half of the half-range
  EXPECT_NEAR(level(1, 1), 17.5, 1e-12);  // half as steep, in the other direction
  EXPECT_NEAR(level(2, 0), 2, 1e-12);
  const Design down = steepest_ascent(plane(4, -2), 3, .5, true);
  EXPECT_NEAR(down.factors[0].natural(down.runs[1].coded[0]), .5, 1e-12);
}

TEST(SteepestAscent, RefusesWhatHasNoSlope) {
  EXPECT_THAT(error_of([] {
                steepest_ascent(regress(hazelnut_runs(), SurfaceModel::quadratic), 5, 0, false);
              }),
              AllOf(HasSubstr("linear model"), HasSubstr("stride = 0")));
}

TEST(RandomOrder, KeepsAllRunsAndFollowsTheSeed) {
  Design design = central_composite(factors(3));
  Design again = design, other = design;
  randomise_order(design, 4);
  randomise_order(again, 4);
  randomise_order(other, 5);
  std::vector<int> order, order_again, order_of_other;
  for (const DesignRun& run : design.runs) order.push_back(run.standard);
  for (const DesignRun& run : again.runs) order_again.push_back(run.standard);
  for (const DesignRun& run : other.runs) order_of_other.push_back(run.standard);
  EXPECT_EQ(order, order_again);
  EXPECT_NE(order, order_of_other);
  EXPECT_FALSE(std::is_sorted(order.begin(), order.end()));
  std::sort(order.begin(), order.end());
  for (int k = 0; k < 20; ++k) EXPECT_EQ(order[static_cast<std::size_t>(k)], k + 1);
}

TEST(Designs, LevelsWhoseDifferenceIsNoNumberAreRefused) {
  EXPECT_THAT(error_of([] {
                latin_hypercube({{"a", -1e308, 1e308}}, 4, 1);
              }),
              AllOf(HasSubstr("a = -1e+308:1e+308"), HasSubstr("Rule: at most 1e+100"),
                    HasSubstr("Fix: ")));
}

TEST(Designs, AllErrorsAreNamedAtOnce) {
  const std::string error = error_of([] {
    central_composite({{"a", 1, 1}, {"a", 0, std::numeric_limits<double>::quiet_NaN()}},
                      {.rule = {}, .alpha = -1, .centre_runs = -1});
  });
  EXPECT_THAT(error,
              AllOf(HasSubstr("a = 1:1"), HasSubstr("a: is named twice"), HasSubstr("a = 0:nan"),
                    HasSubstr("alpha = -1"), HasSubstr("centre runs = -1")));
}

TEST(Designs, TooFewAndTooManyFactorsAreRefused) {
  EXPECT_THAT(error_of([] { central_composite(factors(1)); }), HasSubstr("takes 2 to 6"));
  EXPECT_THAT(error_of([] { central_composite(factors(7)); }), HasSubstr("takes 2 to 6"));
  EXPECT_THAT(error_of([] { box_behnken(factors(2)); }), HasSubstr("takes 3 to 7"));
  EXPECT_THAT(error_of([] { box_behnken(factors(8)); }), HasSubstr("takes 3 to 7"));
  EXPECT_THAT(error_of([] { latin_hypercube(factors(2), 1, 1); }), HasSubstr("runs = 1"));
  EXPECT_THAT(error_of([] { sweep({}, 9); }), HasSubstr("0 factors"));
  EXPECT_THAT(error_of([] { sweep(factors(1), 1); }), HasSubstr("levels = 1"));
  EXPECT_THAT(error_of([] { line_of_runs({"a"}, {0}, {0}, 5); }), HasSubstr("all steps are 0"));
}

}  // namespace
}  // namespace repose::calibrate
