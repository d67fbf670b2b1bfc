#include <algorithm>
#include <string>

#include <gmock/gmock.h>

#include "calibrate/bench/bench_readings.h"
#include "calibrate/statistics/bench/sheet.h"
#include "calibrate/study/impossible_readings.h"
#include "calibrate/study/study_problem.h"
#include "dem/experiment/experiment_table.h"
#include "dem/study/grain_source.h"
#include "tests/calibrate/sphere_study.h"
#include "tests/support/error_of.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/texts_of.h"

namespace repose::calibrate {
namespace {

using repose::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

const std::string kContacts = R"([contact]
particle_wall = { restitution = 0.5, sliding_friction = 0.4, rolling_friction = 0.05 }
particle_particle = { restitution = 0.5, sliding_friction = 0.4, rolling_friction = 0.05 }
)";

class BenchSheets : public ::testing::Test {
 protected:
  dem::Study study(const std::string& experiments) const {
    return dem::read_study(folder_.write("study.toml", test::kSoftBall + kContacts + experiments));
  }
  std::vector<SheetReadings> sheets(const std::string& experiments) const {
    return read_sheets(study(experiments), NoRows::refused);
  }
  std::string errors(const std::string& experiments) const {
    return error_of([&] { sheets(experiments); });
  }
  void write(const std::string& name, const std::string& text) const { folder_.write(name, text); }

  TemporaryFolder folder_;
};

TEST(BenchSheetColumns, AreThoseOfABenchTestForEachExperiment) {
  for (const dem::ExperimentEntry& entry : dem::all_experiments()) {
    const std::vector<std::string> columns = column_names(bench_test_named(entry.sheet.test));
    EXPECT_THAT(columns, Contains(entry.sheet.value)) << entry.name;
    EXPECT_EQ(columns.size(), 1 + entry.sheet.protocol.size()) << entry.name;
    dem::Protocol protocol = entry.usual;
    const std::vector<dem::ProtocolKey> keys = entry.keys(protocol);
    for (const auto& [column, key] : entry.sheet.protocol) {
      EXPECT_THAT(columns, Contains(column));
      EXPECT_TRUE(std::any_of(keys.begin(), keys.end(), [&](const dem::ProtocolKey& one) {
        return one.name == key;
      })) << key;
    }
  }
}

TEST_F(BenchSheets, GiveEachExperimentItsOwnNumber) {
  write("drops.csv", "drop_mm,rebound_mm\n250,9.5\n250.5,9\n");
  write("tilts.csv", "angle_deg,note\n22.7,first\n23.1,\n");
  write("rolls.csv", "incline_deg;released_mm;stopped_mm\n20;150;322,5\n20;150;318\n");
  write("heaps.csv", "angle_deg\n23.5\n");
  const std::vector<SheetReadings> read = sheets(R"([experiment.drop]
height_mm = 250
measured = { readings = "drops.csv" }
[experiment.tilt]
measured = { readings = "tilts.csv" }
[experiment.roll]
measured = { readings = "rolls.csv" }
[experiment.heap]
measured = { readings = "heaps.csv" }
)");
  ASSERT_EQ(read.size(), 4U);
  EXPECT_EQ(read[0].experiment, "drop");
  EXPECT_EQ(read[0].file, folder_.path() / "drops.csv");
  EXPECT_THAT(read[0].values, ElementsAre(9.5, 9));
  EXPECT_THAT(read[1].values, ElementsAre(22.7, 23.1));
  EXPECT_THAT(read[2].values, ElementsAre(322.5, 318)) << "decimal commas";
  EXPECT_THAT(read[3].values, ElementsAre(23.5));
}

TEST_F(BenchSheets, RowsThatAreNoReadingsAreLeftOutAndSaid) {
  write("drops.csv",
        "sample;drop_mm;rebound_mm\n1;500;125\n2;500;131\n3;500;120\nMean;500;125,3\n;;\n");
  const auto read = sheets("[experiment.drop]\nmeasured = { readings = \"drops.csv\" }\n");
  EXPECT_THAT(read.at(0).values, ElementsAre(125, 131, 120));
  ASSERT_THAT(read.at(0).notes, SizeIs(1));
  EXPECT_THAT(read.at(0).notes[0], HasSubstr("drops.csv: line 5 is left out (labelled \"Mean\")"));
  write("drops.csv", "drop_mm,rebound_mm\n500,125\n500,131\n500,120\n500,125.33\n");
  EXPECT_THAT(errors("[experiment.drop]\nmeasured = { readings = \"drops.csv\" }\n"),
              HasSubstr("drops.csv:5: this last row looks like mean"));
}

TEST_F(BenchSheets, ImpossibleReadingsAreToldByTheStudysGrain) {
  const auto said = [&](const std::string& experiment) {
    const dem::Study read = study(experiment);
    const std::vector<std::string> all =
        texts_of(impossible_readings(read, dem::build_grain(read.grain).shape));
    return all.empty() ? std::string() : all.front();
  };
  // Grains of 1000 kg/m3.
  EXPECT_THAT(said("[experiment.fill]\nmeasured = { values = [1.403, 1.398] }\n"),
              AllOf(HasSubstr("[experiment.fill] measured = 1.403 kg/m3"),
                    HasSubstr("from 50 to 1000 kg/m3")));
  EXPECT_THAT(said("[experiment.fill]\nmeasured = { mean = 0.603 }\n"),
              HasSubstr("Fix: 603 if a point parts thousands"));
  EXPECT_THAT(said("[experiment.fill]\nmeasured = { mean = 1403 }\n"), HasSubstr("1403"));
  EXPECT_EQ(said("[experiment.fill]\nmeasured = { mean = 603 }\n"), "");
  EXPECT_THAT(said("[experiment.drop]\nheight_mm = 100\nmeasured = { mean = 900 }\n"),
              HasSubstr("[experiment.drop] measured = 900 mm"));
  const std::string low =
      "[experiment.drop]\nheight_mm = 500\nlow_height_mm = 20\nalso_measured = { low_rebound_mm = "
      "{ "
      "mean = ";
  EXPECT_THAT(said(low + "90 } }\n"), HasSubstr("low_rebound_mm = 90 mm. Rule: at most "));
  EXPECT_EQ(said(low + "9 } }\n"), "");
  EXPECT_EQ(said("[experiment.roll]\nmeasured = { values = [120, 0] }\n"), "") << "it stayed";
  EXPECT_THAT(errors("[experiment.roll]\nmeasured = { values = [120, -150] }\n"),
              HasSubstr("experiment.roll.measured.values = -150. Rule: a number of at least 0"));
}

TEST_F(BenchSheets, RepeatsOnOneGrainAreAveragedFirst) {
  write("drops.csv", "sample,drop_mm,rebound_mm\nA,500,8\nB,500,11\nA,500,10\n");
  const auto read = sheets("[experiment.drop]\nmeasured = { readings = \"drops.csv\" }\n");
  EXPECT_THAT(read.at(0).values, ElementsAre(DoubleEq(9), DoubleEq(11)));
  EXPECT_EQ(read.at(0).rows, 3);
}

TEST_F(BenchSheets, AllErrorsOfAllSheetsAreToldAtOnce) {
  write("drops.csv", "drop_mm,rebound_mm\n500,abc\n500,600\n400,9\n500,9\n");
  write("tilts.csv", "angel_deg\n22\n");
  write("rolls.csv", "incline_deg,released_mm,stopped_mm\n");
  const std::string all = errors(R"([experiment.drop]
measured = { readings = "drops.csv" }
[experiment.tilt]
measured = { readings = "tilts.csv" }
[experiment.roll]
measured = { readings = "rolls.csv" }
)");
  EXPECT_THAT(
      all,
      AllOf(
          HasSubstr("drops.csv:2: rebound_mm is \"abc\""),
          HasSubstr("drops.csv:3: rebound_mm = 600"),
          HasSubstr("drops.csv:4: drop_mm = 400, and the study has height_mm = 500 in "
                    "[experiment.drop]. Rule: the same within 1 %. Fix: write height_mm = 400"),
          HasSubstr("tilts.csv: has no column angle_deg. Did you mean angel_deg?"),
          HasSubstr("rolls.csv: no readings yet: fill in a row for each reading below its header, "
                    "incline_deg, released_mm, stopped_mm.")));
  EXPECT_THAT(all, Not(HasSubstr("drops.csv:5")));
}

TEST_F(BenchSheets, OneWithoutRowsMayBeTakenForNothingMeasured) {
  write("drops.csv", "drop_mm,rebound_mm\n");
  const dem::Study read = study("[experiment.drop]\nmeasured = { readings = \"drops.csv\" }\n");
  const std::vector<SheetReadings> sheets = read_sheets(read, NoRows::allowed);
  ASSERT_EQ(sheets.size(), 1U);
  EXPECT_THAT(sheets[0].values, IsEmpty());
  EXPECT_THAT(error_of([&] { read_sheets(read, NoRows::refused); }), HasSubstr("no readings yet"));
}

TEST_F(BenchSheets, CountAsIfTheyWereListedInTheStudy) {
  write("drops.csv", "drop_mm,rebound_mm\n100,24\n100,26\n100,25.5\n");
  std::string by_sheet = test::kSphereStudy, by_hand = test::kSphereStudy;
  const std::string mean = "{ mean = 25, sd = 1, n = 5 }";
  by_sheet.replace(by_sheet.find(mean), mean.size(), "{ readings = \"drops.csv\" }");
  by_hand.replace(by_hand.find(mean), mean.size(), "{ values = [24, 26, 25.5] }");
  const dem::Study sheet = dem::read_study(folder_.write("sheet.toml", by_sheet));
  const dem::Study hand = dem::read_study(folder_.write("hand.toml", by_hand));
  const dem::ClumpFile grain = dem::build_grain(hand.grain);
  const Budget budget = budget_named("quick");
  const Observable one =
      problem_of(with_readings(sheet, read_sheets(sheet, NoRows::refused)), grain, budget)
          .problem.observables.at(0);
  const Observable other = problem_of(hand, grain, budget).problem.observables.at(0);
  EXPECT_EQ(one.name, "drop");
  EXPECT_EQ(one.mean, other.mean);
  EXPECT_EQ(one.sd, other.sd);
  EXPECT_EQ(one.n, 3);
}

TEST(GlassBeadStudy, SeeksAllCoefficientsFromItsSheets) {
  const dem::Study study =
      dem::read_study(repose::testing::source_folder() / "samples/glass_beads/study.toml");
  const dem::Study measured = with_readings(study, read_sheets(study, NoRows::refused));
  const StudyProblem made =
      problem_of(measured, dem::build_grain(study.grain), budget_named("quick"));
  EXPECT_THAT(made.problem.parameters, SizeIs(6));
  EXPECT_THAT(made.problem.observables, SizeIs(8));
  EXPECT_THAT(made.notes, IsEmpty());
}

}  // namespace
}  // namespace repose::calibrate
