#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/input_error.h"
#include "calibrate/experiment/run_result.h"
#include "calibrate/report/study_report.h"
#include "dem/state/state_file.h"
#include "tests/calibrate/made_up_result.h"
#include "tests/dem/packing.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate::report {
namespace {

using repose::testing::TemporaryFolder;
using test::joint_in;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::ThrowsMessage;

constexpr const char* kRecord = R"({"program": "repose 0", "method": "joint",
 "study": {"file": "nuts.toml", "hash": "abc-1", "settings": ["a.b=1"]},
 "budget": {"name": "standard", "description": "long"}, "pictures": []})";

constexpr const char* kDrop = R"({"experiment": "drop",
  "particle_wall": {"restitution": 0.%d, "sliding_friction": 0.3, "rolling_friction": 0.1},
  "particle_particle": {}})";

/// "a" with every `from` replaced.
std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
    text.replace(at, from.size(), to);
    at += to.size();
  }
  return text;
}

/// The part before the scripts: text, tables, pictures.
std::string page_of(const Report& report) {
  return report.html.substr(0, report.html.find("<script type=\"application/json\""));
}

std::string data_of(const Report& report) {
  const std::size_t start = report.html.find("<script type=\"application/json\"");
  return report.html.substr(start, report.html.find("</script>", start) - start);
}

std::string table_in(const Report& report, const std::string& name) {
  for (const CsvFile& file : report.tables) {
    if (file.name == name) return file.text;
  }
  return "no " + name;
}

class StudyReport : public ::testing::Test {
 protected:
  Report made() const { return study_report(folder_.path()); }
  void write_result(const StudyResult& result) { folder_.write("result.json", to_json(result)); }

  TemporaryFolder folder_;
  StudyResult result_ = test::joint_result();
};

TEST_F(StudyReport, ShowsTheHeapOfTheLastCheckAndNoOther) {
  JointResult& joint = joint_in(result_);
  joint.agreement.values.front() = joint.parameters.front().value + .01;
  write_result(result_);
  const dem::Simulation heap = dem::loose_packing(dem::packing_setup(), 2);
  const auto heap_with = [&](double restitution) {
    dem::write_state(folder_.path() / "heap.vtp", heap,
                     fmt::format(R"({{"particle_wall": {{"restitution": {}}}}})", restitution));
    return page_of(made());
  };
  const auto is_other = HasSubstr("(heap.vtp) has different coefficients and is not shown");
  EXPECT_THAT(heap_with(joint.agreement.values.front()),
              AllOf(Not(is_other), HasSubstr("has the coefficients of the last check")));
  EXPECT_THAT(heap_with(joint.parameters.front().value), is_other);
}

TEST_F(StudyReport, BeginsWithTheAnswer) {
  const std::string page = page_of(study_report(result_));
  EXPECT_THAT(page, HasSubstr("1 of 2 coefficients is determined"));
  EXPECT_THAT(page, Not(HasSubstr("any value in the interval")));
  EXPECT_LT(page.find("Held out of the fit: roll"), page.find("In simulations with fresh seeds"));
  EXPECT_LT(page.find("Use one row together"), page.find("Coefficients one by one"));
  EXPECT_THAT(page,
              HasSubstr("fresh seeds, it cannot be told whether bench and simulation agree."));
  EXPECT_LT(page.find("id=\"answer\""), page.find("id=\"heaps\""));
  EXPECT_THAT(page, HasSubstr("Sliding friction, particle–wall: tilt a plate"));
  EXPECT_EQ(table_in(study_report(result_), "coefficients.csv"),
            "coefficient,value,95 % from,95 % to,lower bound,upper bound,verdict\n"
            "\"restitution, particle–wall\",0.4,0.35,0.45,0.1,0.9,determined\n"
            "\"sliding friction, particle–wall\",0.3,0.1,0.8,0.1,0.8,undetermined\n");
}

TEST_F(StudyReport, SaysWhatAVerdictTakesForGrantedAndWhatItWouldBe) {
  joint_in(result_).parameters[1].verdict = Verdict::one_sided;
  const Report report = study_report(result_);
  EXPECT_THAT(page_of(report), HasSubstr("one-sided if single readings of roll scatter by 35 %"));
  EXPECT_THAT(table_in(report, "assumed_scatter.csv"),
              AllOf(HasSubstr("half,0.2,0.5,determined"), HasSubstr("twice,0.1,0.9,undetermined")));
  EXPECT_THAT(page_of(report), HasSubstr("the fit assumes: roll 35 %"));
  EXPECT_THAT(table_in(report, "reading_scatter.csv"),
              HasSubstr("± 0.28 mm (bias_sd 0.25, air_drag 0.12)"));
  joint_in(result_).assumed_scatters = {};
  EXPECT_THAT(page_of(study_report(result_)), Not(HasSubstr("assumed scatter decides")));
}

TEST_F(StudyReport, ShowsWhatMoreSpheresChange) {
  const Report report = study_report(result_);
  EXPECT_THAT(page_of(report),
              AllOf(HasSubstr("a clump of this many spheres: 11"), HasSubstr("volume error 4.2 %"),
                    HasSubstr("was not checked for heap")));
  EXPECT_THAT(table_in(report, "shape_check.csv"), HasSubstr("44,-1.5,-2.75,-0.25"));
  EXPECT_THAT(table_in(report, "finer_coefficients.csv"), HasSubstr("0.44,0.4,0.49,determined"));
  joint_in(result_).shape_check.reset();
  EXPECT_THAT(page_of(study_report(result_)), Not(HasSubstr("more spheres")))
      << "a result of an earlier version";
}

TEST_F(StudyReport, HasFewColumnsAndALittleMenu) {
  const std::string page = page_of(study_report(result_));
  const auto between = [&](const std::string& from, const std::string& to) {
    const std::size_t start = page.find(from);
    return page.substr(start, page.find(to, start) - start);
  };
  const auto count = [](const std::string& text, const std::string& what) {
    int found = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) {
      ++found;
    }
    return found;
  };
  EXPECT_LE(count(between("<nav", "</nav>"), "<a "), 8);
  const std::string agreement = between("<section id=\"agreement\"", "</section>");
  ASSERT_GT(count(agreement, "<table"), 2);
  for (std::size_t at = agreement.find("<thead"); at != std::string::npos;
       at = agreement.find("<thead", at + 1)) {
    const std::string head = agreement.substr(at, agreement.find("</thead", at) - at);
    EXPECT_LE(count(head, "<th "), 5) << head;
    EXPECT_LE(count(head, ">±<"), 1) << head;
  }
  const std::string answer = between("<caption>Coefficients one by one", "</table>");
  EXPECT_THAT(answer, AllOf(HasSubstr(">0.350 to 0.450<"), Not(HasSubstr("<svg"))));
}

TEST_F(StudyReport, SaysWhatIsAssumed) {
  const std::string page = page_of(study_report(result_));
  EXPECT_THAT(page, AllOf(HasSubstr("marked as assumed in the study"),
                          HasSubstr("particle.density_kg_m3")));
  result_.provenance.assumed.clear();
  EXPECT_THAT(page_of(study_report(result_)), Not(HasSubstr("marked as assumed")));
}

TEST_F(StudyReport, SaysWhereSimulationsWereMade) {
  JointResult& joint = joint_in(result_);
  joint.runs.resize(20, joint.runs.front());
  joint.rounds = {{.round = 0, .jobs = 12, .seconds = 30, .values = {.45, .4}, .sd = {.1, .2}},
                  {.round = 1, .jobs = 17, .seconds = 40, .values = {.45, .4}, .sd = {.1, .2}}};
  EXPECT_THAT(
      page_of(study_report(result_)),
      AllOf(HasSubstr("20 simulations entered the fit: 12 were spread over the bounds; 5 "
                      "more, in 1 further round, were"),
            HasSubstr("; 3 checked the best fits"), Not(HasSubstr("20 simulations were spread"))));
}

TEST_F(StudyReport, WhatIsForCheckingComesAfterTheAnswerInAnAppendix) {
  const std::string page = page_of(study_report(result_));
  const std::size_t appendix = page.find("id=\"appendix\"");
  ASSERT_NE(appendix, std::string::npos);
  for (const char* first : {"id=\"answer\"", "id=\"agreement\"", "id=\"limits\""}) {
    EXPECT_LT(page.find(first), appendix) << first;
  }
  for (const char* later : {"id=\"surfaces\"", "id=\"statistics\"", "id=\"methods\""}) {
    EXPECT_GT(page.find(later), appendix) << later;
  }
}

TEST_F(StudyReport, ShowsEachCurveOnceTheMostTellingBeforeTheAppendix) {
  JointResult& joint = joint_in(result_);
  ResponseCurve flat = joint.responses[0];
  flat.simulated = {24, 26};
  joint.observables.push_back(joint.observables[0]);
  joint.observables[1].name = "tilt";
  flat.observable = 1;
  joint.responses.push_back(flat);
  const std::string page = page_of(study_report(result_));
  const std::size_t appendix = page.find("id=\"appendix\"");
  EXPECT_LT(page.find("id=\"chart-response_drop_particle_wall_restitution\""), appendix);
  const std::size_t other = page.find("id=\"chart-response_tilt_particle_wall_restitution\"");
  EXPECT_NE(other, std::string::npos);
  EXPECT_GT(other, appendix);
}

TEST_F(StudyReport, PlusMinusIsTheHalfWidthOfThe95PercentInterval) {
  const Report report = study_report(result_);
  EXPECT_THAT(page_of(report), Not(HasSubstr("± sd")));
  // Six readings of sd 1: 2.57 times .414 (Student) and 1.96 times the common .28. Three checks:
  // 4.30 times .3. The fit: 1.96 times .2.
  EXPECT_THAT(table_in(report, "agreement.csv"),
              HasSubstr("rebound height [mm],25,1.19795,25.1,0.391993,25.4,1.2908,"));
}

TEST_F(StudyReport, ShowsNothingThatNoBenchCanRead) {
  JointResult& joint = joint_in(result_);
  joint.observables[0].reachable = {-36, 80};
  joint.responses[0].simulated = {-36, 80};
  joint.surfaces[0].simulated = {{-36, 80}, {2, 81}};
  joint.runs[0].readings["value"] = -36;
  joint.observables[0].verification->difference = {1, 2};
  for (const CsvFile& file : study_report(result_).tables) {
    if (file.name.starts_with("terms") || file.name.starts_with("corr")) continue;
    EXPECT_THAT(file.text, Not(HasSubstr("-36"))) << file.name;
  }
  EXPECT_THAT(table_in(study_report(result_), "reach.csv"), HasSubstr(",25,0,80\n"));
}

TEST_F(StudyReport, SaysPhotographOnlyWhereThereAreSome) {
  const std::string without = page_of(study_report(result_));
  EXPECT_THAT(without, Not(HasSubstr("hotograph")));
  const std::string with = page_of(study_report(
      result_, {{.file = "/nowhere/heap.jpg", .status = "ok", .angle_deg = 23.1, .reason = {}}}));
  EXPECT_THAT(with, HasSubstr("was measured in photographs and in silhouettes"));
}

TEST_F(StudyReport, WithoutHeapsSaysNothingOfThem) {
  result_.provenance.model->stiffness_factor = {{"drop", 1}};
  EXPECT_THAT(page_of(study_report(result_)),
              AllOf(Not(HasSubstr("id=\"heaps\"")), Not(HasSubstr("angle of repose")),
                    Not(HasSubstr("heap.vtp")), Not(HasSubstr("A heap"))));
}

TEST_F(StudyReport, IsOneFileThatFetchesNothing) {
  const std::string page = page_of(study_report(result_));
  EXPECT_THAT(page, HasSubstr("default-src 'none'"));
  EXPECT_THAT(page, Not(HasSubstr("src=\"http")));
  EXPECT_THAT(page, Not(HasSubstr("href=\"http")));
}

TEST_F(StudyReport, NeedsNoFolder) {
  write_result(result_);
  const Report of_folder = made();
  const Report alone = study_report(result_);
  EXPECT_EQ(alone.html, of_folder.html);
  EXPECT_EQ(alone.tables.size(), of_folder.tables.size());
}

TEST_F(StudyReport, SameFolderSameBytes) {
  write_result(result_);
  EXPECT_EQ(made().html, made().html);
}

TEST_F(StudyReport, CurvesHaveRunsFitAndMeasuredValue) {
  joint_in(result_).responses[0].uncertainty[1] = std::nan("");
  const std::string csv =
      table_in(study_report(result_), "response_drop_particle_wall_restitution.csv");
  EXPECT_THAT(csv, HasSubstr("simulated runs,0.2,7,,\n"));
  EXPECT_THAT(csv, HasSubstr("fit,0.1,1,,\n"));
  EXPECT_THAT(csv, HasSubstr("95 % interval of the fit,0.1,,0.804004,1.196\n"));
  EXPECT_THAT(csv, HasSubstr("95 % interval of the fit,0.9,,,\n"));  // its uncertainty is unknown
  EXPECT_THAT(csv, HasSubstr("\"measured, 95 %\",0.1,25,24.02,25.98\n"));
  EXPECT_THAT(csv, HasSubstr("best fit,0.4,25.1,0.35,0.45\n"));
}

TEST_F(StudyReport, SurfacesHaveTheRidgeOfSolutions) {
  // 25 lies 24/79 of the way from 1 to 80 and 23/79 from 2 to 81.
  const std::string csv =
      table_in(study_report(result_),
               "surface_drop_particle_wall_restitution_particle_wall_sliding_friction.csv");
  EXPECT_THAT(csv, HasSubstr("as measured: 25 mm,0.343038,0.1,25\n"));
  EXPECT_THAT(csv, HasSubstr("as measured: 25 mm,0.332911,0.8,25\n"));
}

TEST_F(StudyReport, NamesCannotInjectMarkup) {
  const std::string hostile = "\"'><script>alert(1)</script><img src=x onerror=alert(2)>";
  result_.provenance.study.file = hostile;
  joint_in(result_).observables[0].name = "drop</script><script>alert(3)</script>";
  joint_in(result_).parameters[0].name = hostile;
  joint_in(result_).regressions[0].observable = hostile;
  const Report report = study_report(result_);
  EXPECT_THAT(page_of(report), Not(HasSubstr("<script>")));
  EXPECT_THAT(page_of(report), Not(HasSubstr("<img src=x")));
  EXPECT_THAT(page_of(report), Not(HasSubstr("<b>bold")));
  EXPECT_THAT(page_of(report), HasSubstr("&lt;script&gt;"));
  EXPECT_THAT(data_of(report).substr(1), Not(HasSubstr("<")));
  for (const CsvFile& file : report.tables) {
    EXPECT_THAT(file.name, Not(::testing::ContainsRegex("[^A-Za-z0-9_.]")));
  }
}

TEST_F(StudyReport, LongNamesAreShortened) {
  result_.provenance.study.file = std::string(10'000, 'n');
  joint_in(result_).parameters[0].name = std::string(10'000, 'n');
  const Report report = study_report(result_);
  const std::string much(300, 'n');
  EXPECT_EQ(page_of(report).find(much), std::string::npos);
  EXPECT_EQ(data_of(report).find(much), std::string::npos);
}

TEST_F(StudyReport, TablesOfAlikeNamesHaveFilesOfTheirOwn) {
  const std::string longest(10'000, 'n');
  JointResult& joint = joint_in(result_);
  joint.parameters[0].name = longest + "a";
  joint.parameters[1].name = longest + "b";
  joint.parameters[1].profile = {{.1, 2}};
  const Report report = study_report(result_);
  std::vector<std::string> names;
  for (const CsvFile& file : report.tables) names.push_back(file.name);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
  const std::string stem = "profile_" + longest.substr(0, 92);
  EXPECT_THAT(table_in(report, stem + ".csv"), Not(HasSubstr("no ")));
  EXPECT_THAT(table_in(report, stem + "_2.csv"), Not(HasSubstr("no ")));
}

TEST_F(StudyReport, UnfinishedStudiesSaySoAndHowToGoOn) {
  folder_.write("study.json", replaced(kRecord, "\"name\":", "\"mixed\": false, \"name\":"));
  std::filesystem::create_directory(folder_.path() / "runs");
  for (const auto& [number, value] : {std::pair("2", 7.0), {"5", 30.0}}) {
    RunResult run;
    run.simulated = replaced(kDrop, "%d", number);
    run.value = value;
    run.readings = {{"sd_mm", std::nullopt}};
    run.timestep_s = 1e-6;
    folder_.write(std::string("runs/") + number + ".json", text_of(run));
  }
  folder_.write("runs/damaged.json", std::string("{\"simulated\": "));
  const Report report = made();
  EXPECT_THAT(page_of(report), HasSubstr("Unfinished: this study has no result yet"));
  EXPECT_THAT(page_of(report), HasSubstr("2 simulations are complete"));
  EXPECT_THAT(
      page_of(report),
      HasSubstr("repose calibrate nuts.toml --budget standard --fidelity full --set a.b=1"));
  EXPECT_EQ(table_in(report, "simulations.csv"),
            "experiment,simulations,without a reading\ndrop,2,0\n");
  EXPECT_THAT(table_in(report, "response_drop_particle_wall_restitution.csv"),
              AllOf(HasSubstr("simulated runs,0.2,7,,\n"), HasSubstr("simulated runs,0.5,30,,\n")));
}

TEST_F(StudyReport, UnfinishedStudiesTellRunsOfLargerGrains) {
  folder_.write("study.json", std::string(kRecord));
  std::filesystem::create_directory(folder_.path() / "runs");
  for (const auto& [number, grain_size] : {std::pair("2", ""), {"5", "\"grain_size\": 2.5,"}}) {
    RunResult run;
    run.simulated = replaced(replaced(kDrop, "%d", number), "\"drop\",",
                             "\"drop\", " + std::string(grain_size));
    run.value = 7;
    run.readings = {{"sd_mm", std::nullopt}};
    run.timestep_s = 1e-6;
    folder_.write(fmt::format("runs/{}.json", number), text_of(run));
  }
  EXPECT_THAT(table_in(made(), "response_drop_particle_wall_restitution.csv"),
              AllOf(HasSubstr("simulated runs,0.2,7,,\n"),
                    HasSubstr("coarse runs (larger grains),0.5,7,,\n")));
}

TEST_F(StudyReport, ResultsOfAnotherStudyAreNotShown) {
  folder_.write("study.json", replaced(kRecord, "abc", "changed"));
  write_result(result_);
  EXPECT_THAT(page_of(made()), AllOf(HasSubstr("Unfinished"), HasSubstr("is from another study"),
                                     Not(HasSubstr("coefficients are determined"))));
}

TEST_F(StudyReport, PicturesThatAreGoneAreSaid) {
  const Report report = study_report(
      result_, {{.file = "/nowhere/<b>heap.jpg", .status = "ok", .angle_deg = 23.1, .reason = {}}});
  EXPECT_THAT(page_of(report), HasSubstr("The photograph &lt;b&gt;heap.jpg cannot be shown"));
}

TEST_F(StudyReport, ThePublishedMethodHasItsOwnChapters) {
  const Report report = study_report(test::published_result());
  EXPECT_THAT(page_of(report), AllOf(HasSubstr("point estimates without intervals"),
                                     HasSubstr("Steepest ascent"), HasSubstr("a ridge")));
  const std::string csv = table_in(report, "sweep_particle_wall_restitution.csv");
  EXPECT_THAT(csv, HasSubstr("simulated runs,2,4,,\n"));
  EXPECT_THAT(csv, HasSubstr("parabola,1.5,2.25,,\n"));
}

TEST_F(StudyReport, FoldersWithoutAStudyAreRefused) {
  EXPECT_THAT([this] { made(); }, ThrowsMessage<base::InputError>(AllOf(
                                      HasSubstr("there is no study in it"), HasSubstr("Fix: "))));
  EXPECT_THAT([this] { study_report(folder_.path() / "none"); },
              ThrowsMessage<base::InputError>(HasSubstr("there is no such folder")));
  for (const std::string text : {"", "[1]", "{\"method\": "}) {
    folder_.write("result.json", text);
    EXPECT_THAT([this] { made(); },
                ThrowsMessage<base::InputError>(
                    AllOf(HasSubstr("result.json: is not a result"), HasSubstr("Fix: "))));
  }
}

}  // namespace
}  // namespace repose::calibrate::report
