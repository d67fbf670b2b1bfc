#include "vision/camera/lens.h"

#include <gmock/gmock.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "tests/support/drawn_board.h"
#include "tests/support/temporary_folder.h"
#include "vision/camera/board.h"
#include "vision/camera/lens_file.h"
#include "vision/picture/opencv.h"

namespace repose::vision {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

Lens barrel() {
  return {.width = 1280,
          .height = 853,
          .focal_px = {1100, 4},
          .centre_x_px = {647, 2},
          .centre_y_px = {420, 2},
          .k1 = {-.18, .01},
          .k2 = {.05, .01},
          .p1 = {.001, .0002},
          .p2 = {-.0015, .0002},
          .k3 = {}};
}

testing::BoardCamera camera_of(const Lens& lens) {
  return {.width = lens.width,
          .height = lens.height,
          .focal_px = lens.focal_px.value,
          .centre_x_px = lens.centre_x_px.value,
          .centre_y_px = lens.centre_y_px.value,
          .k1 = lens.k1.value,
          .k2 = lens.k2.value,
          .p1 = lens.p1.value,
          .p2 = lens.p2.value,
          .k3 = lens.k3.value};
}

TEST(Lens, CorrectedAndSeenAreEachOthersInverse) {
  const Lens lens = barrel();
  const testing::BoardCamera camera = camera_of(lens);
  for (const Point place : {Point{0, 0}, Point{1280, 853}, Point{1200, 30}, Point{640, 430}}) {
    const Point corrected = lens.corrected(place);
    const Point back = lens.seen(corrected);
    EXPECT_NEAR(back.x, place.x, 1e-3);
    EXPECT_NEAR(back.y, place.y, 1e-3);
    // And both follow the drawn camera's formula.
    const Eigen::Vector3d direction = camera.direction(place);
    EXPECT_NEAR(direction.x() * 1100 + 647, corrected.x, .02);
    EXPECT_NEAR(direction.y() * 1100 + 420, corrected.y, .02);
  }
}

TEST(Lens, OfATurnedPictureSeesWhatItSawWhereItWasTurnedTo) {
  const Lens lens = barrel();
  const auto to = [&](Point place, int turn_deg) -> Point {
    if (turn_deg == 90) return {lens.height - place.y, place.x};
    if (turn_deg == 180) return {lens.width - place.x, lens.height - place.y};
    return {place.y, lens.width - place.x};
  };
  for (const int turn_deg : {90, 180, 270}) {
    const Lens upright = turned(lens, turn_deg);
    EXPECT_EQ(upright.width, turn_deg == 180 ? lens.width : lens.height);
    for (const Point place : {Point{0, 0}, Point{1200, 30}, Point{300, 700}}) {
      const Point expected = to(lens.corrected(place), turn_deg);
      const Point corrected = upright.corrected(to(place, turn_deg));
      EXPECT_NEAR(corrected.x, expected.x, 1e-6) << turn_deg;
      EXPECT_NEAR(corrected.y, expected.y, 1e-6) << turn_deg;
    }
  }
}

TEST(Lens, TheCorrectedPictureShowsTheBoardAsALensWithoutDistortionDoes) {
  const Lens lens = barrel();
  const auto place = testing::placed_board({60, 20, 420}, .2, .1, .1);
  const Picture corrected = corrected_picture(board_photo(camera_of(lens), place), lens);
  testing::BoardCamera plain = camera_of(lens);
  plain.k1 = plain.k2 = plain.p1 = plain.p2 = 0;
  const auto expected = find_board(board_photo(plain, place));
  const auto corners = find_board(corrected);
  ASSERT_GE(corners.size(), 40U);
  int compared = 0;
  for (const SeenCorner& corner : corners) {
    for (const SeenCorner& other : expected) {
      if (other.number != corner.number) continue;
      ++compared;
      EXPECT_NEAR(corner.place.x, other.place.x, .3);
      EXPECT_NEAR(corner.place.y, other.place.y, .3);
    }
  }
  EXPECT_GE(compared, 40);
}

TEST(Lens, HoldsForPicturesMadeSmallerButNotForCutOrTurnedOnes) {
  const Lens half = lens_for(barrel(), 640, 427);  // 426.5
  EXPECT_DOUBLE_EQ(half.focal_px.value, 550);
  EXPECT_DOUBLE_EQ(half.k1.value, -.18);
  EXPECT_THROW(lens_for(barrel(), 853, 1280), base::InputError);
  try {
    lens_for(barrel(), 1280, 720);
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("1280 x 720"), HasSubstr("1280 x 853"),
                                    HasSubstr("Fix: use the picture as the camera took it")));
  }
}

TEST(Lens, HintsFollowTheirPlacesIntoTheCorrectedPicture) {
  const Lens lens = barrel();
  MeasureOptions options;
  options.hints.heap = Box{.x = 0, .y = 200, .width = 1280, .height = 600};
  options.hints.ground = Segment{{100, 700}, {1200, 700}};
  options.hints.keep = {{640, 400}};
  options.excluded = {{.x = 10, .y = 10, .width = 100, .height = 50}};
  const MeasureOptions corrected = corrected_options(options, lens);
  // With barrel distortion the corrected edges lie farther out, so they are cut off at the frame.
  EXPECT_EQ(corrected.hints.heap->x, 0);
  EXPECT_LT(corrected.hints.heap->y, 200);
  EXPECT_GT(corrected.hints.ground->from.y, 701);
  EXPECT_NEAR(corrected.hints.keep.front().x, 640, .5);
  EXPECT_TRUE(corrected.problems_in(1280, 853).empty());
  const Box back = seen_box({.x = 300, .y = 300, .width = 200, .height = 100}, lens);
  EXPECT_NEAR(back.x, 300, 12);
  EXPECT_GT(back.x, 300);  // nearer to the middle
}

TEST(LensFile, ComesBackAsItWasWritten) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "camera.toml";
  const std::string text = lens_file_text(barrel(), "10 pictures");
  EXPECT_THAT(text, AllOf(HasSubstr("10 pictures"), HasSubstr("focal_px = 1100.000"),
                          ::testing::Not(HasSubstr("k3"))));
  base::write_whole_file(file, text);
  const Lens read = read_lens_file(file);
  EXPECT_EQ(read.width, 1280);
  EXPECT_DOUBLE_EQ(read.focal_px.value, 1100);
  EXPECT_DOUBLE_EQ(read.focal_px.uncertainty, 4);
  EXPECT_DOUBLE_EQ(read.p2.value, -.0015);
  EXPECT_DOUBLE_EQ(read.k3.value, 0);
}

TEST(LensFile, AllErrorsAreToldAtOnce) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "camera.toml";
  base::write_whole_file(file, std::string_view("width_px = 12.5\nheight_px = 853\nfocal_px = nan\n"
                                                "centre_x_px = \"left\"\nzoom = 2\n"));
  try {
    read_lens_file(file);
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_THAT(
        error.what(),
        AllOf(HasSubstr("camera.toml:1: width_px must be a whole number"),
              HasSubstr(":3: focal_px must be a number"),
              HasSubstr(":4: centre_x_px must be a number"), HasSubstr("centre_y_px is missing"),
              HasSubstr(":5: zoom is not a key"), Not(HasSubstr("focal_px must be above"))));
  }
  base::write_whole_file(file, std::string_view("width_px = = 1\n"));
  EXPECT_THROW(read_lens_file(file), base::InputError);
  EXPECT_THROW(read_lens_file(folder.path() / "none.toml"), base::InputError);
}

TEST(LensFile, LensesThatCannotBeAreRefused) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "camera.toml";
  const auto error_of = [&](Lens lens) -> std::string {
    base::write_whole_file(file, lens_file_text(lens, "test"));
    try {
      read_lens_file(file);
    } catch (const base::InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_EQ(error_of(barrel()), "");
  Lens none = barrel();
  none.focal_px.value = 1;
  none.centre_x_px.value = -3;
  EXPECT_THAT(error_of(none), AllOf(HasSubstr("focal_px must be from 0.18 to 170 times"),
                                    HasSubstr("centre_x_px must lie in the picture")));
  Lens bent = barrel();
  bent.k1.value = 5;
  EXPECT_THAT(error_of(bent), AllOf(HasSubstr("k1 moves the edge"), HasSubstr("Fix: ")));
  bent.k1.value = -.9;  // folds
  EXPECT_THAT(error_of(bent), HasSubstr("k1 moves the edge"));
  bent = barrel();
  bent.p1.value = .5;
  EXPECT_THAT(error_of(bent), HasSubstr("p1 moves the corner"));
  // At a long focal length the same coefficient has little effect.
  bent = barrel();
  bent.focal_px.value = 30'000;
  bent.k1.value = 5;
  EXPECT_EQ(error_of(bent), "");
}

}  // namespace
}  // namespace repose::vision
