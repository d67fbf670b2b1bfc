#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "calibrate/report/study_report.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate::report {
namespace {

using repose::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

constexpr const char* kRecord = R"({"program": "repose 0", "method": "joint",
 "study": {"file": "nuts.toml", "hash": "abc", "settings": ["a.b=1"]},
 "budget": {"name": "standard", "description": "long"}, "pictures": []})";

constexpr const char* kResult = R"({"method": "joint", "verified": true, "chi2": 0.5,
 "parameters": [
  {"name": "contact.particle_wall.restitution", "value": 0.4, "interval": [0.35, 0.45],
   "verdict": "determined", "bounds": [0.1, 0.9], "advice": "", "profile": [[0.3, 5], [0.4, 0], [0.5, 6]]},
  {"name": "contact.particle_wall.sliding_friction", "value": 0.3, "interval": [0.1, 0.8],
   "verdict": "undetermined", "bounds": [0.1, 0.8], "advice": "tilt a plate", "profile": []}],
 "observables": [{"name": "drop", "unit": "mm", "measured": 25, "sd": 1, "sd_assumed": false,
   "measured_uncertainty": 0.5, "simulated": 25.1, "simulated_uncertainty": 0.2,
   "simulated_sd": 0.4, "difference_sigma": 0.1, "reachable": [1, 80],
   "verification": {"simulated": 25.4, "uncertainty": 0.3, "difference_sigma": 0.6, "runs": 3, "failed_runs": 0}}],
 "responses": [{"observable": "drop", "parameter": "contact.particle_wall.restitution",
   "values": [0.1, 0.9], "simulated": [1, 80], "uncertainty": [0.1, null], "scatter": [0.5, 0.5]}],
 "surfaces": [{"observable": "drop", "x_parameter": "contact.particle_wall.restitution",
   "y_parameter": "contact.particle_wall.sliding_friction", "x": [0.1, 0.9], "y": [0.1, 0.8],
   "simulated": [[1, 80], [2, 81]]}],
 "warnings": ["a <b>bold</b> warning"],
 "provenance": {"program": "repose 0", "study": {"file": "nuts.toml", "hash": "abc", "settings": ["a.b=1"]},
   "budget": {"name": "standard", "description": "long"}},
 "runs": [{"experiment": "drop", "seed": 1, "values": {"contact.particle_wall.restitution": 0.2},
   "readings": {"value": 7}, "failure": null}]})";

constexpr const char* kRun = R"({"simulated": {"experiment": "drop",
  "particle_wall": {"restitution": 0.%d, "sliding_friction": 0.3, "rolling_friction": 0.1},
  "particle_particle": {}}, "readings": {"value": %d}, "failure": "", "wall_s": 1})";

/// "a" with every `from` replaced.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    text.replace(at, from.size(), to);
    at += to.size();
  }
  return text;
}

/// What stands before the scripts: text, tables, pictures.
std::string shown(const Report& report) {
  return report.html.substr(0, report.html.find("<script type=\"application/json\""));
}

std::string data_of(const Report& report) {
  const std::size_t start = report.html.find("<script type=\"application/json\"");
  return report.html.substr(start, report.html.find("</script>", start) - start);
}

class StudyReport : public ::testing::Test {
 protected:
  Report made() const { return study_report(folder_.path()); }
  std::string table(const std::string& name) const {
    for (const CsvFile& file : made().tables) {
      if (file.name == name) return file.text;
    }
    return "no " + name;
  }

  TemporaryFolder folder_;
};

TEST_F(StudyReport, BeginsWithTheAnswer) {
  folder_.write("result.json", std::string(kResult));
  const std::string page = shown(made());
  EXPECT_THAT(page, HasSubstr("1 of 2 coefficients are determined"));
  EXPECT_THAT(page, HasSubstr("they agree with the bench"));
  EXPECT_LT(page.find("id=\"answer\""), page.find("id=\"heaps\""));
  EXPECT_THAT(page, HasSubstr("Sliding friction, particle–wall: tilt a plate"));
  EXPECT_EQ(table("coefficients.csv"),
            "coefficient,value,from,to,sought from,sought to,verdict\n"
            "\"restitution, particle–wall\",0.4,0.35,0.45,0.1,0.9,determined\n"
            "\"sliding friction, particle–wall\",0.3,0.1,0.8,0.1,0.8,undetermined\n");
}

TEST_F(StudyReport, IsOneFileThatFetchesNothing) {
  folder_.write("result.json", std::string(kResult));
  const std::string page = shown(made());
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, Not(HasSubstr("src=\"http")));
  EXPECT_THAT(page, Not(HasSubstr("href=\"http")));
}

TEST_F(StudyReport, SameFolderSameBytes) {
  folder_.write("result.json", std::string(kResult));
  EXPECT_EQ(made().html, made().html);
}

TEST_F(StudyReport, CurvesHaveRunsFitAndMeasuredValue) {
  folder_.write("result.json", std::string(kResult));
  const std::string csv = table("response_drop_particle_wall_restitution.csv");
  EXPECT_THAT(csv, HasSubstr("simulated runs,0.2,7,,\n"));
  EXPECT_THAT(csv, HasSubstr("fit,0.1,1,,\n"));
  EXPECT_THAT(csv, HasSubstr("95 % of the fit,0.1,,0.804,1.196\n"));
  EXPECT_THAT(csv, HasSubstr("95 % of the fit,0.9,,,\n"));  // its uncertainty is not known
  EXPECT_THAT(csv, HasSubstr("\"measured, 95 %\",0.1,25,24.02,25.98\n"));
  EXPECT_THAT(csv, HasSubstr("best fit,0.4,25.1,0.35,0.45\n"));
}

TEST_F(StudyReport, SurfacesHaveTheRidgeOfSolutions) {
  folder_.write("result.json", std::string(kResult));
  // 25 lies 24/79 of the way from 1 to 80 and 23/79 from 2 to 81.
  const std::string csv =
      table("surface_drop_particle_wall_restitution_particle_wall_sliding_friction.csv");
  EXPECT_THAT(csv, HasSubstr("as measured: 25 mm,0.343038,0.1,25\n"));
  EXPECT_THAT(csv, HasSubstr("as measured: 25 mm,0.332911,0.8,25\n"));
}

TEST_F(StudyReport, NamesCannotInjectMarkup) {
  const std::string hostile = "\\\"'><script>alert(1)</script><img src=x onerror=alert(2)>";
  std::string result = replaced(kResult, "nuts.toml", hostile);
  result = replaced(result, "\"drop\"", "\"drop</script><script>alert(3)</script>\"");
  result = replaced(result, "contact.particle_wall.restitution", hostile);
  folder_.write("result.json", result);
  const Report report = made();
  EXPECT_THAT(shown(report), Not(HasSubstr("<script>")));
  EXPECT_THAT(shown(report), Not(HasSubstr("<img src=x")));
  EXPECT_THAT(shown(report), Not(HasSubstr("<b>bold")));
  EXPECT_THAT(shown(report), HasSubstr("&lt;script&gt;"));
  EXPECT_THAT(data_of(report).substr(1), Not(HasSubstr("<")));
  for (const CsvFile& file : report.tables) {
    EXPECT_THAT(file.name, Not(::testing::ContainsRegex("[^A-Za-z0-9_.]")));
  }
}

TEST_F(StudyReport, LongNamesAreShortened) {
  const std::string longest(10'000, 'n');
  folder_.write("result.json", replaced(replaced(kResult, "nuts.toml", longest),
                                        "contact.particle_wall.restitution", longest));
  const Report report = made();
  const std::string much(300, 'n');
  EXPECT_EQ(shown(report).find(much), std::string::npos);
  EXPECT_EQ(data_of(report).find(much), std::string::npos);
}

TEST_F(StudyReport, TablesOfAlikeNamesHaveFilesOfTheirOwn) {
  folder_.write("result.json",
                replaced(kResult, "contact.particle_wall.restitution", "?") + std::string(1, '\n'));
  std::vector<std::string> names;
  for (const CsvFile& file : made().tables) names.push_back(file.name);
  std::vector<std::string> once = names;
  std::sort(once.begin(), once.end());
  once.erase(std::unique(once.begin(), once.end()), once.end());
  EXPECT_EQ(once.size(), names.size());

  const std::string longest(10'000, 'n');
  std::string result = replaced(kResult, "contact.particle_wall.restitution", longest + "a");
  result = replaced(result, "contact.particle_wall.sliding_friction", longest + "b");
  folder_.write("result.json", replaced(result, "\"profile\": []", "\"profile\": [[0.1, 2]]"));
  EXPECT_THAT(table("profile_" + longest.substr(0, 92) + ".csv"), Not(HasSubstr("no ")));
  EXPECT_THAT(table("profile_" + longest.substr(0, 92) + "_2.csv"), Not(HasSubstr("no ")));
}

TEST_F(StudyReport, UnfinishedStudiesSaySoAndHowToGoOn) {
  folder_.write("study.json", std::string(kRecord));
  std::filesystem::create_directory(folder_.path() / "runs");
  for (const auto& [number, value] : {std::pair("2", "7"), {"5", "30"}}) {
    folder_.write(std::string("runs/") + number + ".json",
                  replaced(replaced(kRun, "0.%d", std::string("0.") + number), "%d", value));
  }
  folder_.write("runs/damaged.json", std::string("{\"simulated\": "));
  const Report report = made();
  EXPECT_THAT(shown(report), HasSubstr("Unfinished: this study has no result yet"));
  EXPECT_THAT(shown(report), HasSubstr("2 simulations are there"));
  EXPECT_THAT(shown(report), HasSubstr("repose calibrate nuts.toml --budget standard --set a.b=1"));
  EXPECT_EQ(table("simulations.csv"), "experiment,simulations,without a reading\ndrop,2,0\n");
  EXPECT_THAT(table("response_drop_particle_wall_restitution.csv"),
              AllOf(HasSubstr("simulated runs,0.2,7,,\n"), HasSubstr("simulated runs,0.5,30,,\n")));
}

TEST_F(StudyReport, ResultsOfAnotherStudyAreNotShown) {
  folder_.write("study.json", replaced(kRecord, "abc", "changed"));
  folder_.write("result.json", std::string(kResult));
  EXPECT_THAT(shown(made()), AllOf(HasSubstr("Unfinished"), HasSubstr("is of another study"),
                                   Not(HasSubstr("coefficients are determined"))));
}

TEST_F(StudyReport, PicturesThatAreGoneAreSaid) {
  folder_.write("result.json", std::string(kResult));
  folder_.write("study.json",
                replaced(kRecord, "\"pictures\": []",
                         R"("pictures": [{"file": "/nowhere/<b>heap.jpg", "status": "ok",
                            "angle_deg": 23.1, "reason": ""}])"));
  EXPECT_THAT(shown(made()), HasSubstr("The photograph &lt;b&gt;heap.jpg cannot be shown"));
}

TEST_F(StudyReport, ThePublishedWayHasItsOwnChapters) {
  folder_.write("result.json", std::string(R"({"method": "paper",
   "values": {"contact.particle_wall.restitution": 0.31},
   "sweeps": [{"parameter": "contact.particle_wall.restitution", "observable": "drop", "measured": 4,
     "levels": [0, 1, 2, 3], "results": [0, 1, 4, 9], "value": 2, "reached": true, "r2": 1}],
   "steepest_ascent": [{"restitution": 0.1, "sliding_friction": 0.1, "rolling_friction": 0.01,
     "angle_deg": 20, "error_percent": 14}],
   "composite": [], "verification": {"heaps": [], "mean_deg": 23, "sd_deg": null, "measured_deg": 23.4},
   "warnings": [{"code": "ridge", "message": "a ridge"}], "provenance": {}})"));
  EXPECT_THAT(shown(made()), AllOf(HasSubstr("single points without intervals"),
                                   HasSubstr("Steepest ascent"), HasSubstr("a ridge")));
  const std::string csv = table("sweep_particle_wall_restitution.csv");
  EXPECT_THAT(csv, HasSubstr("simulated runs,2,4,,\n"));
  EXPECT_THAT(csv, HasSubstr("parabola,1.5,2.25,,\n"));
}

TEST_F(StudyReport, FoldersWithoutAStudyAreRefused) {
  EXPECT_THAT([this] { made(); }, ThrowsMessage<std::invalid_argument>(AllOf(
                                      HasSubstr("there is no study in it"), HasSubstr("Fix: "))));
  EXPECT_THAT([this] { study_report(folder_.path() / "none"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("there is no such folder")));
  for (const std::string text : {"", "[1]", "{\"method\": "}) {
    folder_.write("result.json", text);
    EXPECT_THAT([this] { made(); }, ThrowsMessage<std::invalid_argument>(AllOf(
                                        HasSubstr("result.json: is damaged"), HasSubstr("Fix: "))));
  }
}

TEST_F(StudyReport, EmptyResultsAreShownAsFarAsTheyGo) {
  folder_.write("result.json", std::string("{}"));
  EXPECT_THAT(shown(made()), HasSubstr("id=\"answer\""));
  folder_.write("result.json", std::string(R"({"parameters": 3, "observables": [null, 1],
    "responses": [{"observable": "drop", "values": ["a"]}], "runs": {"a": 1}, "surfaces": [{}]})"));
  EXPECT_THAT(shown(made()), HasSubstr("id=\"answer\""));
}

}  // namespace
}  // namespace repose::calibrate::report
