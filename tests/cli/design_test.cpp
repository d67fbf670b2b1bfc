#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/cli/command_test.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

auto count_of_lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }

struct DesignCommand : CommandTest {
  DesignCommand() : CommandTest({"design"}) {}
};

TEST_F(DesignCommand, PrintsNaturalLevelsInStandardOrder) {
  const Finished done = run({"ccd", "--factor", "e=0.1:0.3", "--factor", "mu=0.2:0.4"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, StartsWith("run,point,e,mu\n1,cube,0.1,0.2\n2,cube,0.3,0.2\n"));
  EXPECT_THAT(done.out, HasSubstr("9,centre,0.2,0.3\n"));
  EXPECT_EQ(count_of_lines(done.out), 1 + 4 + 4 + 6);
  EXPECT_THAT(done.err, IsEmpty());
}

TEST_F(DesignCommand, TheHazelnutStudysSweepAndAscent) {
  EXPECT_THAT(run({"sweep", "--factor", "e=0.01:0.41"}).out,
              AllOf(HasSubstr("2,step,0.06\n"), HasSubstr("9,step,0.41\n")));
  EXPECT_THAT(
      run({"ascent", "--start", "e=.1", "--step", "e=.1", "--start", "mu_r=.01", "--step",
           "mu_r=.01"})
          .out,
      AllOf(StartsWith("run,point,e,mu_r\n1,step,0.1,0.01\n"), HasSubstr("5,step,0.5,0.05\n")));
}

TEST_F(DesignCommand, RandomOrderKeepsTheStandardOneAndRepeats) {
  const std::vector<std::string> words = {"design",         "lhs",   "--factor", "a=0:1",
                                          "--factor",       "b=0:1", "--runs",   "6",
                                          "--random-order", "3",     "--coded"};
  const Finished done = run_repose(folder_, words);
  EXPECT_THAT(done.out, StartsWith("run,standard,point,a,b,a_coded,b_coded\n"));
  EXPECT_EQ(done.out, run_repose(folder_, words).out);
}

TEST_F(DesignCommand, WritesAFile) {
  const Finished done = run({"box-behnken", "--factor", "a=0:1", "--factor", "b=0:1", "--factor",
                             "c=0:1", "--out", "runs.csv"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, IsEmpty());
  EXPECT_EQ(count_of_lines(text("runs.csv")), 16);
}

TEST_F(DesignCommand, AscentFollowsTheSlopeOfEarlierRuns) {
  folder_.write("runs.csv",
                std::string("run,point,a,b,y\n1,cube,0,0,1\n2,cube,2,0,5\n3,cube,0,10,2\n"
                            "4,cube,2,10,6.2\n5,centre,1,5,3.5\n"));
  const Finished done = run({"ascent", "--fit", "runs.csv", "--response", "y", "--runs", "3"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("1,step,1,5\n2,step,1.5,"));
  const Finished down = run({"ascent", "--fit", "runs.csv", "--response", "y", "--descend"});
  EXPECT_THAT(down.out, HasSubstr("2,step,0.5,"));
}

TEST_F(DesignCommand, LevelsBelowZeroAreSaid) {
  const std::vector<std::string> words = {"design",     "ccd",      "--factor",
                                          "a=0.01:0.2", "--factor", "b=1:2"};
  const Finished done = run_repose(folder_, words);
  EXPECT_EQ(done.exit_code, 0);
  EXPECT_THAT(done.err,
              AllOf(HasSubstr("a: some runs have a level below 0"), Not(HasSubstr("b:"))));
  std::vector<std::string> inscribed = words;
  inscribed.emplace_back("--inscribed");
  EXPECT_THAT(run_repose(folder_, inscribed).err, IsEmpty());
}

TEST_F(DesignCommand, EveryErrorIsNamedAtOnce) {
  const Finished done = run({"lhs", "--factor", "a=2:1", "--factor", "run=0:1", "--levels", "3",
                             "--runs", "x", "--random-order", "-1", "--out", "no/where.csv"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.out, IsEmpty());
  EXPECT_THAT(done.err, AllOf(HasSubstr("--factor a=2:1"), HasSubstr("--factor run=0:1"),
                              HasSubstr("--levels: not an option of lhs"), HasSubstr("--runs x"),
                              HasSubstr("--random-order -1"), HasSubstr("--out no/where.csv")));
  EXPECT_THAT(run({"dcc"}).err, HasSubstr("design dcc: unknown"));
  EXPECT_THAT(run({}).err, HasSubstr("no kind of design"));
  EXPECT_THAT(run({"ccd", "--factor", "a=0:1"}).err, HasSubstr("takes 2 to 6"));
  EXPECT_THAT(run({"ascent"}).err, HasSubstr("--start and --step"));
  EXPECT_THAT(run({"ascent", "--start", "a=1", "--step", "b=1"}).err, HasSubstr("b has no start"));
  EXPECT_THAT(run({"ascent", "--start", "a=1", "--start", "a=2", "--step", "a=1"}).err,
              HasSubstr("a: is named twice"));
}

}  // namespace
}  // namespace repose::testing
