#include "vision/measure/scale_bar.h"

#include <limits>

#include <gmock/gmock.h>

namespace repose::vision {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

ScaleBar bar(double length_mm) { return {.line = {{10, 20}, {410, 20}}, .length_mm = length_mm}; }

TEST(ScaleBar, MillimetresThatNoPixelShowsAreRefused) {
  for (const double mm : {.05, 100., 4e5}) EXPECT_THAT(problem_of(bar(mm)), IsEmpty()) << mm;
  for (const double mm : {1e-300, 1e-3, 1e30, std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(problem_of(bar(mm)), AllOf(HasSubstr("mm a pixel"), HasSubstr("Rule: "))) << mm;
  }
  EXPECT_THAT(problem_of({.line = {{1, 1}, {4, 5}}, .length_mm = 3}), HasSubstr("5 pixels apart"));
}

TEST(ScaleBar, ItsPointsLieInThePicture) {
  EXPECT_THAT(problem_in(bar(100), 410, 20), IsEmpty());
  EXPECT_THAT(problem_in(bar(100), 409, 300),
              AllOf(HasSubstr("410,20 must lie inside the 409 x 300 picture"), HasSubstr("Fix: ")));
}

}  // namespace
}  // namespace repose::vision
