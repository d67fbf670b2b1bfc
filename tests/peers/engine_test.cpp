// The studies in samples/engines: one run of each whose program is installed.
#include "calibrate/engine/engine.h"

#include <filesystem>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "calibrate/engine/engine_runs.h"
#include "calibrate/engine/make_runs.h"
#include "calibrate/runs/table_runs.h"
#include "calibrate/runs/table_study.h"
#include "tests/support/places.h"
#include "tests/support/run_program.h"
#include "tests/support/temporary_folder.h"

namespace repose::testing {
namespace {

struct Sample {
  std::string folder;
  std::string program;  ///< with arguments that show whether it is installed
  std::vector<std::string> words;

  friend std::ostream& operator<<(std::ostream& out, const Sample& sample) {
    return out << sample.folder;
  }
};

class SampleEngine : public ::testing::TestWithParam<Sample> {};

TEST_P(SampleEngine, MakesARunWhoseHeapIsMeasured) {
  const TemporaryFolder folder;
  const Sample& sample = GetParam();
  if (run_program(sample.program, folder, sample.words).exit_code != 0) {
    GTEST_SKIP() << sample.program << " is not installed; nothing was run. Fix: apt-get install "
                 << sample.program;
  }
  const auto place = source_folder() / "samples/engines" / sample.folder;
  const calibrate::TableStudy study = calibrate::read_table_study(place / "study.toml");
  calibrate::EngineRuns runs(study, folder.path());
  std::filesystem::create_directories(runs.folder());
  std::vector<double> middle;
  for (const calibrate::Parameter& parameter : study.parameters) {
    middle.push_back((parameter.min + parameter.max) / 2);
  }
  runs.plan({}, {{middle, "the middle"}});
  std::string failure;
  const auto failed = make_runs(runs, *command_engine(study), {0},
                                {.timeout_s = study.engine->timeout_s,
                                 .note = [&](const std::string& text) { failure = text; }});
  EXPECT_EQ(failed, 0U) << failure;
  const calibrate::TableRuns read = calibrate::read_table_runs(study, {runs.file()});
  ASSERT_FALSE(read.runs.empty());
  EXPECT_GT(read.runs.front().readings.at("value"), 10);
  EXPECT_LT(read.runs.front().readings.at("value"), 45);
}

INSTANTIATE_TEST_SUITE_P(
    Samples, SampleEngine,
    ::testing::Values(Sample{"mock", "python3", {"--version"}},
                      Sample{"liggghts", "liggghts", {"-in", "/dev/null", "-log", "none"}},
                      Sample{"yade", "yade", {"--version"}}),
    [](const auto& tested) { return tested.param.folder; });

}  // namespace
}  // namespace repose::testing
