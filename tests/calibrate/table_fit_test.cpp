// Studies of a table of runs: reading both, and the fit.
#include "calibrate/runs/table_fit.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/fit/surrogate.h"
#include "calibrate/report/study_report.h"
#include "calibrate/runs/table_runs.h"
#include "calibrate/runs/table_study.h"
#include "calibrate/study/study_record.h"
#include "dem/study/study.h"
#include "tests/calibrate/made_up_table.h"
#include "tests/support/drawn_scan.h"
#include "tests/support/heap_picture.h"
#include "tests/support/particle_files.h"
#include "tests/support/temporary_folder.h"
#include "vision/picture/picture.h"

namespace repose::calibrate {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::ThrowsMessage;

class TableTest : public ::testing::Test {
 protected:
  TableStudy study(const std::string& text) const {
    return read_table_study(folder_.write("study.toml", text));
  }
  TableRuns runs(const TableStudy& of, const std::string& text) const {
    return read_table_runs(of, {folder_.write("runs.csv", text)});
  }
  std::string fault_of_study(const std::string& text) const {
    try {
      study(text);
    } catch (const base::InputError& error) {
      return error.what();
    }
    return {};
  }
  std::string fault_of_runs(const TableStudy& of, const std::string& text) const {
    try {
      runs(of, text);
    } catch (const base::InputError& error) {
      return error.what();
    }
    return {};
  }

  testing::TemporaryFolder folder_;
};

using TableStudyTest = TableTest;
using TableRunsTest = TableTest;
using TableFitTest = TableTest;

/// Only x and y, for tables written out in full.
constexpr const char* kLineStudy =
    "[parameter]\nx = { min = 0, max = 1 }\n[measured]\ny = { mean = 3, sd = 1, n = 4 }\n";

TEST_F(TableStudyTest, TakesAnyNamesInTheirOrder) {
  const TableStudy read = study(
      "[study]\ntitle = \"Ours\"\n"
      "[parameter]\n"
      "surface_energy = { min = 0, max = 2, mean = 1, sd = 0.5, useful_half_width = 0.1 }\n"
      "\"roll friction\" = { min = -1, max = 1, bounds = \"known\" }\n"
      "[measured]\n"
      "torque = { values = [1.0, 1.2, 0.8], tolerance = 0.1, bias_sd = 0.05 }\n"
      "aor = { mean = 27, sd = 1.5, n = 1, unit = \"deg\", held_out = true }\n");
  EXPECT_EQ(read.heading.title, "Ours");
  ASSERT_EQ(read.parameters.size(), 2U);
  EXPECT_EQ(read.parameters[0].name, "surface_energy");
  EXPECT_EQ(read.parameters[0].prior->sd, .5);
  EXPECT_EQ(read.parameters[0].useful_half_width, .1);
  EXPECT_EQ(read.parameters[1].name, "roll friction");
  EXPECT_EQ(read.parameters[1].bounds_are, BoundsOrigin::known);
  ASSERT_EQ(read.measured.size(), 1U);
  EXPECT_EQ(read.measured[0].n, 3);
  EXPECT_NEAR(*read.measured[0].sd, .2, 1e-12);
  EXPECT_EQ(read.measured[0].systematic_sd, .05);
  ASSERT_EQ(read.held_out.size(), 1U);
  EXPECT_THAT(readings_of(read), ElementsAre("torque", "aor"));
}

TEST_F(TableStudyTest, OneReadingIsAsUncertainAsItsSdSays) {
  const TableStudy read = study(test::made_up_study());
  EXPECT_EQ(standard_uncertainty(read.measured[0]), 1);
  EXPECT_TRUE(std::isinf(degrees_of_scatter(read.measured[0])));
  EXPECT_THAT(errors_of(problem_of(read, {})), IsEmpty());
  EXPECT_TRUE(problem_of(read, {}).settings.are_runs_given);
}

TEST_F(TableStudyTest, ReadsASheetOfNumbers) {
  folder_.write("y.csv", std::string("y;who\n2,9;A\n3,1;B\n3,0;A\n"));
  const TableStudy read =
      study("[parameter]\nx = { min = 0, max = 1 }\n[measured]\ny = { readings = \"y.csv\" }\n");
  EXPECT_EQ(read.measured[0].n, 3);
  EXPECT_NEAR(read.measured[0].mean, 3, 1e-12);
}

/// Positions and pictures instead of an angle: measured, each with its own uncertainty.
TEST_F(TableRunsTest, PicturesAndParticlesAreMeasured) {
  constexpr double kHeight_m = .024, kRadius_m = .002;
  for (const int angle : {20, 28}) {
    folder_.write(fmt::format("heap_{}.dump", angle),
                  testing::dump_step(1, testing::packed_cone(angle, kHeight_m, kRadius_m)));
  }
  testing::HeapScene scene;
  scene.width = 600;
  scene.height = 400;
  scene.form.left_rad = scene.form.right_rad = 24 * kDegree;
  vision::write_picture(folder_.path() / "heap.png", testing::draw_heap(scene).picture);
  folder_.write("heap.ply",
                testing::ply_of(testing::drawn_scan({.surface = testing::cone_surface(26, 80)})));
  vision::Picture blank{.width = 300, .height = 200, .bgr = {}};
  blank.bgr.assign(std::size_t{3} * 300 * 200, 255);
  vision::write_picture(folder_.path() / "blank.png", blank);
  const TableStudy read = study(
      "[parameter]\nx = { min = 0, max = 1 }\n[measured]\n"
      "aor = { mean = 24, sd = 1, n = 4, unit = \"deg\" }\n");
  const TableRuns found =
      runs(read,
           "x,aor,aor_sd,n\n0.1,heap_20.dump,,3\n0.5,heap.png,,\n"
           "0.9,heap_28.dump,,\n0.7,blank.png,,\n0.8,heap.ply,,\n0.3,21.5,0.4,3\n");
  ASSERT_EQ(found.runs.size(), 5U);
  EXPECT_EQ(found.without_reading, 1);
  const std::vector<double> expected = {20, 24, 28, 26};
  for (std::size_t k = 0; k < expected.size(); ++k) {
    EXPECT_NEAR(found.runs[k].readings.at("value"), expected[k], 1.5) << k;
    EXPECT_GT(found.runs[k].reading_sd.at("value"), .05) << k;
    EXPECT_LT(found.runs[k].reading_sd.at("value"), 2) << k;
    EXPECT_EQ(found.runs[k].repeats, 1) << k;
  }
  EXPECT_THAT(found.runs[4].reading_sd, IsEmpty());
  EXPECT_EQ(found.runs[4].repeats, 3);
  EXPECT_THAT(found.notes, Contains(AllOf(HasSubstr("4 of 5 pictures"), HasSubstr("flank_20_80"))));
  EXPECT_THAT(found.notes,
              Contains(HasSubstr("refused, and without a reading: line 5, blank.png")));
  EXPECT_THAT(found.notes, Contains(HasSubstr("definition")));
  EXPECT_EQ(found.texts.size(), 6U);  // the table, and a fingerprint of each file
}

TEST_F(TableRunsTest, PicturesThatCannotBeReadAreFaults) {
  const std::string line = "[parameter]\nx = { min = 0, max = 1 }\n[measured]\n";
  const TableStudy angle = study(line + "y = { mean = 3, sd = 1, n = 4, unit = \"deg\" }\n");
  EXPECT_THAT(fault_of_runs(angle, "x,y\n0.1,12\n0.2,missing.png\n0.3,lost.dump\n"),
              AllOf(HasSubstr("runs.csv:3"), HasSubstr("missing.png"), HasSubstr("runs.csv:4"),
                    HasSubstr("lost.dump")));
  const TableStudy other = study(kLineStudy);
  EXPECT_THAT(fault_of_runs(other, "x,y\n0.1,12\n0.2,heap.png\n"),
              AllOf(HasSubstr("runs.csv:3"), HasSubstr("unit = \"deg\"")));
  EXPECT_THAT(fault_of_study(line + "y = { mean = 3, sd = 1, n = 4, unit = \"deg\", up = \"w\", "
                                    "definition = \"flank\" }\n"),
              AllOf(HasSubstr("one of x, y, z"), HasSubstr("definition is one of")));
}

TEST_F(TableStudyTest, IsNotMixedWithOneThatIsSimulated) {
  const std::string text = std::string(kLineStudy) + "[particle]\nsize_mm = [5, 5, 5]\n";
  EXPECT_THAT(fault_of_study(text),
              AllOf(HasSubstr("study.toml:5:1"), HasSubstr("[particle] stands beside [parameter]"),
                    HasSubstr("Fix: ")));
  EXPECT_THAT([&] { dem::read_study(folder_.path() / "study.toml"); },
              ThrowsMessage<base::InputError>(
                  AllOf(HasSubstr("[parameter] stands beside [particle]"), HasSubstr("Fix: "))));
  folder_.write("study.toml", std::string(kLineStudy));
  EXPECT_THAT([&] { dem::read_study(folder_.path() / "study.toml"); },
              ThrowsMessage<base::InputError>(HasSubstr("--runs runs.csv")));
  EXPECT_TRUE(is_table_study(folder_.path() / "study.toml"));
}

TEST_F(TableStudyTest, SaysEveryFaultWithItsFix) {
  const std::string faults = fault_of_study(
      "[parameter]\nx = { min = 1, max = 0 }\nz = 3\n"
      "[measured]\na = { mean = 3 }\nb = { values = [1] }\nx = { mean = 1, sd = 1, n = 1 }\n"
      "c = { pictures = [\"heaps\"] }\nd = { mean = 1, sd = 1, n = 2, drift = 3 }\n");
  for (const char* part :
       {"min below max", "z = 3", "measured.a has a mean and no sd", "measured.b has one value",
        "x is in [parameter] and in [measured]", "repose measure", "there is no such key"}) {
    EXPECT_THAT(faults, HasSubstr(part));
  }
  EXPECT_THAT(fault_of_study("[measured]\ny = { mean = 1, sd = 1, n = 1 }\n"),
              HasSubstr("has no [parameter]"));
  EXPECT_THAT(fault_of_study("[parameter]\nx = { min = 0, max = 1 }\n"),
              HasSubstr("section [measured] is missing"));
}

TEST_F(TableRunsTest, ReadsRepeatsSeedsStatusAndComments) {
  const TableRuns read = runs(study(kLineStudy),
                              "x,y,y_std,n_ok,seed,status,Comment\n"
                              "0.1,2.0,0.4,2,7,ok,first\n"
                              "0.2,2.5,,1,8,done,\n"
                              "0.3,3.0,0.3,3,9,failed,licence gone\n"
                              "0.4,NaN,,1,10,ok,\n"
                              "0.5,,,,,,to be done\n");
  ASSERT_EQ(read.runs.size(), 2U) << "why runs failed nobody knows; the last row says nothing";
  EXPECT_EQ(read.runs[0].repeats, 2);
  EXPECT_EQ(read.runs[0].repeat_sd.at("value"), .4);
  EXPECT_EQ(read.runs[0].job.seed, 7U);
  EXPECT_THAT(read.runs[1].repeat_sd, IsEmpty());
  EXPECT_EQ(read.rows, 5);
  EXPECT_EQ(read.failed, 2);
  EXPECT_EQ(read.without_reading, 1);
  EXPECT_THAT(read.notes, AllOf(Contains(HasSubstr("not used: Comment")),
                                Contains(HasSubstr("Failed runs: 2 of 5 rows (the first: status is "
                                                   "failed)")),
                                Contains(HasSubstr("No reading: 1 of 5 rows"))));
}

TEST_F(TableRunsTest, TakesAColumnOfNumbersAloneForNothing) {
  // Particles, or seeds: without a standard deviation nothing indicates that rows are means.
  const TableRuns read = runs(study(kLineStudy), "x,y,n\n0.1,2,50000\n0.2,2.5,50000\n");
  EXPECT_EQ(read.runs[0].repeats, 1);
  EXPECT_THAT(read.notes, Contains(HasSubstr("not used: n")));
}

TEST_F(TableRunsTest, RefusesAnglesThatAreNone) {
  const TableStudy angle = study(
      "[parameter]\nx = { min = 0, max = 1 }\n"
      "[measured]\ny = { mean = 27, sd = 1, n = 4, unit = \"deg\" }\n");
  EXPECT_THAT(fault_of_runs(angle, "x,y\n0.1,25\n0.2,9999\n0.3,-5\n"),
              AllOf(HasSubstr(":3: y is 9999"), HasSubstr(":4: y is -5"), HasSubstr("Fix: ")));
}

TEST_F(TableRunsTest, ReadsSemicolonsDecimalCommasAndUnits) {
  const TableRuns read = runs(study(kLineStudy), "x;y\n[-];[mm]\n0,25;1234,5\n0,5;2,75\n");
  ASSERT_EQ(read.runs.size(), 2U);
  EXPECT_EQ(read.runs[0].job.values, std::vector{.25});
  EXPECT_EQ(read.runs[0].readings.at("value"), 1234.5);
}

TEST_F(TableRunsTest, RefusesWhatIsNoTableOfTheseRuns) {
  const TableStudy line = study(kLineStudy);
  EXPECT_THAT(fault_of_runs(line, ""), HasSubstr("is empty"));
  EXPECT_THAT(fault_of_runs(line, "x,y\n"), HasSubstr("no rows"));
  EXPECT_THAT(fault_of_runs(line, "X,aor\n1,2\n"),
              AllOf(HasSubstr("has no column x, which is in [parameter]. Did you mean X?"),
                    HasSubstr("has no column y, which is in [measured]")));
  EXPECT_THAT(
      fault_of_runs(line, "x,y,n\n0.1,2,1\nabc,3,1\n0.3,27.3 deg,1\n0.4,1e12,1\n0.5,3,1.5\n"),
      AllOf(HasSubstr("runs.csv:3: x is \"abc\""), HasSubstr("runs.csv:4: y")));
  EXPECT_THAT(fault_of_runs(line, "x,y,y_sd,n,seed\n0.4,1e12,,1,1\n0.5,3,0.1,1.5,-1\n"),
              AllOf(HasSubstr("runs.csv:2: y is 1e+12"), HasSubstr("runs.csv:3: n is 1.5"),
                    HasSubstr("seed is -1")));
}

TEST_F(TableRunsTest, LeavesOutRowsBeyondTheBoundsAndSaysSo) {
  const TableRuns read = runs(study(kLineStudy), "x,y\n0.5,1\n1.5,2\n-0.1,3\n");
  EXPECT_EQ(read.rows, 1);
  EXPECT_EQ(read.left_out, 2);
  EXPECT_THAT(read.notes, Contains(AllOf(HasSubstr("2 of 3 rows are outside the bounds"),
                                         HasSubstr("line 3: x is 1.5"), HasSubstr("widen"))));
}

TEST_F(TableRunsTest, PointsOutRunsOfOtherModels) {
  const TableStudy line = study(kLineStudy);
  const std::string rows = "0.1,2,1e6\n0.2,3.5,1e6\n0.3,4,";
  EXPECT_THAT(runs(line, "x,y,stiffness\n" + rows + "1e7\n").notes,
              Contains(AllOf(HasSubstr("stiffness differs between rows (1e6, 1e7)"),
                             HasSubstr("Fix: make it a parameter"))));
  EXPECT_THAT(runs(line, "x,y,stiffness\n" + rows + "1e6\n").notes, IsEmpty());
}

TEST_F(TableRunsTest, TellsRepeatsFromCopies) {
  const TableStudy line = study(kLineStudy);
  const TableRuns by_chance = runs(line, "x,y\n0.1,1\n0.1,1.2\n0.1,1\n0.5,3\n0.5,3\n");
  EXPECT_EQ(by_chance.rows, 3) << "where others differ, the same digits are a copy";
  EXPECT_EQ(by_chance.left_out, 2);
  EXPECT_THAT(by_chance.notes, Contains(HasSubstr("runs with other seeds differ: 2 rows")));
  const TableRuns exact = runs(line, "x,y\n0.1,1\n0.1,1\n0.5,3\n0.5,3\n");
  EXPECT_EQ(exact.rows, 4) << "a program without chance gives the same again";
  EXPECT_THAT(exact.notes, Contains(HasSubstr("If they are copies, delete them")));
  const TableRuns pasted = runs(line, "x,y,y_sd,n\n0.1,1,0.1,2\n0.1,1,0.1,2\n0.5,3,0.2,2\n");
  EXPECT_EQ(pasted.rows, 2) << "the runs that rows are means of differ";
  const Problem problem = problem_of(line, exact);
  EXPECT_FALSE(has_chance(problem.experiments[0], in_order(problem, exact.runs)));
  const TableRuns zero = runs(line, "x,y,y_sd,n\n0.1,1,0,3\n0.5,3,0,3\n");
  EXPECT_FALSE(has_chance(problem.experiments[0], in_order(problem, zero.runs)));
  const TableRuns means = runs(line, "x,y,y_sd,n\n0.1,1,0,3\n0.5,3,0.2,3\n");
  EXPECT_TRUE(has_chance(problem.experiments[0], in_order(problem, means.runs)));
}

TEST_F(TableRunsTest, RowsThatTellOfOtherRowsAreFaults) {
  const TableStudy line = study(kLineStudy);
  const std::string rows = "run,x,y\na,0.11,2.13\nb,0.32,2.71\nc,0.57,2.94\nd,0.83,3.78\n";
  EXPECT_THAT(fault_of_runs(line, rows + ",0.4575,2.89\n"),
              AllOf(HasSubstr("runs.csv:6: this last row looks like mean"), HasSubstr("not runs"),
                    HasSubstr("Fix: delete it")));
  EXPECT_THAT(fault_of_runs(line, rows + "e,0.4575,2.8900\n"), HasSubstr("runs.csv:6: this last"));
  // The spreadsheet's mean includes one reading more than the table.
  EXPECT_THAT(fault_of_runs(line, rows + ",0.4575,2.95\n"), HasSubstr("runs.csv:6: this last"));
  EXPECT_THAT(fault_of_runs(line, rows + ",0.4575,2.89\n,0.3115,0.684\n"),
              HasSubstr("runs.csv:6: lines 6 to 7 look like mean"));
  EXPECT_EQ(runs(line, rows + "e,0.4575,2.95\n").rows, 5) << "a run in the middle";
  EXPECT_EQ(runs(line, rows + "e,0.4000,2.89\n").rows, 5);
}

TEST_F(TableRunsTest, AColumnThatNumbersTheRowsNeedsNoName) {
  const TableStudy line = study(kLineStudy);
  const TableRuns read = runs(line, ",x,y\n0,0.1,2\n7,0.2,2.5\n3,0.3,2.7\n");
  EXPECT_EQ(read.rows, 3);
  EXPECT_THAT(read.notes, Contains(HasSubstr("the first column has no name")));
  EXPECT_THAT(fault_of_runs(line, ",x,y\n0.5,0.1,2\n7,0.2,2.5\n"),
              HasSubstr("runs.csv:1: column 1 has no name"));
  EXPECT_THAT(fault_of_runs(line, "x,,y\n0.1,1,2\n0.2,2,2.5\n"),
              HasSubstr("runs.csv:1: column 2 has no name"));
}

TEST_F(TableRunsTest, UnitsBehindNamesAreNoPartOfThem) {
  const TableStudy angle = study(
      "[parameter]\n\"sliding friction\" = { min = 0, max = 1 }\n"
      "[measured]\ny = { mean = 27, sd = 1, n = 4, unit = \"deg\" }\n");
  const TableRuns read = runs(angle, "\"sliding friction [-]\",y (deg)\n0.1,25\n0.2,26\n");
  EXPECT_EQ(read.runs.size(), 2U);
  EXPECT_THAT(read.notes,
              Contains(HasSubstr("\"sliding friction [-]\" is taken for sliding friction")));
  EXPECT_THAT(fault_of_runs(angle, "sliding friction [-],y [rad]\n0.1,0.4\n0.2,0.5\n"),
              AllOf(HasSubstr("\"y [rad]\" is in another unit than y"), HasSubstr("in deg")));
  EXPECT_THAT(fault_of_runs(angle, "sliding friction [-],y [deg],y [rad]\n0.1,24,0.4\n"),
              HasSubstr("has no column y"))
      << "it may be either";
}

TEST_F(TableFitTest, OneAngleLeavesARidge) {
  const TableStudy of = study(test::made_up_study());
  const StudyResult result = fit_table(of, runs(of, test::made_up_rows()));
  const auto& joint = std::get<JointResult>(result.found);
  ASSERT_EQ(joint.parameters.size(), 3U);
  EXPECT_EQ(joint.parameters[2].name, "restitution");
  EXPECT_EQ(joint.parameters[2].verdict, Verdict::undetermined);
  EXPECT_NE(joint.parameters[0].verdict, Verdict::determined);
  EXPECT_LT(joint.correlation[0][1], -.6) << "more of one is made up for by less of the other";
  EXPECT_THAT(joint.equivalence_family, Not(IsEmpty()));
  std::vector<double> misses;
  for (const EquivalentSet& set : joint.equivalence_family) {
    misses.push_back(std::abs(test::angle_of(set.values[0], set.values[1]) - test::kMeasuredAngle));
  }
  std::ranges::sort(misses);
  EXPECT_LT(misses[misses.size() / 2], 2) << "the bench's sd is 1";
  EXPECT_LT(misses.back(), 5) << "in a corner of the bounds the surface is known less well";
  EXPECT_FALSE(joint.verdict) << "nothing was simulated";
  EXPECT_FALSE(joint.observables[0].verification);
  EXPECT_THAT(joint.agreement.text, HasSubstr("surfaces through the table's runs"));
  EXPECT_THAT(joint.parameters[1].advice, HasSubstr("density, a column of the table"))
      << "which would tell them apart";
  EXPECT_FALSE(joint.parameters[0].narrowing->hour);
}

TEST_F(TableFitTest, ASecondReadingNarrowsWhatItDependsOn) {
  const TableStudy one = study(test::made_up_study());
  const TableStudy both = study(test::made_up_study(test::kMeasuredDensity));
  const std::string rows = test::made_up_rows();
  const auto width = [](const StudyResult& result, std::size_t parameter) {
    const Interval& interval = std::get<JointResult>(result.found).parameters[parameter].interval;
    return interval.high - interval.low;
  };
  const StudyResult with_one = fit_table(one, runs(one, rows));
  const StudyResult with_both = fit_table(both, runs(both, rows));
  EXPECT_LT(width(with_both, 0), .7 * width(with_one, 0));
  EXPECT_GT(width(with_both, 2), .9 * width(with_one, 2)) << "restitution has no part in either";
  const Interval& sliding = std::get<JointResult>(with_both.found).parameters[0].interval;
  EXPECT_LT(sliding.low, .4);
  EXPECT_GT(sliding.high, .4);
}

TEST_F(TableFitTest, WhatIsHeldOutIsPredictedByItsSurface) {
  const TableStudy of =
      study(test::made_up_study("density = { mean = 806.8, sd = 2, n = 4, held_out = true }\n"));
  const StudyResult result = fit_table(of, runs(of, test::made_up_rows()));
  const auto& joint = std::get<JointResult>(result.found);
  ASSERT_EQ(joint.held_out.size(), 1U);
  const Prediction& density = joint.held_out[0];
  EXPECT_LT(density.interval.low, 806.8);
  EXPECT_GT(density.interval.high, 806.8);
  EXPECT_GT(density.coefficients_sd, 5) << "the ridge leaves much open";
  ASSERT_TRUE(density.possible);
  EXPECT_NEAR(density.possible->low, test::density_of(.7, .3), 6);
}

TEST_F(TableFitTest, NeedsEnoughPlaces) {
  const TableStudy line = study(kLineStudy);
  const auto fault = [&](const std::string& rows) {
    try {
      fit_table(line, runs(line, rows));
    } catch (const base::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(fault("x,y\n0.5,3\n"),
              AllOf(HasSubstr("readings at 1 different places"), HasSubstr("repose ask")));
  EXPECT_THAT(fault("x,y\n0.1,NaN\n0.3,failed\n0.5,NaN\n0.7,NaN\n0.9,NaN\n"),
              HasSubstr("readings at 0 different places, of 5 rows"));
}

/// y = 2 + 2 x + .1 z, plus a little noise.
std::string line_rows(double from, double to) {
  std::string rows = "x,z,y\n";
  for (int k = 0; k < 14; ++k) {
    const double x = from + (to - from) * k / 13, z = k * 5 % 14 / 13.;
    rows += fmt::format("{:.4f},{:.4f},{:.4f}\n", x, z, 2 + 2 * x + .1 * z + .01 * (k % 3));
  }
  return rows;
}

std::string line_study(double mean) {
  return fmt::format(
      "[parameter]\nx = {{ min = 0, max = 1 }}\nz = {{ min = 0, max = 1 }}\n"
      "[measured]\ny = {{ mean = {}, sd = 0.1, n = 4 }}\n",
      mean);
}

TEST_F(TableFitTest, GivesNoIntervalsWhereNoParametersGiveTheReading) {
  const TableStudy of = study(line_study(9));
  const auto joint = std::get<JointResult>(fit_table(of, runs(of, line_rows(0, 1))).found);
  EXPECT_THAT(joint.agreement.text, HasSubstr("no parameters within the bounds give"));
  for (const ResultParameter& parameter : joint.parameters) {
    EXPECT_EQ(parameter.verdict, Verdict::undetermined);
    EXPECT_EQ(parameter.interval.low, parameter.bounds.low);
    EXPECT_EQ(parameter.interval.high, parameter.bounds.high);
  }
  EXPECT_THAT(joint.equivalence_family, IsEmpty());
}

TEST_F(TableFitTest, SaysWhereThereAreNoRows) {
  const TableStudy of = study(line_study(3));
  const auto warnings = [&](double from, double to) {
    return std::get<JointResult>(fit_table(of, runs(of, line_rows(from, to))).found).warnings;
  };
  EXPECT_THAT(warnings(.3, .7), Contains(HasSubstr("x: the rows are from 0.3 to 0.7")));
  EXPECT_THAT(warnings(.05, .95), Not(Contains(HasSubstr("extrapolated"))));
  // If all runs there failed, there are no readings either.
  const TableRuns with_failed = runs(of, line_rows(.3, .7) + "0.02,0.5,failed\n0.98,0.5,failed\n");
  EXPECT_THAT(std::get<JointResult>(fit_table(of, with_failed).found).warnings,
              Contains(HasSubstr("x: the rows are from 0.3 to 0.7")));
}

TEST_F(TableFitTest, ResultComesBackFromItsTextWithoutAModel) {
  const TableStudy of = study(test::made_up_study());
  const StudyResult result = fit_table(of, runs(of, test::made_up_rows()));
  const StudyResult read = result_from_json(to_json(result), "result.json");
  EXPECT_TRUE(read == result);
  EXPECT_FALSE(read.provenance.model);
  ASSERT_TRUE(read.provenance.table);
  EXPECT_EQ(read.provenance.table->rows, 30);
  EXPECT_EQ(std::get<JointResult>(read.found).runs[0].repeats, 2);
}

TEST_F(TableFitTest, FolderHasResultAndReport) {
  const std::atomic<bool> never = false;
  const TableRequest request{
      .study = folder_.write("study.toml", "[study]\ntitle = \"Made-up grains\"\n" +
                                               test::made_up_study(test::kMeasuredDensity)),
      .runs = {folder_.write("runs.csv", test::made_up_rows())},
      .folder = folder_.path() / "out"};
  std::vector<std::string> notes;
  const auto result = calibrate_table(
      request, [&](const std::string& note) { notes.push_back(note); }, never);
  ASSERT_TRUE(result);
  EXPECT_TRUE(read_result(request.folder).value() == *result);
  const std::string page = report::study_report(request.folder).html;
  EXPECT_THAT(page, AllOf(HasSubstr("Made-up grains"), HasSubstr("Not checked in simulations"),
                          HasSubstr("restitution"), Not(HasSubstr("Hertz"))));
  EXPECT_THAT([&] { read_study_record(request.folder); },
              ThrowsMessage<base::InputError>(HasSubstr("made with another program")));
}

}  // namespace
}  // namespace repose::calibrate
