#include "calibrate/study/study_record.h"

#include <cmath>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/tilt.h"
#include "dem/study/grain_source.h"
#include "tests/calibrate/sphere_study.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using repose::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;

class StudyRecordTest : public ::testing::Test {
 protected:
  StudyRecordTest() {
    std::string text = test::kSphereStudy;
    const std::string values = "values = [20.1, 21.3, 20.7, 19.8]";
    text.replace(text.find(values), values.size(), "readings = \"tilts.csv\"");
    folder_.write("study.toml", text + R"([experiment.heap]
measured = { pictures = ["a.jpg", "b.jpg"] }
stiffness_factor = 0.5
)");
    folder_.write("tilts.csv", std::string("angle_deg\n20\n21\n"));
    folder_.write("a.jpg", std::string("not looked at here"));
    folder_.write("b.jpg", std::string("nor this"));
    std::filesystem::create_directory(saved());
  }

  std::filesystem::path saved() const { return folder_.path() / "kept"; }

  StudyRecord record() const {
    const std::vector<std::string> settings = {"particle.density_kg_m3 = 700"};
    StudyRecord record;
    record.budget = budget_named("quick");
    record.measurement.pictures = {
        {.file = "/photos/a.jpg", .status = "ok", .angle_deg = 24.125, .reason = {}},
        {.file = "/photos/b.jpg", .status = "refused", .angle_deg = {}, .reason = "no \"heap\""}};
    record.measurement.films = {{.experiment = "drop",
                                 .file = "/films/a.mp4",
                                 .status = "flagged",
                                 .value = 88.5,
                                 .uncertainty = 3.5,
                                 .reason = "ends early"}};
    record.study = dem::read_study(folder_.path() / "study.toml", settings);
    record.measurement.sheets = read_sheets(record.study, NoRows::refused);
    record.grain = dem::build_grain(record.study.grain);
    record.study = as_measured(record.study, record.grain.shape, record.measurement);
    record.settings = settings;
    record.method = "joint";
    return record;
  }

  TemporaryFolder folder_;
};

TEST_F(StudyRecordTest, ComesBackWhenTheStudyIsGone) {
  const StudyRecord written = record();
  write_study_record(saved(), written);
  for (const char* file : {"study.toml", "tilts.csv", "a.jpg", "b.jpg"}) {
    std::filesystem::remove(folder_.path() / file);
  }
  const StudyRecord read = read_study_record(saved());
  EXPECT_EQ(read.study.hash, written.study.hash);
  EXPECT_EQ(read.study.file, "study.toml");
  EXPECT_EQ(read.study.model.grain_material.density_kg_m3, 700);
  EXPECT_EQ(
      dem::model_for(read.study, dem::experiment_of<dem::HeapProtocol>()).stiffness_factor,
      dem::model_for(written.study, dem::experiment_of<dem::HeapProtocol>()).stiffness_factor);
  EXPECT_THAT(dem::measured_in(read.study, dem::experiment_of<dem::HeapProtocol>()).values,
              ElementsAre(24.125));
  EXPECT_THAT(dem::measured_in(read.study, dem::experiment_of<dem::TiltProtocol>()).values,
              ElementsAre(20, 21));
  EXPECT_EQ(read.measurement.sheets.at(0).rows, 2);
  EXPECT_EQ(read.budget.name, "quick");
  EXPECT_THAT(read.grain.shape.spheres, SizeIs(1));
  ASSERT_THAT(read.measurement.pictures, SizeIs(2));
  EXPECT_EQ(read.measurement.pictures[0].angle_deg, 24.125);
  EXPECT_EQ(read.measurement.pictures[1].reason, "no \"heap\"");
  ASSERT_THAT(read.measurement.films, SizeIs(1));
  EXPECT_EQ(read.measurement.films[0].value, 88.5);
  EXPECT_EQ(read.measurement.films[0].uncertainty, 3.5);
  EXPECT_EQ(problem_of(read.study, read.grain, read.budget).problem.observables.size(), 3U);
}

TEST_F(StudyRecordTest, PicturesOfOneHeapCountOnceAndShareTheirCamera) {
  StudyRecord written = record();
  const auto picture = [](const char* name, const char* heap, double angle_deg) {
    return PictureReading{.file = name,
                          .status = "ok",
                          .angle_deg = angle_deg,
                          .reason = {},
                          .own_deg = 1.96,
                          .camera_deg = .98,
                          .heap = heap};
  };
  written.measurement.pictures = {picture("a1", "a", 23), picture("a2", "a", 25),
                                  picture("b1", "", 26)};
  write_study_record(saved(), written);
  const StudyRecord read = read_study_record(saved());
  const dem::Measured heap = dem::measured_in(read.study, dem::experiment_of<dem::HeapProtocol>());
  EXPECT_THAT(heap.values, ElementsAre(24, 26));
  ASSERT_THAT(heap.systematic, SizeIs(1));
  EXPECT_EQ(heap.systematic[0].name, "camera");
  EXPECT_NEAR(heap.systematic[0].sd, .5, 1e-3);
  EXPECT_NEAR(*heap.value_uncertainty, std::sqrt((1 + .5) / 2), 1e-3);
  const StudyProblem made = problem_of(read.study, read.grain, read.budget);
  EXPECT_THAT(made.notes, ::testing::Contains(HasSubstr("3 pictures of 2 heaps")));
  const Observable& angle = made.problem.observables.back();
  EXPECT_EQ(angle.n, 2);
  EXPECT_NEAR(with_systematic(angle, standard_uncertainty(angle)),
              std::hypot(std::sqrt(2) / std::sqrt(2), .5), 1e-3);
}

TEST_F(StudyRecordTest, OtherFoldersAreRefused) {
  EXPECT_THAT([this] { read_study_record(folder_.path()); },
              ThrowsMessage<base::InputError>(HasSubstr("is not the folder of a study")));
  EXPECT_THAT([this] { read_study_record(saved() / "none"); },
              ThrowsMessage<base::InputError>(HasSubstr("is not the folder of a study")));
}

TEST_F(StudyRecordTest, DamagedRecordsAreNamed) {
  write_study_record(saved(), record());
  for (const std::string text : {"", "{\"study\": 3}", "[[[["}) {
    folder_.write("kept/study.json", text);
    EXPECT_THAT([this] { read_study_record(saved()); },
                ThrowsMessage<base::InputError>(
                    AllOf(HasSubstr("study.json: damaged"), HasSubstr("Fix: "))));
  }
}

}  // namespace
}  // namespace repose::calibrate
