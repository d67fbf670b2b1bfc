// What runs of a table predict, and which to make next.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/input_error.h"
#include "calibrate/runs/predicted_readings.h"
#include "calibrate/runs/table_fit.h"
#include "calibrate/statistics/table/table.h"
#include "tests/calibrate/made_up_table.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
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
}

}  // namespace
}  // namespace repose::calibrate
