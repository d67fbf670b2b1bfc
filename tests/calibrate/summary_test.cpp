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
  // From a table of Student's t with five digits: 2.3646 for 7 degrees of freedom and 95 %.
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

// Rosner (1983), Technometrics 25, 165, table 1: at 5 % three of 54 are outliers, although the
// farthest alone is not.
TEST(Outliers, AreThoseOfRosner) {
  std::vector<double> values = {-.25, .68,  .94,  1.15, 1.2,  1.26, 1.26, 1.34, 1.38, 1.43, 1.49,
                                1.49, 1.55, 1.56, 1.58, 1.65, 1.69, 1.7,  1.76, 1.77, 1.81, 1.91,
                                1.94, 1.96, 1.99, 2.06, 2.09, 2.1,  2.14, 2.15, 2.23, 2.24, 2.26,
                                2.35, 2.37, 2.4,  2.47, 2.54, 2.62, 2.64, 2.9,  2.92, 2.92, 2.93,
                                3.21, 3.26, 3.3,  3.59, 3.68, 4.3,  4.64, 5.34, 5.42, 6.01};
  EXPECT_THAT(outliers_of(values, .05), ::testing::ElementsAre(51, 52, 53));
  EXPECT_THAT(outliers_of(values, .001), ::testing::IsEmpty());
  std::reverse(values.begin(), values.end());
  EXPECT_THAT(outliers_of(values, .05), ::testing::ElementsAre(0, 1, 2));
}

TEST(Outliers, FewOrEqualValuesHaveNone) {
  EXPECT_THAT(outliers_of(std::vector<double>{}, .05), ::testing::IsEmpty());
  EXPECT_THAT(outliers_of(std::vector{1., 1., 1., 9.}, .05), ::testing::IsEmpty());
  EXPECT_THAT(outliers_of(std::vector(8, 22.), .05), ::testing::IsEmpty());
}

}  // namespace
}  // namespace repose::calibrate
