// What the runs of a table predict, and which to make next.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/input_error.h"
#include "calibrate/runs/next_runs.h"
#include "calibrate/runs/predicted_readings.h"
#include "calibrate/runs/table_fit.h"
#include "calibrate/statistics/table/table.h"
#include "tests/calibrate/made_up_table.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::ThrowsMessage;

class TableNext : public ::testing::Test {
 protected:
  TableStudy study(const std::string& text) const {
    return read_table_study(folder_.write("study.toml", text));
  }
  TableRuns runs(const TableStudy& of, const std::string& text) const {
    return read_table_runs(of, {folder_.write("runs.csv", text)});
  }
  KnownRuns known(const TableStudy& of, const std::string& text) const {
    const TableRuns table = runs(of, text);
    return {.problem = problem_of(of, table), .runs = table.runs};
  }

  testing::TemporaryFolder folder_;
};

using PredictedReadings = TableNext;
using NextRunsTest = TableNext;

TEST_F(PredictedReadings, IntervalsHoldFreshRunsAndTheTruth) {
  const KnownRuns of =
      known(study(test::made_up_study(test::kMeasuredDensity)), test::made_up_rows());
  constexpr std::size_t kPlaces = 200;
  std::vector<std::vector<double>> places;
  for (std::size_t k = 0; k < kPlaces; ++k) {
    const Point point = sequence_point(1000 + k, 3);
    places.push_back({.1 + .6 * point[0], .3 * point[1], .2 + .6 * point[2]});
  }
  const auto predicted = predicted_readings(of, places);
  Random random(77);
  int runs_held = 0, means_held = 0;
  for (std::size_t k = 0; k < kPlaces; ++k) {
    const ReadingAt& angle = predicted[k][0];
    ASSERT_EQ(angle.name, "angle");
    const double truth = test::angle_of(places[k][0], places[k][1]);
    const double run = truth + test::kAngleNoise * random.normal();
    runs_held += run >= angle.interval.low && run <= angle.interval.high ? 1 : 0;
    means_held += truth >= angle.mean_interval.low && truth <= angle.mean_interval.high ? 1 : 0;
    EXPECT_LT(angle.mean_interval.high - angle.mean_interval.low,
              angle.interval.high - angle.interval.low);
  }
  EXPECT_GE(runs_held, 180);
  EXPECT_GE(means_held, 180);
}

TEST_F(PredictedReadings, OfManyRunsAreHardlySurerThanChanceOfOne) {
  const KnownRuns of = known(study(test::made_up_study()), test::made_up_rows({.rows = 60}));
  const ReadingAt angle = predicted_readings(of, {{.4, .15, .5}}).front().front();
  const double half = (angle.interval.high - angle.interval.low) / 2;
  EXPECT_NEAR(half, 1.96 * test::kAngleNoise, .5 * test::kAngleNoise);
}

TEST_F(PredictedReadings, PlacesOutsideTheBoundsAreRefused) {
  const TableStudy of = study(test::made_up_study());
  const auto file = folder_.write(
      "points.csv", std::string("restitution,sliding,rolling,angle\n.5,.4,.1,20\n.5,.9,.1,30\n"));
  EXPECT_THAT([&] { places_in(file, of.parameters); },
              ThrowsMessage<base::InputError>(
                  AllOf(HasSubstr("points.csv:3: sliding is 0.9"), HasSubstr("0.1 and 0.7"))));
  const auto inside =
      folder_.write("points.csv", std::string("restitution;sliding;rolling\n0,5;0,4;0,1\n"));
  EXPECT_EQ(places_in(inside, of.parameters).front(), (std::vector{.4, .1, .5}));
  const auto with_units =
      folder_.write("points.csv", std::string("sliding [-],rolling (-),restitution\n.4,.1,.5\n"));
  EXPECT_EQ(places_in(with_units, of.parameters).front(), (std::vector{.4, .1, .5}));
}

TEST_F(NextRunsTest, BeginEvenlyOverTheBounds) {
  const TableStudy of = study(test::made_up_study());
  const NextRuns next = next_runs(of, {}, 12);
  ASSERT_EQ(next.runs.size(), 12U);
  std::vector<double> sliding;
  for (const NextRun& run : next.runs) {
    sliding.push_back(run.values[0]);
    EXPECT_THAT(run.reason, Not(IsEmpty()));
  }
  EXPECT_EQ(next.runs[5].values, next.runs[4].values) << "once more, to see what chance does";
  EXPECT_LT(std::ranges::min(sliding), .2);
  EXPECT_GT(std::ranges::max(sliding), .6);
  EXPECT_THAT(next.settled, IsEmpty());
  EXPECT_EQ(next_runs(of, {}, 12).runs[7].values, next.runs[7].values);
}

TEST_F(NextRunsTest, KeepAwayFromThoseThatThereAre) {
  const TableStudy of = study(test::made_up_study());
  const TableRuns few = runs(of, test::made_up_rows({.rows = 5}));
  const NextRuns next = next_runs(of, few, 6);
  ASSERT_EQ(next.runs.size(), 6U);
  for (const NextRun& run : next.runs) {
    for (const std::vector<double>& there : few.places) {
      const double off =
          std::hypot((run.values[0] - there[0]) / .6, (run.values[1] - there[1]) / .3,
                     (run.values[2] - there[2]) / .6);
      EXPECT_GT(off, .2);
    }
  }
}

TEST_F(NextRunsTest, GoWhereParametersFit) {
  const TableStudy of =
      study(std::string(test::kMadeUpParameters) +
            "[measured]\nangle = { mean = 20, sd = 0.2, n = 1, unit = \"deg\" }\n");
  const TableRuns there = runs(of, test::made_up_rows({.rows = 16}));
  const NextRuns next = next_runs(of, there, 8);
  ASSERT_EQ(next.runs.size(), 8U);
  const auto miss = [](const std::vector<double>& at) {
    return std::abs(test::angle_of(at[0], at[1]) - test::kMeasuredAngle);
  };
  double chosen = 0, evenly = 0;
  for (std::size_t k = 0; k < 7; ++k) chosen += miss(next.runs[k].values) / 7;  // one is elsewhere
  for (const std::vector<double>& at : test::made_up_places(70)) evenly += miss(at) / 70;
  EXPECT_LT(chosen, .65 * evenly);
  EXPECT_THAT(next.runs[7].reason, HasSubstr("far from all other runs"));
  EXPECT_THAT(next.runs.front().reason, HasSubstr("angle is known to ±"));
}

/// A program that fails if sliding exceeds .45, round by round.
TEST_F(NextRunsTest, KeepAwayFromWhereRunsFail) {
  const TableStudy of =
      study(std::string(test::kMadeUpParameters) +
            "[measured]\nangle = { mean = 20, sd = 0.2, n = 1, unit = \"deg\" }\n");
  std::string rows = "sliding,rolling,restitution,angle,status\n";
  int failed_later = 0;
  std::string left_out;
  for (int round = 0; round < 4; ++round) {
    TableRuns there;
    if (round > 0) there = runs(of, rows);
    const NextRuns next = next_runs(of, there, 12);
    if (round > 0) left_out = next.left_out;
    for (const NextRun& run : next.runs) {
      const bool fails = run.values[0] > .45;
      failed_later += fails && round > 0 ? 1 : 0;
      rows +=
          fmt::format("{},{},{},{},{}\n", run.values[0], run.values[1], run.values[2],
                      fails ? "" : fmt::format("{}", test::angle_of(run.values[0], run.values[1])),
                      fails ? "failed" : "ok");
    }
  }
  EXPECT_THAT(rows, HasSubstr("failed")) << "the start knows nothing";
  EXPECT_LE(failed_later, 8) << "of 36: they find the border";
  EXPECT_THAT(left_out, HasSubstr("of where the parameters may fit: more runs near there failed"));
}

TEST_F(NextRunsTest, OneFailureAmongOthersLeavesLittleOut) {
  const TableStudy of =
      study("[parameter]\nx = { min = 0, max = 1 }\n[measured]\ny = { mean = 3, sd = 1, n = 4 }\n");
  std::string rows = "x,y\n";
  for (int k = 0; k <= 8; ++k) rows += fmt::format("{},{}\n", k / 8., k == 4 ? "failed" : "3");
  const NextRuns next = next_runs(of, runs(of, "x,y\n0,1\n0.5,failed\n1,5\n"), 4);
  for (const NextRun& run : next.runs) EXPECT_GT(std::abs(run.values[0] - .5), .2);
  EXPECT_THAT(next.left_out, IsEmpty()) << "too few for a fit: nothing is known to fit";
  const NextRuns among = next_runs(of, runs(of, rows), 4);
  EXPECT_THAT(among.left_out, IsEmpty()) << "seven runs beside it did not fail";
}

/// The reading fits between 0.55 and 0.75, where every other run failed.
TEST_F(NextRunsTest, AreNotAllPutWhereSomeFail) {
  const TableStudy of = study(
      "[parameter]\nx = { min = 0, max = 1 }\n[measured]\ny = { mean = 6.5, sd = 0.6, n = 4 }\n");
  const auto risky = [](double x) { return x > .55 && x < .75; };
  const auto asked_there = [&](bool does_fail) {
    std::string rows = "x,y\n";
    for (int k = 0; k <= 20; ++k) {
      const double x = k / 20., y = 10 * x + 2 * (k % 3 - 1);
      rows += fmt::format("{},{}\n", x,
                          does_fail && risky(x) && k % 2 == 0 ? "failed" : fmt::format("{}", y));
    }
    const NextRuns next = next_runs(of, runs(of, rows), 7);
    EXPECT_THAT(next.runs, Not(IsEmpty()));
    return std::ranges::count_if(next.runs,
                                 [&](const NextRun& run) { return risky(run.values[0]); });
  };
  EXPECT_GE(asked_there(false), 5);
  EXPECT_LE(asked_there(true), 2);
}

TEST_F(NextRunsTest, WhereAllFitsFailNoneIsAskedFor) {
  const TableStudy of = study(
      "[parameter]\nx = { min = 0, max = 1 }\n[measured]\ny = { mean = 9, sd = 0.1, n = 9 }\n");
  std::string rows = "x,y\n";
  for (int k = 0; k <= 20; ++k) {
    rows += fmt::format("{},{}\n", k / 20.,
                        k > 14 ? std::string("failed") : fmt::format("{}", k / 2. + .3 * (k % 2)));
  }
  const NextRuns next = next_runs(of, runs(of, rows), 8);
  EXPECT_THAT(next.runs, IsEmpty());
  EXPECT_THAT(next.settled, ::testing::ElementsAre(HasSubstr("where parameters fit, runs fail")));
  EXPECT_THAT(next.left_out, HasSubstr("100 %"));
}

TEST_F(NextRunsTest, StopWhereFurtherOnesWouldNotNarrow) {
  const TableStudy of = study(std::string(test::kMadeUpParameters) +
                              "[measured]\nangle = { mean = 20, sd = 4, n = 1, unit = \"deg\" }\n");
  const NextRuns next = next_runs(of, runs(of, test::made_up_rows()), 6);
  EXPECT_THAT(next.runs, IsEmpty());
  ASSERT_THAT(next.settled, Not(IsEmpty()));
  EXPECT_THAT(next.settled.front(), HasSubstr("No further run would narrow"));
  EXPECT_THAT(next.settled, Contains(HasSubstr("add density, a column of the table")));
}

TEST_F(NextRunsTest, MakeATableToBeFilledInAndRead) {
  const TableStudy of = study(test::made_up_study());
  const NextRuns next = next_runs(of, {}, 8);
  const std::string text = csv_text(next_runs_table(of, {}, next.runs));
  EXPECT_THAT(text, HasSubstr("sliding,rolling,restitution,angle,reason\n"));
  const TableRuns empty = runs(of, text);
  EXPECT_EQ(empty.without_reading, 8);
  EXPECT_EQ(empty.failed, 0) << "nobody said that they failed";
  EXPECT_EQ(empty.places[0], next.runs[0].values);
  // With the columns of the table it will be added to.
  const TableRuns there = runs(of, test::made_up_rows({.rows = 4}));
  EXPECT_THAT(csv_text(next_runs_table(of, there, next.runs)),
              HasSubstr("sliding,rolling,restitution,angle,angle_sd,density,n,reason\n"));
}

/// Rows that can be appended to the table unchanged.
TEST_F(NextRunsTest, AreWrittenAsTheTableIs) {
  const TableStudy of =
      study("[parameter]\nx = { min = 0, max = 1 }\n[measured]\ny = { mean = 3, sd = 1, n = 4 }\n");
  const std::string table = "x;y;reason\n0,25;3,5;\n0,75;2,5;\n";
  const TableRuns there = runs(of, table);
  const NextRuns next = next_runs(of, there, 3);
  ASSERT_EQ(next.runs.size(), 3U);
  const std::string text = csv_text(next_runs_table(of, there, next.runs));
  EXPECT_THAT(text, HasSubstr("x;y;reason\n0,"));
  const TableRuns together = runs(of, table + text.substr(text.find('\n') + 1));
  ASSERT_EQ(together.places.size(), 5U);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(together.places[k + 2], next.runs[k].values);
}

}  // namespace
}  // namespace repose::calibrate
