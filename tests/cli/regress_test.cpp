#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command_test.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Table 2 of the hazelnut study.
constexpr const char* kHazelnut =
    "run,point,x1,x2,x3,error\n"
    "1,cube,-1,-1,-1,48.10\n2,cube,1,-1,-1,51.65\n3,cube,-1,1,-1,3.63\n4,cube,1,1,-1,3.55\n"
    "5,cube,-1,-1,1,24.16\n6,cube,1,-1,1,20.78\n7,cube,-1,1,1,1.54\n8,cube,1,1,1,19.37\n"
    "9,axial,-1.682,0,0,2.52\n10,axial,1.682,0,0,0.51\n11,axial,0,-1.682,0,64.73\n"
    "12,axial,0,1.682,0,0.51\n13,axial,0,0,-1.682,26.38\n14,axial,0,0,1.682,19.37\n"
    "15,centre,0,0,0,0.51\n16,centre,0,0,0,11.03\n17,centre,0,0,0,0.51\n18,centre,0,0,0,2.61\n"
    "19,centre,0,0,0,0.56\n20,centre,0,0,0,0.51\n";

/// The table of a design with a column y of made-up results.
std::string with_results(const std::string& design) {
  std::istringstream lines(design);
  std::string table, line;
  for (int row = 0; std::getline(lines, line); ++row) {
    table += line;
    table += row == 0 ? ",y" : std::string(",").append(std::to_string(row * row % 7));
    table += '\n';
  }
  return table;
}

struct RegressCommand : CommandTest {
  RegressCommand() : CommandTest({"regress"}) {}
};

TEST_F(RegressCommand, PrintsTheHazelnutStudysAnalysis) {
  folder_.write("runs.csv", std::string(kHazelnut));
  const Finished done = run({"runs.csv", "--response", "error", "--target", "5"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  for (const char* part :
       {"-16.45", "0.1813", "0.9586, adjusted 0.9214", "-8.764", "saddle", "looks like an absolute",
        "all of the box", "cannot determine 3 factors"}) {
    EXPECT_THAT(done.out, HasSubstr(part));
  }
  EXPECT_LE(longest_line(done.out), 80U);
}

TEST_F(RegressCommand, AnUncertainTargetGivesAWiderInterval) {
  folder_.write("runs.csv", std::string("x,y\n-2,-4.2\n-1,-1.9\n0,.1\n1,2.2\n2,3.8\n"));
  const Words words = {"runs.csv", "--response", "y", "--model", "linear", "--target"};
  const auto width = [&](const std::string& target) {
    Words all = words;
    all.push_back(target);
    const json interval = result(all)["target"]["through_centre"][0]["interval"];
    return interval[1].get<double>() - interval[0].get<double>();
  };
  EXPECT_GT(width("0.5±0.8"), width("0.5") * 1.5);
  EXPECT_EQ(width("0.5±0.8"), width("0.5+-0.8"));
  Words wrong = words;
  wrong.emplace_back("1±");
  EXPECT_THAT(run(wrong).err, HasSubstr("half-width of its 95 % interval behind ±"));
}

TEST_F(RegressCommand, JsonHasEverything) {
  folder_.write("runs.csv", std::string(kHazelnut));
  const Finished done = run({"runs.csv", "--response", "error", "--target", "5", "--json", "-"});
  const json result = json::parse(done.out);
  EXPECT_EQ(result["model"], "quadratic");
  EXPECT_EQ(result["factors"].size(), 3U);
  EXPECT_EQ(result["coefficients"][7]["term"], "x1^2");
  EXPECT_NEAR(result["coefficients"][2]["value"].get<double>(), -16.4456, 1e-4);
  EXPECT_NEAR(result["anova"]["lack_of_fit"]["p"].get<double>(), .18127, 1e-5);
  EXPECT_NEAR(result["canonical"]["axes"][2]["curvature"].get<double>(), 13.956, 1e-3);
  EXPECT_NEAR(result["lowest_in_box"]["levels"]["x2"].get<double>(), .978, 1e-3);
  EXPECT_TRUE(result["target"]["reached"].get<bool>());
  EXPECT_EQ(result["runs"].size(), 20U);
  EXPECT_THAT(result["warnings"].dump(), HasSubstr("absolute_error"));
}

TEST_F(RegressCommand, FactorsAndModelCanBeChosen) {
  folder_.write("runs.csv", std::string(kHazelnut));
  const Finished done = run({"runs.csv", "--response", "error", "--factors", "x3,x2", "--model",
                             "linear", "--json", "-"});
  const json result = json::parse(done.out);
  ASSERT_EQ(result["coefficients"].size(), 3U);
  EXPECT_EQ(result["coefficients"][1]["term"], "x3");
  EXPECT_TRUE(result["canonical"].is_null());
  EXPECT_TRUE(result["target"].is_null());
}

TEST_F(RegressCommand, ADesignsTableGoesStraightIn) {
  const Finished design = run_repose(
      folder_, {"design", "sweep", "--factor", "e=0.01:0.41", "--coded", "--random-order", "1"});
  folder_.write("runs.csv", with_results(design.out));
  const Finished done = run({"runs.csv", "--response", "y"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("y from e:"), HasSubstr("e 0.01 … 0.41")));
}

TEST_F(RegressCommand, CornersOfACompositeDesignAreItsUnits) {
  const Finished design =
      run_repose(folder_, {"design", "ccd", "--factor", "a=1:3", "--factor", "b=10:30"});
  folder_.write("runs.csv", with_results(design.out));
  const json result = json::parse(run({"runs.csv", "--response", "y", "--json", "-"}).out);
  EXPECT_EQ(result["factors"][0]["coded_minus_1"], 1);
  EXPECT_EQ(result["factors"][1]["coded_plus_1"], 30);
  EXPECT_NEAR(result["factors"][0]["box"][0].get<double>(), 2 - std::sqrt(2.0), 1e-9);
}

TEST_F(RegressCommand, PrintsTheSurfaceInNaturalUnits) {
  folder_.write("runs.csv", std::string("e,h\n0,1\n.1,2\n.2,5\n.3,10.001\n.4,17\n"));
  // R: coef(lm(h ~ e + I(e^2)))
  EXPECT_THAT(run({"runs.csv", "--response", "h"}).out,
              HasSubstr("h = 0.999857 + 0.00385714 e + 99.9929 e^2"));
}

TEST_F(RegressCommand, CodingsCanBeGiven) {
  folder_.write("runs.csv", std::string("x,y\n0,1\n1,3.1\n2,4.9\n3,7\n"));
  const Finished done =
      run({"runs.csv", "--response", "y", "--model", "linear", "--coding", "x=0:1", "--json", "-"});
  const json slope = json::parse(done.out)["coefficients"][1];
  EXPECT_NEAR(slope["value"].get<double>(), slope["natural"].get<double>() / 2, 1e-12);
}

TEST_F(RegressCommand, EveryErrorOfTheTableIsNamedWithItsLine) {
  folder_.write("runs.csv", std::string("a,b,y\n1,2,3\n1,nan,3\nx,2,\n"));
  const Finished cells =
      run({"runs.csv", "--response", "y", "--model", "cubic", "--target", "z", "--coding", "a=1"});
  EXPECT_EQ(cells.exit_code, 2);
  EXPECT_THAT(cells.out, IsEmpty());
  EXPECT_THAT(cells.err, AllOf(HasSubstr("repose: runs.csv:3: b is \"nan\""),
                               HasSubstr("repose: runs.csv:4: a is \"x\""),
                               HasSubstr("runs.csv:4: y is \"\""), HasSubstr("--model cubic"),
                               HasSubstr("--target z"), HasSubstr("--coding a=1")));
  folder_.write("ragged.csv", std::string("a,y\n1,2\n3\n4,5,6\n"));
  EXPECT_THAT(run({"ragged.csv", "--response", "y"}).err,
              AllOf(HasSubstr("ragged.csv:3:"), HasSubstr("ragged.csv:4:")));
}

/// Two days, the second 4 lower: y = 20 + 2 a + b on the first.
std::string two_days(const std::string& name, const std::string& first, const std::string& second) {
  std::string table = "a,b," + name + ",y\n";
  const std::array<std::array<double, 3>, 7> runs = {
      {{-1, -1, .1}, {-1, 1, -.1}, {1, -1, .05}, {1, 1, -.2}, {0, 0, .1}, {0, 0, 0}, {0, 1, .15}}};
  for (const double day : {0., 1.}) {
    for (const auto& [a, b, noise] : runs) {
      const double x = day == 0 ? a : -b;
      const double z = day == 0 ? b : a;
      table += fmt::format("{},{},{},{:.2f}\n", x, z, day == 0 ? first : second,
                           20 + 2 * x + z - 4 * day + noise);
    }
  }
  return table;
}

TEST_F(RegressCommand, AColumnOfTextIsBlocks) {
  folder_.write("runs.csv", two_days("Day", "Mon", "Tue"));
  const Words words = {"runs.csv", "--response", "y", "--model", "linear"};
  const json blocked = result(words);
  EXPECT_EQ(blocked["factors"].size(), 2U);
  EXPECT_EQ(blocked["blocks"]["column"], "Day");
  EXPECT_EQ(blocked["blocks"]["effects"][1]["block"], "Tue");
  EXPECT_NEAR(blocked["blocks"]["effects"][0]["value"].get<double>(), 2, .15);
  EXPECT_NEAR(blocked["coefficients"][0]["value"].get<double>(), 18, .15);
  EXPECT_EQ(blocked["anova"]["blocks"]["df"], 1);
  EXPECT_LT(blocked["residual_sd"].get<double>(), .2);
  EXPECT_EQ(blocked["runs"][0]["block"], "Mon");
  const std::string shown = run(words).out;
  EXPECT_THAT(shown, AllOf(HasSubstr("blocks by Day: Mon, Tue"), HasSubstr("Day Tue"),
                           HasSubstr("Day (blocks)"), HasSubstr("mean of these blocks")));

  Words without = words;
  without.insert(without.end(), {"--blocks", "none"});
  EXPECT_FALSE(result(without).contains("blocks"));
  EXPECT_GT(result(without)["residual_sd"].get<double>(), 1);
  EXPECT_THAT(run(without).out, HasSubstr("not used: column Day (no blocks are wanted"));

  // Numbered days count as a factor unless declared as blocks.
  folder_.write("runs.csv", two_days("Day", "1", "2"));
  EXPECT_EQ(result(words)["factors"].size(), 3U);
  EXPECT_THAT(result(words)["notes"].dump(), HasSubstr("Day holds numbers and is taken for a"));
  EXPECT_THAT(run(words).out, HasSubstr("--blocks"));
  Words named = words;
  named.insert(named.end(), {"--blocks", "Day"});
  EXPECT_EQ(result(named)["coefficients"], blocked["coefficients"]);
  for (const char* name : {"Block", "batch", "Operator"}) {
    folder_.write("runs.csv", two_days(name, "1", "2"));
    EXPECT_EQ(result(words)["coefficients"], blocked["coefficients"]) << name;
    EXPECT_THAT(run(words).out, HasSubstr("taken for names of blocks")) << name;
  }
  Words wrong = words;
  wrong.insert(wrong.end(), {"--blocks", "Week"});
  EXPECT_THAT(run(wrong).err, HasSubstr("has no column Week for blocks"));
}

TEST_F(RegressCommand, BlocksThatAreAFactorAreNamed) {
  folder_.write("runs.csv", std::string("mu,kind,y\n1,a,2\n1,a,2.1\n2,b,3\n2,b,3.1\n1,a,2.2\n"));
  const Words words = {"runs.csv", "--response", "y", "--model", "linear"};
  EXPECT_THAT(run(words).err, AllOf(HasSubstr("mu is the same throughout each block of kind"),
                                    HasSubstr("--blocks none")));
  Words without = words;
  without.insert(without.end(), {"--blocks", "none"});
  EXPECT_EQ(run(without).exit_code, 0);
}

TEST_F(RegressCommand, WhatOtherProgramsWriteBesideARunIsNoFactor) {
  const std::string runs[] = {"-1,-1,1.02", "-1,1,2.97", "1,-1,5.1", "1,1,7.03", "0,0,4.1"};
  const auto table = [&](const std::string& header, const std::array<std::string, 5>& before) {
    std::string text = header + ",A,B,y\n";
    for (std::size_t i = 0; i < 5; ++i) text += before[i] + ',' + runs[i] + '\n';
    return text;
  };
  const Words words = {"runs.csv", "--response", "y", "--model", "linear"};
  folder_.write("runs.csv", table("n", {"5", "1", "3", "2", "4"}));
  const json counted = result(words);
  EXPECT_EQ(counted["factors"].size(), 2U);
  EXPECT_EQ(counted["left_out"][0]["what"], "column n");
  EXPECT_THAT(run(words).out, HasSubstr("not used: column n (each number once"));
  // Two runs are missing, so no column counts up from 1.
  folder_.write("runs.csv", table("StdOrder,Run Order,PtType,Blocks,Comments",
                                  {"5,7,1,1,wet", "1,1,1,1,", "3,2,1,1,", "7,5,1,1,", "4,6,0,1,"}));
  EXPECT_EQ(result(words)["coefficients"], counted["coefficients"]);
  EXPECT_EQ(result(words)["left_out"].size(), 5U);
  Words named = words;
  named.insert(named.end(), {"--factors", "n,A"});
  folder_.write("runs.csv", table("n", {"5", "1", "3", "2", "4"}));
  EXPECT_EQ(result(named)["factors"][0]["name"], "n");
  folder_.write("runs.csv", std::string("n,m,y\n1,2,3.3\n2,1,4.1\n3,4,5.9\n4,3,6.2\n"));
  EXPECT_THAT(run(words).err, HasSubstr("n, m hold each number once"));
}

TEST_F(RegressCommand, DesignsThatCannotCarryTheModelAreRefused) {
  folder_.write("few.csv", std::string("a,b,y\n0,0,1\n1,1,1\n"));
  const Finished few = run({"few.csv", "--response", "y"});
  EXPECT_EQ(few.exit_code, 2);
  EXPECT_THAT(few.err,
              AllOf(HasSubstr("2 runs for the 6 terms"), HasSubstr("y is 1 in every run")));
  EXPECT_THAT(run({"few.csv", "--response", "z"}).err, HasSubstr("has no column z"));
  EXPECT_THAT(run({"few.csv", "--response", "y", "--factors", "y,q,q"}).err,
              AllOf(HasSubstr("y is the response"), HasSubstr("q is named twice"),
                    HasSubstr("has no column q")));
  EXPECT_THAT(run({"few.csv"}).err, HasSubstr("response"));
}

}  // namespace
}  // namespace repose::testing
