#include "vision/measure/scale_bar.h"

#include <limits>

#include <gmock/gmock.h>

namespace repose::vision {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

ScaleBar bar(double length_mm) { return {.line = {{10, 20}, {410, 20}}, .length_mm = length_mm}; }

TEST(ScaleBar, MillimetresThatNoPixelShowsAreRefused) {
  for (const double mm : {.05, 100., 4e5}) EXPECT_FALSE(problem_of(bar(mm))) << mm;
  for (const double mm : {1e-300, 1e-3, 1e30, std::numeric_limits<double>::infinity()}) {
    EXPECT_THAT(problem_of(bar(mm)).value().text(),
                AllOf(HasSubstr("mm a pixel"), HasSubstr("Rule: ")))
        << mm;
  }
  EXPECT_THAT(problem_of({.line = {{1, 1}, {4, 5}}, .length_mm = 3}).value().text(),
              HasSubstr("5 pixels apart"));
}

TEST(ScaleBar, ItsPointsLieInThePicture) {
  EXPECT_FALSE(problem_in(bar(100), 410, 20));
  EXPECT_THAT(problem_in(bar(100), 409, 300).value().text(),
              AllOf(HasSubstr("410,20 must lie inside the 409 x 300 picture"), HasSubstr("Fix: ")));
}

}  // namespace
}  // namespace repose::vision
