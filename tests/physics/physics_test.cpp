#include <cctype>

#include <gtest/gtest.h>

#include "base/input_error.h"
#include "dem/verify/scene.h"
#include "dem/verify/verify.h"

namespace repose::dem {
namespace {

class Physics : public testing::TestWithParam<std::string> {};

TEST_P(Physics, ComesOutAsExpected) {
  const std::vector<CaseResult> results = run_case(GetParam());
  ASSERT_FALSE(results.empty());
  for (const CaseResult& result : results) {
    EXPECT_TRUE(result.holds) << result.quantity << ": expected " << result.expected
                              << ", measured " << result.measured << ", allowed "
                              << result.tolerance << ", time step " << result.timestep_s << " s ("
                              << result.source << ")";
  }
}

std::string test_name(const testing::TestParamInfo<std::string>& info) {
  std::string name;
  bool starts_word = true;
  for (const char letter : info.param) {
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0) {
      starts_word = true;
      continue;
    }
    name += starts_word ? static_cast<char>(std::toupper(letter)) : letter;
    starts_word = false;
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Verify, Physics, testing::ValuesIn(case_names()), test_name);

TEST(VerifyCases, EachRunsAtTwoTimeSteps) {
  const std::vector<CaseResult> results = run_case("T7 opposite spins");
  ASSERT_EQ(results.size() % 2, 0U);
  const std::size_t half = results.size() / 2;
  for (std::size_t k = 0; k < half; ++k) {
    EXPECT_EQ(results[k].quantity, results[k + half].quantity);
    EXPECT_DOUBLE_EQ(results[k].timestep_s, 2 * results[k + half].timestep_s);
  }
}

TEST(VerifyCases, NumbersOutOfToleranceOrNoNumbersFail) {
  Trial trial({.name = "name", .source = "source", .run = {}}, 1);
  trial.expect("within", 1, 1.1, .11);
  trial.expect("too high", 1, 1.2, .1);
  trial.expect("too low", 1, .8, .1);
  trial.expect("no number", 1, std::nan(""), .1);
  ASSERT_EQ(trial.results().size(), 4U);
  EXPECT_TRUE(trial.results()[0].holds);
  EXPECT_FALSE(trial.results()[1].holds);
  EXPECT_FALSE(trial.results()[2].holds);
  EXPECT_FALSE(trial.results()[3].holds);
}

TEST(VerifyCases, UnknownNameIsRefused) {
  EXPECT_THROW(run_case("no such case"), base::InputError);
}

}  // namespace
}  // namespace repose::dem
