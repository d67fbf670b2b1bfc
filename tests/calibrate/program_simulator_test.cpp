#include "calibrate/simulators/program_simulator.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "dem/experiment/drop.h"
#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

/// A shell script instead of a simulator: its reading is the number in reading.txt.
class Scripted : public ProgramSimulator {
 public:
  explicit Scripted(std::string script, std::optional<double> timeout_s = {})
      : ProgramSimulator(timeout_s), script_(std::move(script)) {}

  std::string title() const override { return "the script"; }
  std::vector<base::Fault> refusals(const RunSpec&) const override {
    if (script_.empty()) return {{.subject = "script", .value = "is empty", .fix = "write one."}};
    return {};
  }

 protected:
  void prepare(const RunSpec&, std::uint64_t seed, const fs::path& folder) const override {
    base::write_whole_file(folder / "seed.txt", std::to_string(seed));
  }
  base::ProcessStart start(const RunSpec&, std::uint64_t, const fs::path&) const override {
    return {.words = {"sh", "-c", script_}, .folder = {}, .output = {}};
  }
  dem::Repeat read_back(const RunSpec&, std::uint64_t, const fs::path& folder) const override {
    std::ifstream file(folder / "reading.txt");
    double value = 0;
    if (!(file >> value)) throw dem::NoMeasurement("it read nothing");
    dem::Repeat repeat;
    repeat.value = value;
    return repeat;
  }

 private:
  std::string script_;
};

class ProgramSimulatorTest : public ::testing::Test {
 protected:
  dem::Repeat run(const Simulator& simulator, bool goes_on = true) const {
    const dem::RunRecord record;
    return simulator.run({.spec = spec_,
                          .seed = 7,
                          .folder = work_,
                          .goes_on = [goes_on](double) { return goes_on; },
                          .record = record});
  }

  TemporaryFolder folder_;
  fs::path work_ = folder_.path() / "work";
  RunSpec spec_{.protocol = dem::DropProtocol{}, .model = {}, .grain_fingerprint = {}};
};

TEST_F(ProgramSimulatorTest, PreparesRunsReadsBackAndClearsUp) {
  const dem::Repeat repeat = run(Scripted("cp seed.txt reading.txt"));
  EXPECT_EQ(repeat.value, 7);
  EXPECT_EQ(repeat.seed, 7U);
  EXPECT_FALSE(fs::exists(work_));
}

TEST_F(ProgramSimulatorTest, BeginsInAnEmptyFolder) {
  fs::create_directories(work_);
  std::ofstream(work_ / "reading.txt") << 99;
  EXPECT_EQ(error_of<dem::NoMeasurement>([&] { run(Scripted("true")); }), "it read nothing");
}

TEST_F(ProgramSimulatorTest, WorksInATemporaryFolderWhereThereIsNone) {
  work_.clear();
  EXPECT_EQ(run(Scripted("cp seed.txt reading.txt")).value, 7);
}

TEST_F(ProgramSimulatorTest, FailureSaysHowItEndedAndWhatItPrintedAndKeepsItsFolder) {
  EXPECT_THAT(error_of([&] { run(Scripted("echo first; echo the last line; exit 3")); }),
              AllOf(HasSubstr("work: the script failed: exit code 3"), HasSubstr("output.txt"),
                    HasSubstr("the last line"), HasSubstr("Fix:")));
  EXPECT_TRUE(fs::exists(work_ / "seed.txt"));
  // The next attempt starts afresh.
  EXPECT_EQ(run(Scripted("cp seed.txt reading.txt")).value, 7);
}

TEST_F(ProgramSimulatorTest, FailureWithoutAWordIsSaidToBeThat) {
  EXPECT_THAT(error_of([&] { run(Scripted("kill -SEGV $$")); }),
              AllOf(HasSubstr("signal 11"), HasSubstr("it printed nothing")));
}

TEST_F(ProgramSimulatorTest, EndsAProgramThatTakesTooLong) {
  EXPECT_THAT(error_of([&] { run(Scripted("sleep 60", .05)); }),
              HasSubstr("took more than timeout_s = 0.05 s"));
}

TEST_F(ProgramSimulatorTest, InterruptedEndsTheProgramAndLeavesNothing) {
  EXPECT_THROW(run(Scripted("sleep 60"), false), dem::Interrupted);
  EXPECT_FALSE(fs::exists(work_));
}

TEST_F(ProgramSimulatorTest, RefusesBeforeItStarts) {
  EXPECT_EQ(error_of([&] { run(Scripted("")); }), "script is empty. Fix: write one.");
  EXPECT_FALSE(fs::exists(work_));
}

TEST(PrintedBy, IsWhatAProgramPrintsAndNothingOfOneThatIsNotThereOrFails) {
  EXPECT_EQ(printed_by({"echo", "hello"}), "hello\n");
  EXPECT_EQ(printed_by({"no_such_program_of_anybody"}), std::nullopt);
  EXPECT_EQ(printed_by({"false"}), std::nullopt);
}

}  // namespace
}  // namespace repose::calibrate
