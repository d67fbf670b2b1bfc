#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command_test.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct BenchCommand : CommandTest {
  BenchCommand() : CommandTest({"bench"}) {}
};

TEST_F(BenchCommand, ATableOfReadingsGivesMeanScatterAndInterval) {
  folder_.write("angles.csv", std::string("angle_deg\n22.1\n22.9\n23.1\n22.3\n22.6\n"));
  const Finished table = run({"sliding", "angles.csv"});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_THAT(table.out, AllOf(HasSubstr("0.4163"), HasSubstr("0.4058 … 0.4268")));

  const Finished done = run({"sliding", "angles.csv", "--json", "-"});
  const json result = json::parse(done.out);
  EXPECT_EQ(result["test"], "sliding");
  const json& quantity = result["quantities"][0];
  EXPECT_EQ(quantity["n"], 5);
  EXPECT_NEAR(quantity["mean"].get<double>(), .41628, 1e-5);
  EXPECT_EQ(quantity["interval"].size(), 2U);
  EXPECT_EQ(quantity["values"].size(), 5U);
}

TEST_F(BenchCommand, WhatIsNotUsedOfATableIsSaid) {
  folder_.write("a.csv",
                std::string("sep=;\r\nsample;angle_deg;by\r\n;[deg];\r\na;22,1;x\r\nb;22,9;"
                            "\r\nc;23,1;\r\nMittelwert;22,7;\r\nStabw.;0,53;\r\n;;\r\n"));
  const Finished done = run({"sliding", "a.csv", "--json", "-"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const json result = json::parse(done.out);
  EXPECT_EQ(result["quantities"][0]["n"], 3);
  const std::string notes = result["notes"].dump();
  EXPECT_THAT(notes, AllOf(HasSubstr("a.csv: line 3 is left out (units)"),
                           HasSubstr("line 7 is left out (labelled \\\"Mittelwert\\\")"),
                           HasSubstr("line 8 is left out"), HasSubstr("column by is left out")));
  EXPECT_THAT(run({"sliding", "a.csv"}).out, HasSubstr("line 7 is left out"));
  folder_.write("b.csv", std::string("angle_deg\n22.1\n22.9\n23.1\n22.7\n0.53\n"));
  EXPECT_THAT(run({"sliding", "b.csv"}).err, HasSubstr("b.csv:5: lines 5 to 6 look like mean"));
}

TEST_F(BenchCommand, MixedDecimalSignsAreRefused) {
  folder_.write("a.csv", std::string("angle_deg\n22,1\n1.403\n21,9\n"));
  folder_.write("b.csv", std::string("sample,angle_deg\na,\"22,1\"\nb,1.403\n"));
  for (const char* file : {"a.csv", "b.csv"}) {
    EXPECT_THAT(run({"sliding", file}).err, AllOf(HasSubstr(":3: angle_deg is \"1.403\""),
                                                  HasSubstr("line 2 has a decimal comma")));
  }
}

TEST_F(BenchCommand, AnUnclearNumberIsOneError) {
  folder_.write("a.csv", std::string("sample;bulk_density_kg_m3\na;1.403\nb;1.398\n"));
  const std::string errors = run({"fill", "a.csv"}).err;
  EXPECT_THAT(errors, HasSubstr("may mean 1403"));
  EXPECT_THAT(errors, ::testing::Not(HasSubstr("must be")));
}

TEST_F(BenchCommand, HeightsWithAndWithoutAirHaveNoMean) {
  folder_.write("a.csv", std::string("drop_mm,rebound_mm,in_air\n500,80,1\n500,81,0\n"));
  EXPECT_THAT(run({"restitution", "a.csv"}).err, HasSubstr("have no common mean"));
  EXPECT_EQ(run({"restitution", "a.csv", "--set", "diameter_mm=5", "--set", "density_kg_m3=1200"})
                .exit_code,
            0);
}

TEST_F(BenchCommand, ADensityOfGasIsNone) {
  folder_.write("a.csv", std::string("sample;bulk_density_kg_m3\na;1.403\nb;1.398\n"));
  EXPECT_THAT(run({"fill", "a.csv"}).err,
              AllOf(HasSubstr("a.csv:2: bulk_density_kg_m3 is \"1.403\", which may mean 1403"),
                    HasSubstr("Fix: write 1403")));
  EXPECT_THAT(run({"fill", "--set", "bulk_density_kg_m3=1.4"}).err, HasSubstr("more than 5"));
}

TEST_F(BenchCommand, AnExperimentsNameStandsForTheTestOfItsSheet) {
  folder_.write("tilts.csv", std::string("angle_deg\n22.1\n22.9\n"));
  const Finished by_experiment = run({"tilt", "tilts.csv", "--json", "-"});
  ASSERT_EQ(by_experiment.exit_code, 0) << by_experiment.err;
  EXPECT_EQ(by_experiment.out, run({"sliding", "tilts.csv", "--json", "-"}).out);
  EXPECT_THAT(run({"tilting", "tilts.csv"}).err, HasSubstr("Fix: "));
}

TEST_F(BenchCommand, ShortListsCanBeTyped) {
  const Finished done =
      run({"restitution", "--set", "drop_mm=500", "--set", "rebound_mm=9.42,9.42", "--json", "-"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_NEAR(json::parse(done.out)["quantities"][0]["mean"].get<double>(), .137, 5e-4);
}

TEST_F(BenchCommand, TablesAreJoinedAndTakeWhatIsTheSameFromTheCommandLine) {
  folder_.write("a.csv", std::string("stopped_mm\n320\n325\n"));
  folder_.write("b.csv", std::string("note;stopped_mm\nsecond day;322,5\n"));
  const Finished done = run({"rolling", "a.csv", "b.csv", "--set", "incline_deg=20", "--set",
                             "released_mm=150", "--json", "-"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const json quantity = json::parse(done.out)["quantities"][0];
  EXPECT_EQ(quantity["n"], 3);
  EXPECT_NEAR(quantity["mean"].get<double>(), .1107, 5e-4);
}

TEST_F(BenchCommand, OptionalReadingsComeFromTablesAndFromTheCommandLine) {
  folder_.write("rolls.csv", std::string("incline_deg,released_mm,stopped_mm,diameter_mm\n"
                                         "20,150,782.4,20\n"));
  folder_.write("bare.csv", std::string("incline_deg,released_mm,stopped_mm\n20,150,782.4\n"));
  const auto mean = [](const Finished& done) {
    return json::parse(done.out)["quantities"][0]["mean"].get<double>();
  };
  EXPECT_NEAR(mean(run({"rolling", "rolls.csv", "--json", "-"})), .05, 5e-5);
  EXPECT_NEAR(mean(run({"rolling", "bare.csv", "--set", "diameter_mm=20", "--json", "-"})), .05,
              5e-5);
  EXPECT_NEAR(mean(run({"rolling", "bare.csv", "--json", "-"})), .0556, 5e-5);
  EXPECT_THAT(run({"rolling", "rolls.csv", "--set", "diameter_mm=20"}).err,
              HasSubstr("has a column diameter_mm, and --set gives it too"));
  EXPECT_THAT(run({"rolling", "rolls.csv", "bare.csv"}).err,
              HasSubstr("bare.csv:2: has no diameter_mm, which other readings have"));
  EXPECT_THAT(run({"sliding", "--set", "angle_deg=20", "--set", "diameter_mm=20"}).err,
              HasSubstr("diameter_mm is not a reading of this test"));
}

TEST_F(BenchCommand, OneReadingHasNullsAndIsSaid) {
  const Finished done = run({"sliding", "--set", "angle_deg=22.7", "--json", "-"});
  const json result = json::parse(done.out);
  EXPECT_TRUE(result["quantities"][0]["sd"].is_null());
  EXPECT_TRUE(result["quantities"][0]["interval"].is_null());
  EXPECT_THAT(result["notes"].dump(), HasSubstr("repeat the test"));
}

TEST_F(BenchCommand, EveryErrorIsNamedWithItsLine) {
  folder_.write("drops.csv", std::string("drop_mm,rebound_mm\n500,9\n500,abc\n500,600\n-1,2\n"));
  const Finished done = run({"restitution", "drops.csv", "missing.csv"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.out, IsEmpty());
  EXPECT_THAT(done.err, AllOf(HasSubstr("repose: drops.csv:3: rebound_mm is \"abc\""),
                              HasSubstr("repose: drops.csv:4: rebound_mm = 600"),
                              HasSubstr("repose: drops.csv:5: drop_mm = -1"),
                              HasSubstr("repose: missing.csv: there is no such file")));
}

TEST_F(BenchCommand, ASheetThatIsNotFilledInIsSaid) {
  folder_.write("heaps.csv", std::string("angle_deg\n"));
  const Finished empty = run({"heap", "heaps.csv"});
  EXPECT_EQ(empty.exit_code, 2);
  EXPECT_EQ(empty.err,
            "repose: heaps.csv: no readings yet: fill in a row for each reading below its header, "
            "angle_deg.\n");
  folder_.write("heaps.csv", std::string("angle_deg\n23\n24\n"));
  const json quantity = result({"heap", "heaps.csv"})["quantities"][0];
  EXPECT_EQ(quantity["name"], "angle_of_repose");
  EXPECT_EQ(quantity["mean"], 23.5);
}

TEST_F(BenchCommand, MistypedTestsAndReadingsAreSaid) {
  EXPECT_THAT(run({"slide", "a.csv"}).err,
              AllOf(HasSubstr("bench slide: unknown"), HasSubstr("sliding")));
  EXPECT_THAT(run({}).err, HasSubstr("no test given"));
  const Finished done = run({"sliding", "--set", "angel_deg=3"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.err, AllOf(HasSubstr("Did you mean angle_deg?"), HasSubstr("are missing")));
  EXPECT_THAT(run({"restitution", "--set", "drop_mm=1,2", "--set", "rebound_mm=1,2,3"}).err,
              HasSubstr("2 values, another reading has 3"));
  folder_.write("a.csv", std::string("angle_deg\n22\n"));
  EXPECT_THAT(run({"sliding", "a.csv", "--set", "angle_deg=3"}).err,
              HasSubstr("leave one of them out"));
}

}  // namespace
}  // namespace repose::testing
