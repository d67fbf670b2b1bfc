#include <array>
#include <new>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "cli/program.h"

namespace repose::cli {
namespace {

constexpr std::array<base::FieldName, 1> kFields{{{"camera pitch", "--pitch-deg"}}};

struct CarriedOut {
  ExitCode code;
  std::string said;
};

CarriedOut carried_out(const std::function<ExitCode()>& work) {
  ::testing::internal::CaptureStderr();
  const ExitCode code = carry_out(work, "measure", kFields);
  return {code, ::testing::internal::GetCapturedStderr()};
}

TEST(CarryOut, GivesWhatTheWorkGives) {
  const CarriedOut done = carried_out([] { return ExitCode::done; });
  EXPECT_EQ(done.code, ExitCode::done);
  EXPECT_EQ(done.said, "");
}

TEST(CarryOut, SaysAllFaultsOfAnInputWithTheOptionsOfTheirFields) {
  const CarriedOut refused = carried_out([]() -> ExitCode {
    base::Faults faults;
    faults.add({.subject = "camera pitch", .value = "= 45 degrees", .fix = "at most 30."});
    faults.add({.where = "a.jpg",
                .value = "camera pitch and base differ",
                .fix = "give the " + base::field("camera pitch") + '.'});
    faults.throw_if_any();
    return ExitCode::done;
  });
  EXPECT_EQ(refused.code, ExitCode::bad_input);
  EXPECT_EQ(refused.said,
            "repose: camera pitch (--pitch-deg) = 45 degrees. Fix: at most 30.\n"
            "repose: a.jpg: camera pitch and base differ. Fix: give the camera pitch "
            "(--pitch-deg).\n");
}

TEST(CarryOut, AnArgumentThatALibraryRefusesIsAnInternalError) {
  for (const bool is_stod : {true, false}) {
    const CarriedOut failed = carried_out([&]() -> ExitCode {
      if (is_stod) return static_cast<ExitCode>(std::stod("none"));
      throw std::invalid_argument("camera pitch is no number");
    });
    EXPECT_EQ(failed.code, ExitCode::internal_error);
    EXPECT_THAT(failed.said, ::testing::AllOf(::testing::StartsWith("repose: internal error: "),
                                              ::testing::HasSubstr("Fix: please report it."),
                                              ::testing::Not(::testing::HasSubstr("--pitch-deg"))));
  }
}

TEST(CarryOut, TooLittleMemoryIsSaidOfTheInput) {
  const CarriedOut failed = carried_out([]() -> ExitCode { throw std::bad_alloc(); });
  EXPECT_EQ(failed.code, ExitCode::bad_input);
  EXPECT_THAT(failed.said, ::testing::HasSubstr("repose: measure"));
}

}  // namespace
}  // namespace repose::cli
