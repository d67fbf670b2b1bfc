#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>

#include "tests/support/drawn_film_file.h"
#include "tests/support/drawn_roll.h"
#include "tests/support/temporary_folder.h"
#include "vision/drawing/track_overlays.h"
#include "vision/track/roll_track.h"

namespace repose::vision {
namespace {

using repose::testing::DrawnRoll;
using repose::testing::TemporaryFolder;
using repose::testing::write_film;
using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;

/// Small, so that many can be drawn.
DrawnRoll small_roll() {
  return {.width = 360,
          .height = 180,
          .seconds = 1.9,
          .mm_per_px = 1.2,
          .stopped_mm = 170,
          .radius_px = 6,
          .release_s = .2,
          .roll_s = 1.2};
}

std::filesystem::path film_of_roll(const TemporaryFolder& folder, const DrawnRoll& roll) {
  const auto file = folder.path() / "roll.mp4";
  write_film(file, roll);
  return file;
}

TrackOptions scaled_roll_options(const DrawnRoll& roll) {
  return {.scale = ScaleBar{.line = {{20, 30}, {320, 30}}, .length_mm = 300 * roll.mm_per_px}};
}

RollTrack tracked_roll(const DrawnRoll& roll, const TrackOptions& options) {
  const TemporaryFolder folder;
  return track_roll(film_of_roll(folder, roll), options);
}
RollTrack tracked_roll(const DrawnRoll& roll) {
  return tracked_roll(roll, scaled_roll_options(roll));
}

void expect_rest(const RollTrack& track, const DrawnRoll& roll, double within = .01) {
  ASSERT_TRUE(track.has_reading) << track.reason;
  EXPECT_EQ(track.status, MeasureStatus::ok);
  EXPECT_NEAR(track.stopped_mm.value, roll.stopped_mm, within * roll.stopped_mm);
  EXPECT_NEAR(track.released_mm.value, roll.released_mm, .02 * roll.released_mm);
  EXPECT_NEAR(track.incline_deg.value, roll.incline_deg, .5);
  EXPECT_NEAR(track.stopped_s, roll.release_s + roll.roll_s, .15);
  EXPECT_GT(track.stopped_mm.uncertainty, 0);
  EXPECT_LT(track.stopped_mm.uncertainty, .03 * roll.stopped_mm);
}

TEST(TrackRoll, FindsWhereTheGrainRestsByAScale) {
  expect_rest(tracked_roll(small_roll()), small_roll());
}

/// A board with squares of 14 px above the flat.
const BoardPlacing kBoard{.square_mm = 14 * small_roll().mm_per_px};

TEST(TrackRoll, MillimetresComeFromABoard) {
  DrawnRoll roll = small_roll();
  roll.board_square_px = 14;
  const RollTrack track = tracked_roll(roll, {.board = kBoard});
  ASSERT_TRUE(track.has_reading) << track.reason;
  EXPECT_EQ(track.status, MeasureStatus::ok);
  EXPECT_TRUE(track.has_scale);
  EXPECT_EQ(track.board.size(), 4U);
  EXPECT_NEAR(track.stopped_mm.value, roll.stopped_mm, .01 * roll.stopped_mm);
  EXPECT_LT(track.stopped_mm.uncertainty, .05 * roll.stopped_mm);
}

TEST(TrackRoll, IsRefusedWhereNoBoardIsSeen) {
  const RollTrack track = tracked_roll(small_roll(), {.board = kBoard});
  EXPECT_EQ(track.status, MeasureStatus::refused);
  EXPECT_FALSE(track.has_reading);
  EXPECT_THAT(track.reason, HasSubstr("no board was found"));
}

TEST(TrackRoll, MillimetresComeFromTheReleaseWhereThereIsNoScale) {
  const DrawnRoll roll = small_roll();
  const RollTrack track = tracked_roll(roll, {.released_mm = roll.released_mm});
  expect_rest(track, roll, .02);  // an error in the foot's place counts twice
  EXPECT_FALSE(track.has_scale);
  EXPECT_NEAR(track.mm_per_px, roll.mm_per_px, .02 * roll.mm_per_px);
}

TEST(TrackRoll, FindsItWhereTheGrainRollsToTheLeftAndAHandLetsGoOfIt) {
  DrawnRoll roll = small_roll();
  roll.goes_left = true;
  roll.has_hand = true;
  expect_rest(tracked_roll(roll), roll);
}

TEST(TrackRoll, FollowsAFlatThatLeansInThePicture) {
  DrawnRoll roll = small_roll();
  roll.roll_rad = .05;
  const RollTrack track = tracked_roll(roll);
  expect_rest(track, roll);
  EXPECT_THAT(track.warnings, Contains(Field(&Warning::code, "leaning")));
}

TEST(TrackRoll, RefusesAGrainThatStillMovesAtTheEnd) {
  DrawnRoll roll = small_roll();
  roll.seconds = 1.3;
  EXPECT_THAT(tracked_roll(roll).reason, HasSubstr("still moves when the film ends"));
}

TEST(TrackRoll, RefusesAGrainThatLeavesThePictureOrRestsAtItsEdge) {
  DrawnRoll roll = small_roll();
  roll.stopped_mm = 400;
  const RollTrack left = tracked_roll(roll);
  EXPECT_EQ(left.status, MeasureStatus::refused);
  EXPECT_THAT(left.reason, HasSubstr("edge of the picture"));
  roll.stopped_mm = .64 * roll.width * roll.mm_per_px;  // half of it is outside
  EXPECT_THAT(tracked_roll(roll).reason, HasSubstr("edge of the picture"));
}

TEST(TrackRoll, RefusesAPathWithoutAFoot) {
  DrawnRoll roll = small_roll();
  roll.has_incline = false;
  const RollTrack track = tracked_roll(roll);
  EXPECT_THAT(track.reason, HasSubstr("there is no foot"));
  EXPECT_FALSE(track.has_reading);
}

TEST(TrackRoll, LeavesOutAHopAtTheFoot) {
  DrawnRoll roll = small_roll();
  roll.hop_px = 4;
  const RollTrack track = tracked_roll(roll);
  expect_rest(track, roll);
  EXPECT_THAT(track.warnings, Contains(Field(&Warning::code, "hops")));
}

TEST(TrackRoll, RefusesSeveralGrains) {
  DrawnRoll roll = small_roll();
  roll.grains = 2;
  EXPECT_THAT(tracked_roll(roll).reason, HasSubstr("several things move"));
}

TEST(TrackRoll, WithoutAScaleTheReleaseMustBeSeen) {
  DrawnRoll roll = small_roll();
  roll.release_s = -.3;
  EXPECT_THAT(tracked_roll(roll, {.released_mm = roll.released_mm}).reason,
              HasSubstr("not seen where the grain was let go"));
  EXPECT_TRUE(tracked_roll(roll).has_reading) << "with one it need not";
}

TEST(TrackRoll, IsDrawn) {
  const DrawnRoll roll = small_roll();
  TrackOptions options = scaled_roll_options(roll);
  options.draws_strobe = true;
  const RollTrack track = tracked_roll(roll, options);
  EXPECT_GT(draw_roll_overlay(track, "roll.mp4").height, roll.height);
}

}  // namespace
}  // namespace repose::vision
