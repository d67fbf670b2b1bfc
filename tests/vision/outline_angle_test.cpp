#include "vision/measure/outline_angle.h"

#include <cmath>
#include <limits>
#include <map>
#include <string>

#include <gmock/gmock.h>

#include "base/angle_definition.h"
#include "base/input_error.h"
#include "tests/support/heap_random.h"
#include "tests/vision/pictures.h"
#include "tests/vision/profiles.h"
#include "vision/measure/flank.h"

namespace repose::vision {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

/// The part of a height function that is above the ground, with points `unit` apart.
template <class Height>
Outline outline_of(Height height, double unit = 1, int columns = 700) {
  Outline outline;
  for (int col = 0; col < columns; ++col) {
    const double here = height(col + 0.5);
    if (here <= 0) continue;
    outline.along.push_back(unit * (col + 0.5));
    outline.height.push_back(unit * here);
  }
  return outline;
}

TEST(OutlineAngle, StraightFlanksAreExact) {
  const OutlineAngle angle = measure_outline(outline_of(kTriangle));
  ASSERT_TRUE(angle.left && angle.right);
  EXPECT_NEAR(angle.left->angle_rad, kLeft_rad, 1e-6);
  EXPECT_NEAR(angle.right->angle_rad, kRight_rad, 1e-6);
  EXPECT_NEAR(*angle.angle_rad(), 25 * kDegree, 1e-6);
  // From the middle of the highest part, which may lie up to 3 % of the height down one side.
  EXPECT_NEAR(angle.left->foot + angle.right->foot,
              110 / kTriangle.left_slope + 110 / kTriangle.right_slope, 1e-3);
}

TEST(OutlineAngle, OtherDefinitionsAreThoseOfTheEdge) {
  // 20 degrees at the foot, 30 above half the height: a line through all lies in between.
  const double foot = 55 / std::tan(20 * kDegree), top = 55 / std::tan(30 * kDegree);
  const Outline hollow = outline_of([&](double along) {
    const double off = std::abs(along - 350);
    return off < top ? 55 + (top - off) * std::tan(30 * kDegree)
                     : 55 - (off - top) * std::tan(20 * kDegree);
  });
  EXPECT_TRUE(measure_outline(hollow).definitions.empty()) << "not asked for";
  const OutlineAngle angle = measure_outline(hollow, {.grain = 2, .has_definitions = true});
  std::map<std::string, double> by_name;
  for (const NamedAngle& one : angle.definitions) by_name[one.name] = one.angle_rad / kDegree;
  ASSERT_EQ(by_name.size(), base::kAngleDefinitions.size() - 1);
  for (const auto& [name, deg] : by_name) {
    EXPECT_NE(base::find_definition(name), nullptr) << name;
    EXPECT_GT(deg, 20) << name;
    EXPECT_LT(deg, 30) << name;
  }
  // The crest is that of the lightly smoothed edge: slightly lower.
  EXPECT_NEAR(by_name["height_over_base"], std::atan2(110, foot + top) / kDegree, .4);
  // The least-squares line through all of a flank, u from the crest.
  double uu = 0, uh = 0;
  const double middle = (foot + top) / 2;
  for (double u = 0; u < foot + top; u += .1) {
    const double h =
        u < top ? 110 - u * std::tan(30 * kDegree) : 55 - (u - top) * std::tan(20 * kDegree);
    uu += (u - middle) * (u - middle);
    uh += (u - middle) * h;
  }
  EXPECT_NEAR(by_name["whole_flank"], std::atan(-uh / uu) / kDegree, .3);
  EXPECT_TRUE(
      measure_outline({.along = {0}, .height = {1}}, {.has_definitions = true}).definitions.empty())
      << "no flank";
}

/// A heap whose grains are twelve columns long.
double bumpy(double along) {
  return kTriangle(along) > 0 ? std::max(0.0, kTriangle(along) + 3 * std::sin(along / 2)) : 0;
}

TEST(OutlineAngle, IsThatOfThePictureWhoseEdgeIsTheOutline) {
  const Outline outline = outline_of(bumpy);
  Profile profile{.along = outline.along, .height = outline.height};
  set_crest(profile);
  for (const auto grain : {std::optional<double>{}, std::optional<double>{12}}) {
    const OutlineAngle angle = measure_outline(outline, {.grain = grain});
    ASSERT_TRUE(angle.left && angle.right);
    const FlankOptions options{.grain = grain};
    EXPECT_NEAR(angle.left->angle_rad, fit_flank(profile, Side::left, options).angle_rad, 1e-9);
    EXPECT_NEAR(angle.right->angle_rad, fit_flank(profile, Side::right, options).angle_rad, 1e-9);
  }
}

TEST(OutlineAngle, DoesNotDependOnTheUnit) {
  const OutlineAngle pixels = measure_outline(outline_of(bumpy), {.grain = 12});
  const OutlineAngle metres = measure_outline(outline_of(bumpy, 1e-4), {.grain = 12e-4});
  ASSERT_TRUE(pixels.right && metres.right);
  EXPECT_NEAR(metres.right->angle_rad, pixels.right->angle_rad, 1e-9);
  EXPECT_NEAR(metres.right->foot, 1e-4 * pixels.right->foot, 1e-9);
}

TEST(OutlineAngle, UsesTheWindowThatIsAskedFor) {
  // 35 degrees above half its height, 20 below.
  const double steep = std::tan(35 * kDegree);
  const double flat = std::tan(20 * kDegree);
  const Outline hollow = outline_of([&](double along) {
    const double from_crest = std::abs(along - 350);
    const double knee = 50 / steep;
    return from_crest < knee ? 100 - steep * from_crest : 50 - flat * (from_crest - knee);
  });
  const auto angle_between = [&](double from, double to) {
    return *measure_outline(hollow, {.window_from = from, .window_to = to, .grain = 2}).angle_rad();
  };
  EXPECT_NEAR(angle_between(.55, .9), 35 * kDegree, 1e-6);
  EXPECT_NEAR(angle_between(.1, .45), 20 * kDegree, 1e-6);
}

TEST(OutlineAngle, AHeapOfOneSideHasThatSidesAngle) {
  const OutlineAngle angle =
      measure_outline(outline_of([](double along) { return along < 350 ? 0 : kTriangle(along); }));
  EXPECT_FALSE(angle.left);
  ASSERT_TRUE(angle.right);
  EXPECT_EQ(angle.angle_rad(), angle.right->angle_rad);
}

/// Level for 500 columns, with rims of 45 degrees.
double plateau(double along) { return std::min(60.0, 310 - std::abs(along - 350)); }

TEST(OutlineAngle, AWidePlateauHasNoFlank) {
  const OutlineAngle angle = measure_outline(outline_of(plateau));
  EXPECT_FALSE(angle.left || angle.right);
  EXPECT_FALSE(angle.angle_rad());
}

TEST(OutlineAngle, AHeapWithAFlatTopHasFlanks) {
  const OutlineAngle angle = measure_outline(
      outline_of([](double along) { return std::min(60.0, 150 - .5 * std::abs(along - 350)); }));
  ASSERT_TRUE(angle.left && angle.right);
  EXPECT_NEAR(*angle.angle_rad(), std::atan(.5), 1e-3);
}

TEST(OutlineAngle, TheFootOfALayerIsNearItsEnd) {
  // Its top falls by a quarter of its height: its line would meet the ground four times as far out.
  const OutlineAngle angle = measure_outline(
      outline_of([](double along) { return std::max(0.0, 40 - .03 * std::abs(along - 350)); }));
  ASSERT_TRUE(angle.left && angle.right);
  EXPECT_LT(*angle.angle_rad(), 2 * kDegree);
  EXPECT_NEAR(angle.left->foot, 700, 3);
  EXPECT_NEAR(angle.right->foot, 700, 3);
}

TEST(OutlineAngle, ALevelTopIsNoFlank) {
  const OutlineAngle angle = measure_outline(
      outline_of([](double along) { return std::max(0.0, 20 - .018 * std::abs(along - 350)); }));
  EXPECT_FALSE(angle.left || angle.right);
}

TEST(OutlineAngle, FewPointsHaveNoFlank) {
  EXPECT_FALSE(measure_outline({.along = {0}, .height = {1}}).angle_rad());
  EXPECT_FALSE(measure_outline({.along = {0, 1, 2}, .height = {1, 2, 1}}).angle_rad());
}

TEST(OutlineAngle, RefusesWhatIsNoOutline) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Outline good = outline_of(kTriangle);
  EXPECT_THROW(measure_outline({}), base::InputError);
  EXPECT_THROW(measure_outline({.along = {0, 1}, .height = {1}}), base::InputError);
  EXPECT_THROW(measure_outline({.along = {0, 1}, .height = {1, kNan}}), base::InputError);
  EXPECT_THROW(measure_outline({.along = {1, 0}, .height = {1, 1}}), base::InputError);
  EXPECT_THROW(measure_outline(good, {.grain = 0}), base::InputError);
  EXPECT_THROW(measure_outline(good, {.window_from = .8, .window_to = .2}), base::InputError);
  EXPECT_THROW(measure_outline(good, {.window_from = kNan}), base::InputError);
  try {
    measure_outline({.along = {1, 0}, .height = {1}}, {.window_from = .8, .window_to = .2});
    FAIL() << "it was taken";
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("window = 0.8,0.2"), HasSubstr("1 heights"),
                                    HasSubstr("goes back")));
  }
}

}  // namespace
}  // namespace repose::vision
