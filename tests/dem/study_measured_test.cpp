// What a study states about measurements: readings, additional readings, tolerances, sheets.

#include <string>

#include <gmock/gmock.h>

#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/tilt.h"
#include "dem/study/study.h"
#include "tests/dem/study_file.h"

namespace repose::dem {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

TEST_F(StudyFile, OtherReadingsMayBeMeasuredToo) {
  const std::string heap = kStudy + "[experiment.heap]\n[experiment.heap.also_measured]\n";
  const Study study = read(heap + "base_radius_mm = { mean = 120, sd = 4, n = 10 }\n");
  ASSERT_EQ(measured_in(study, experiment_of<HeapProtocol>()).also.size(), 1U);
  const MeasuredReading reading = measured_in(study, experiment_of<HeapProtocol>()).also.front();
  EXPECT_EQ(reading.name, "base_radius_mm");
  EXPECT_EQ(reading.mean, 120);
  EXPECT_EQ(reading.sd, 4);
  EXPECT_EQ(reading.count, 10);
  EXPECT_THAT(errors(heap + "width_mm = { mean = 1 }\n"), HasSubstr("width_mm"));
}

TEST_F(StudyFile, SaysHowFarBenchAndSimulationMayBeApart) {
  const std::string tilt =
      kStudy + "[experiment.tilt]\nmeasured = { values = [9, 10], tolerance = ";
  EXPECT_EQ(measured_in(read(tilt + "1.5 }\n"), experiment_of<TiltProtocol>()).tolerance, 1.5);
  EXPECT_FALSE(measured_in(read(kStudy), experiment_of<DropProtocol>()).tolerance) << "unless told";
  EXPECT_THAT(errors(tilt + "0 }\n"), HasSubstr("experiment.tilt.measured.tolerance = 0"));
  const std::string heap = kStudy + "[experiment.heap]\n[experiment.heap.also_measured]\n";
  const Study study = read(heap + "height_mm = { mean = 40, tolerance = 3 }\n");
  EXPECT_EQ(measured_in(study, experiment_of<HeapProtocol>()).also.front().tolerance, 3);
}

TEST_F(StudyFile, SaysWhatAllReadingsShare) {
  const std::string tilt = kStudy + "[experiment.tilt]\nmeasured = { values = [9, 10], bias_sd = ";
  const Measured measured = measured_in(read(tilt + "0.3 }\n"), experiment_of<TiltProtocol>());
  ASSERT_EQ(measured.systematic.size(), 1U);
  EXPECT_EQ(measured.systematic[0].name, "bias_sd");
  EXPECT_EQ(measured.systematic[0].sd, .3);
  EXPECT_TRUE(measured_in(read(tilt + "0 }\n"), experiment_of<TiltProtocol>()).systematic.empty());
  EXPECT_THAT(errors(tilt + "-1 }\n"), HasSubstr("experiment.tilt.measured.bias_sd = -1"));
  EXPECT_THAT(errors(tilt + "nan }\n"), HasSubstr("experiment.tilt.measured.bias_sd = nan"));
  const std::string heap = kStudy + "[experiment.heap]\n[experiment.heap.also_measured]\n";
  const Study study = read(heap + "height_mm = { mean = 40, bias_sd = 0.5 }\n");
  ASSERT_EQ(measured_in(study, experiment_of<HeapProtocol>()).also.front().systematic.size(), 1U);
  EXPECT_EQ(measured_in(study, experiment_of<HeapProtocol>()).also.front().systematic[0].sd, .5);
}

TEST_F(StudyFile, NamesScansOfHeaps) {
  const std::string heap = kStudy + "[experiment.heap]\nmeasured = { scans = [\"s*.ply\"]";
  const Measured measured = measured_in(read(heap + " }\n"), experiment_of<HeapProtocol>());
  ASSERT_EQ(measured.scans.size(), 1U);
  EXPECT_TRUE(measured.is_seen() && measured.pictures.empty());
  EXPECT_THAT(errors(heap + ", mean = 24 }\n"), HasSubstr("more than one kind of values"));
}

TEST_F(StudyFile, GroupsPicturesOfOneHeap) {
  const std::string heap = kStudy + "[experiment.heap]\nmeasured = { pictures = ";
  const Measured measured = measured_in(
      read(heap + R"([{ heap = "a", files = ["a*.jpg", "x*.jpg"] }, "b*.jpg"] })" + "\n"),
      experiment_of<HeapProtocol>());
  ASSERT_EQ(measured.pictures.size(), 3U);
  EXPECT_EQ(measured.pictures[1].filename(), "x*.jpg");
  EXPECT_THAT(measured.picture_heaps, ::testing::ElementsAre("a", "a", ""));
  EXPECT_TRUE(measured_in(read(heap + "[\"b*.jpg\"] }\n"), experiment_of<HeapProtocol>())
                  .picture_heaps.empty());
  EXPECT_THAT(
      errors(heap +
             R"([{ heap = "a", files = ["a*.jpg"] }, { heap = "a", files = ["b*.jpg"] }] })"),
      HasSubstr("each heap once"));
  EXPECT_THAT(errors(heap + R"([{ heap = "a" }] })"), HasSubstr("files is missing"));
  EXPECT_THAT(errors(heap + R"([{ files = ["a*.jpg"] }] })"), HasSubstr("heap is missing"));
  EXPECT_THAT(errors(heap + R"([{ heap = "a", files = ["a*.jpg"], n = 3 }] })"),
              HasSubstr("no such key"));
  EXPECT_THAT(errors(heap + R"([{ heap = "a", files = ["a*.jpg"] }, 3] })"),
              HasSubstr("texts in quotes and groups"));
}

TEST_F(StudyFile, SaysByWhichDefinitionAHeapWasMeasured) {
  const std::string heap = kStudy + "[experiment.heap]\n";
  const auto definition = [](const Study& study) {
    return study.experiments.at(experiment_of<HeapProtocol>()).definition;
  };
  EXPECT_EQ(definition(read(heap)), "") << "not said";
  EXPECT_EQ(definition(read(heap + "definition = \"whole_flank\"\n")), "whole_flank");
  EXPECT_EQ(definition(read(heap + "definition = \"flank_20_80\"\n")), "flank_20_80");
  EXPECT_THAT(errors(heap + "definition = \"whole_flanks\"\n"),
              AllOf(HasSubstr("experiment.heap.definition is one of flank_20_80, height_over_base"),
                    HasSubstr("did you mean \"whole_flank\"?")));
  EXPECT_THAT(errors(kStudy, {"experiment.drop.definition = \"whole_flank\""}),
              HasSubstr("definition"))
      << "a drop is no angle";
}

TEST_F(StudyFile, MeasuredValuesAreGivenInOneWay) {
  const std::string key = "experiment.drop.measured = ";
  EXPECT_THAT(errors(kStudy, {key + "{ values = [9], mean = 9 }"}),
              HasSubstr("more than one kind"));
  EXPECT_THAT(errors(kStudy, {key + "{ }"}), HasSubstr("has no values"));
  EXPECT_THAT(errors(kStudy, {key + "{ values = [9], sd = 1 }"}), HasSubstr("belong to a mean"));
  EXPECT_THAT(errors(kStudy, {key + "{ mean = 9, sd = -1, n = 0 }"}),
              AllOf(HasSubstr("measured.sd = -1"), HasSubstr("measured.n = 0")));
  EXPECT_THAT(errors(kStudy, {key + "{ pictures = [\"study.toml\"] }"}),
              HasSubstr("only this is measured in pictures: heap, and not drop"));
  EXPECT_THAT(errors(kStudy, {"experiment.fill.measured = { videos = [\"study.toml\"] }"}),
              HasSubstr("only this is read off films: drop, tilt, roll, heap, and not fill"));
  EXPECT_THAT(errors(kStudy, {key + "{ videos = [\"study.toml\"], values = [9] }"}),
              HasSubstr("more than one kind"));
  EXPECT_THAT(errors(kStudy, {key + "{ videos = [\"none.mp4\"] }"}),
              HasSubstr("a file that exists, and there is no none.mp4"));
  EXPECT_THAT(errors(kStudy, {key + "9.42"}), HasSubstr("a section with keys"));
  EXPECT_THAT(errors(kStudy, {key + "{ values = [9], readings = \"study.toml\" }"}),
              HasSubstr("more than one kind"));
  EXPECT_THAT(errors(kStudy, {key + "{ readings = \"none.csv\" }"}),
              HasSubstr("a file that exists, and there is no none.csv"));
}

TEST_F(StudyFile, ASheetOfReadingsBelongsToTheStudy) {
  const std::string text = kStudy + "measured = { readings = \"drops.csv\", tolerance = 2 }\n";
  folder_.write("drops.csv", std::string("drop_mm,rebound_mm\n500,9\n"));
  const Study study = read(text);
  EXPECT_EQ(measured_in(study, experiment_of<DropProtocol>()).sheet, folder_.path() / "drops.csv");
  EXPECT_EQ(measured_in(study, experiment_of<DropProtocol>()).tolerance, 2);
  EXPECT_THAT(files_of(study), Contains(folder_.path() / "drops.csv"));
  EXPECT_EQ(read(text).hash, study.hash);
  folder_.write("drops.csv", std::string("drop_mm,rebound_mm\n500,9\n500,10\n"));
  EXPECT_NE(read(text).hash, study.hash) << "other readings are another study";
}

}  // namespace
}  // namespace repose::dem
