#include <atomic>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>

#include <gmock/gmock.h>

#include "base/atomic_file.h"
#include "calibrate/report/study_report.h"
#include "calibrate/result/result_text.h"
#include "calibrate/run/run_study.h"
#include "tests/calibrate/sphere_study.h"
#include "tests/support/temporary_folder.h"

namespace repose::calibrate {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class ProvisionalResult : public ::testing::Test {
 protected:
  ProvisionalResult() { folder_.write("study.toml", test::kSphereStudy); }

  std::filesystem::path in(const std::string& name) const { return folder_.path() / name; }
  std::string result_in(const std::string& name) const {
    return base::read_whole_file(in(name) / kResultFile);
  }

  /// Stops after `rounds` complete rounds; 0 runs to the end.
  std::optional<StudyResult> calibrate(const std::string& name, std::size_t rounds) const {
    std::atomic<bool> is_interrupted = false;
    const StudyWatch watch{.report =
                               [&](const StudyProgress& progress) {
                                 if (rounds > 0 && progress.rounds.size() >= rounds) {
                                   is_interrupted = true;
                                 }
                               },
                           .note = {},
                           .is_interrupted = &is_interrupted};
    return run_study({.study = in("study.toml"), .threads = 2, .folder = in(name)}, watch);
  }

  repose::testing::TemporaryFolder folder_;
};

TEST_F(ProvisionalResult, IsWhatAnInterruptedStudyLeavesAndGoneAtItsEnd) {
  ASSERT_FALSE(calibrate("stopped", 1));
  const auto left = read_result(in("stopped"));
  ASSERT_TRUE(left && is_provisional(*left));
  const auto& joint = std::get<JointResult>(left->found);
  EXPECT_THAT(joint.provisional, HasSubstr("interrupted in"));
  EXPECT_FALSE(joint.verdict) << "nothing was checked";
  ASSERT_EQ(joint.parameters.size(), 2U);
  for (const ResultParameter& parameter : joint.parameters) {
    EXPECT_LE(parameter.interval.low, parameter.value);
    EXPECT_GE(parameter.interval.high, parameter.value);
  }
  EXPECT_THAT(summary_sentences(joint).front(), StartsWith("PROVISIONAL"));
  EXPECT_THAT(report::study_report(in("stopped")).html, HasSubstr("Provisional: interrupted in"));
  EXPECT_EQ(to_json(result_from_json(result_in("stopped"), "it")), result_in("stopped"));

  ASSERT_TRUE(calibrate("stopped", 0));
  ASSERT_TRUE(calibrate("whole", 0));
  EXPECT_EQ(result_in("stopped"), result_in("whole")) << "the same as if never interrupted";
  EXPECT_FALSE(is_provisional(*read_result(in("stopped"))));
  EXPECT_THAT(report::study_report(in("stopped")).html, Not(HasSubstr("Provisional")));
}

TEST_F(ProvisionalResult, NeverTakesThePlaceOfAFinalOne) {
  ASSERT_TRUE(calibrate("done", 0));
  const std::string final = result_in("done");
  std::filesystem::remove_all(in("done") / "runs");
  ASSERT_FALSE(calibrate("done", 1));
  EXPECT_EQ(result_in("done"), final);
}

}  // namespace
}  // namespace repose::calibrate
