#include "calibrate/statistics/summary.h"

#include <array>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>

#include "base/input_error.h"

namespace repose::calibrate {
namespace {

TEST(Summary, MatchTheHandComputedExample) {
  // Sum 40, mean 5; squares of the differences 9 1 1 1 0 0 4 16, sum 32; 32 / 7.
  const Summary repeats = summarise(std::array{2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0});
  EXPECT_EQ(repeats.n, 8);
  EXPECT_DOUBLE_EQ(repeats.mean, 5);
  ASSERT_TRUE(repeats.sd && repeats.mean_uncertainty);
  EXPECT_DOUBLE_EQ(*repeats.sd, std::sqrt(32.0 / 7.0));
  // Table of Student's t: 2.3646 for 7 degrees of freedom and 95 %; it has five digits.
  EXPECT_NEAR(*repeats.mean_uncertainty, 2.3646 * *repeats.sd / std::sqrt(8.0), 1e-4);
}

TEST(Summary, TwoValuesHaveAWideInterval) {
  // t = tan(0.475 pi) for one degree of freedom, 12.706; s = sqrt(2) / 2.
  const Summary repeats = summarise(std::array{23.0, 24.0});
  ASSERT_TRUE(repeats.mean_uncertainty);
  EXPECT_NEAR(*repeats.mean_uncertainty, 12.706 / 2, 1e-3);
}

TEST(Summary, ASingleValueHasNoScatter) {
  const Summary repeats = summarise(std::array{23.5});
  EXPECT_EQ(repeats.n, 1);
  EXPECT_EQ(repeats.mean, 23.5);
  EXPECT_FALSE(repeats.sd.has_value());
  EXPECT_FALSE(repeats.mean_uncertainty.has_value());
}

TEST(Summary, EqualValuesHaveNoUncertainty) {
  const Summary repeats = summarise(std::array{4.0, 4.0, 4.0});
  EXPECT_EQ(repeats.sd, 0.0);
  EXPECT_EQ(repeats.mean_uncertainty, 0.0);
}

TEST(Summary, NoValueIsRefused) {
  EXPECT_THROW(summarise(std::vector<double>{}), base::InputError);
}

}  // namespace
}  // namespace repose::calibrate
