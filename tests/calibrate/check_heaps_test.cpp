#include "calibrate/run/check_heaps.h"

#include <gmock/gmock.h>

namespace repose::calibrate {
namespace {

TEST(MostTypical, IsTheOneNearestToTheMeanOfAll) {
  EXPECT_EQ(most_typical({27.3, 21.0, 23.1, 22.0}), 2U);  // 23.35
  EXPECT_EQ(most_typical({5}), 0U);
}

TEST(MostTypical, IsTheFirstOfThoseEquallyNear) {
  EXPECT_EQ(most_typical({24, 22}), 0U);
  EXPECT_EQ(most_typical({20, 23, 23, 26}), 1U);
}

}  // namespace
}  // namespace repose::calibrate
