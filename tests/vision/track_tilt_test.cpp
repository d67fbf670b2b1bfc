#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>

#include <gmock/gmock.h>

#include "tests/support/drawn_film_file.h"
#include "tests/support/drawn_tilt.h"
#include "tests/support/temporary_folder.h"
#include "tests/vision/warnings.h"
#include "vision/drawing/track_overlays.h"
#include "vision/track/tilt_track.h"

namespace repose::vision {
namespace {

using repose::testing::DrawnTilt;
using repose::testing::TemporaryFolder;
using repose::testing::write_film;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Small and short, so that many can be drawn.
DrawnTilt small_tilt() {
  return {.width = 300,
          .height = 170,
          .frames_per_s = 30,
          .rest_s = .3,
          .rate_deg_s = 6,
          .onset_deg = 10,
          .after_s = .4,
          .mm_per_px = .6,
          .radius_px = 6,
          .thickness_px = 6};
}

TiltTrack tracked_tilt(const DrawnTilt& tilt, const TrackOptions& options = {}) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "tilt.mp4";
  write_film(file, tilt);
  return track_tilt(file, options);
}

/// At 30 frames per second the plate turns by .2 degrees per frame.
void expect_slide(const TiltTrack& track, const DrawnTilt& tilt) {
  ASSERT_TRUE(track.has_reading) << track.reason;
  EXPECT_NEAR(track.angle_deg.value, tilt.onset_deg, .3);
  EXPECT_NEAR(track.rate_deg_s.value, tilt.rate_deg_s, .02 * tilt.rate_deg_s);
  EXPECT_NEAR(track.onset_s, tilt.onset_s(), .05);
  EXPECT_GT(track.angle_deg.uncertainty, 0);
  EXPECT_LT(track.angle_deg.uncertainty, 1);
}

TEST(TrackTilt, FindsAndDrawsTheAngleAtWhichBondedGrainsSlide) {
  const TiltTrack track = tracked_tilt(small_tilt(), {.draws_strobe = true});
  expect_slide(track, small_tilt());
  EXPECT_THAT(track.warnings, Not(has_warning("level_hidden")));
  EXPECT_EQ(track.status, MeasureStatus::ok);
  EXPECT_THAT(track.warnings, IsEmpty());
  EXPECT_GT(draw_tilt_overlay(track, "tilt.mp4").height, small_tilt().height);
}

TEST(TrackTilt, FindsItWhereTheHingeIsOutOfThePictureOnTheOtherSide) {
  DrawnTilt tilt = small_tilt();
  tilt.hinge_part = -.15;
  tilt.plate_from = -.4;
  tilt.goes_left = true;
  tilt.has_texture = true;
  tilt.roll_rad = .015;
  expect_slide(tracked_tilt(tilt), tilt);
}

TEST(TrackTilt, TellsWhatARoundGrainCannotShow) {
  DrawnTilt tilt = small_tilt();
  tilt.bonded = 1;
  const TiltTrack track = tracked_tilt(tilt);
  expect_slide(track, tilt);
  EXPECT_EQ(track.status, MeasureStatus::flagged);
  EXPECT_THAT(track.warnings, has_warning("may_roll"));
}

TEST(TrackTilt, RefusesWhatIsSeenToRollOrTip) {
  DrawnTilt tips = small_tilt();
  tips.rolls = 1;
  EXPECT_THAT(tracked_tilt(tips).reason, HasSubstr("rolls or tips at 1"));
  DrawnTilt rolls = tips;
  rolls.bonded = 1;
  rolls.radius_px = 10;
  rolls.has_spot = true;
  const TiltTrack track = tracked_tilt(rolls);
  EXPECT_THAT(track.reason, HasSubstr("Fix: bond three grains"));
  EXPECT_FALSE(track.has_reading);
}

TEST(TrackTilt, RefusesAPlateAtRestAndOneThatHardlyTurns) {
  DrawnTilt tilt = small_tilt();
  tilt.rest_s = 1;
  tilt.after_s = -2.1;
  EXPECT_THAT(tracked_tilt(tilt).reason, HasSubstr("no plate is seen to turn"));
  tilt.after_s = -1.35;
  EXPECT_THAT(tracked_tilt(tilt).reason, HasSubstr("degrees only"));
}

TEST(TrackTilt, RefusesAFilmThatEndsBeforeTheSlideOrHasNoGrain) {
  DrawnTilt tilt = small_tilt();
  tilt.after_s = -.2;
  const TiltTrack track = tracked_tilt(tilt);
  EXPECT_THAT(track.reason, HasSubstr("no grain slides before the film ends"));
  EXPECT_THAT(track.plate, Not(IsEmpty())) << "it is still told how the plate turned";
  tilt.grains = 0;
  EXPECT_THAT(tracked_tilt(tilt).reason, HasSubstr("no grain is seen on the plate"));
}

TEST(TrackTilt, RefusesAGrainAtTheEndOfThePlateThatIsSeen) {
  DrawnTilt tilt = small_tilt();
  tilt.plate_to = 1.2;
  tilt.grain_part = .98;
  EXPECT_THAT(tracked_tilt(tilt).reason, HasSubstr("lies at the end of what is seen"));
}

TEST(TrackTilt, RefusesGrainsThatSlideApart) {
  DrawnTilt tilt = small_tilt();
  tilt.grains = 2;
  tilt.grain_part = .6;
  EXPECT_THAT(tracked_tilt(tilt).reason, HasSubstr("several things slide"));
}

TEST(TrackTilt, RefusesACameraThatMovesAndAFilmOfAFewFrames) {
  DrawnTilt tilt = small_tilt();
  tilt.height = 300;
  tilt.shakes_px = 20;
  EXPECT_THAT(tracked_tilt(tilt).reason, HasSubstr("the camera moves"));
  DrawnTilt few = small_tilt();
  few.after_s = .2 - few.onset_s();
  EXPECT_THAT(tracked_tilt(few).reason, HasSubstr("frames. Rule: 8 or more"));
}

TEST(TrackTilt, FlagsCreepAndAPlateThatWasNotAtRest) {
  DrawnTilt tilt = small_tilt();
  tilt.rest_s = 0;
  tilt.creeps_px = 3;
  const TiltTrack track = tracked_tilt(tilt);
  EXPECT_NEAR(track.angle_deg.value, tilt.onset_deg, .7);
  EXPECT_EQ(track.status, MeasureStatus::flagged);
  EXPECT_THAT(track.warnings, has_warning("no_rest"));
  EXPECT_THAT(track.warnings, has_warning("creeps"));
}

// The camera is rolled, so that the table's edge continues the plate's.
TEST(TrackTilt, FlagsATableWhoseEdgeLiesBehindTheLevelPlate) {
  const DrawnTilt tilt{.width = 400,
                       .height = 300,
                       .frames_per_s = 30,
                       .rest_s = .44,
                       .rate_deg_s = 4.7,
                       .onset_deg = 16,
                       .mm_per_px = .55,
                       .radius_px = 9,
                       .hinge_part = .031,
                       .plate_from = .011,
                       .plate_to = .805,
                       .thickness_px = 4,
                       .edge_row = .8774,
                       .goes_left = true,
                       .roll_rad = .0131};
  const TiltTrack track = tracked_tilt(tilt);
  ASSERT_TRUE(track.has_reading) << track.reason;
  EXPECT_THAT(track.warnings, has_warning("level_hidden"));
  EXPECT_EQ(track.status, MeasureStatus::flagged);
  EXPECT_NEAR(track.angle_deg.value, tilt.onset_deg, track.angle_deg.uncertainty);
}

/// A folder of numbered frames: a missing number is a frame that was not taken.
TiltTrack tracked_frames(const DrawnTilt& tilt, const std::function<int(int)>& number_of) {
  const TemporaryFolder folder;
  const cv::Mat scene = tilt.scene();
  for (int frame = 0; frame < tilt.frames(); ++frame) {
    const int number = number_of(frame);
    if (number < 0) continue;
    write_picture(folder.path() / ("frame" + std::to_string(number) + ".png"),
                  tilt.picture(frame, scene));
  }
  return track_tilt({folder.path(), tilt.frames_per_s});
}

TEST(TrackTilt, FramesThatAreMissingAboutTheOnsetWidenItsInterval) {
  const DrawnTilt tilt = small_tilt();
  const auto at = [&](double time_s) { return static_cast<int>(time_s * tilt.frames_per_s); };
  const int from = at(tilt.onset_s() - .25), to = at(tilt.onset_s() + .12);
  const TiltTrack track =
      tracked_frames(tilt, [=](int frame) { return frame >= from && frame < to ? -1 : frame; });
  ASSERT_TRUE(track.has_reading) << track.reason;
  EXPECT_EQ(track.status, MeasureStatus::flagged);
  EXPECT_THAT(track.warnings, has_warning("onset_unseen"));
  EXPECT_THAT(track.warnings, Not(has_warning("jerks")));
  EXPECT_NEAR(track.angle_deg.value, tilt.onset_deg, track.angle_deg.uncertainty);
  EXPECT_GT(track.angle_deg.uncertainty, .15 * tilt.rate_deg_s);
  // Long before the onset they do no harm.
  expect_slide(
      tracked_frames(tilt,
                     [&](int frame) { return frame >= at(.7) && frame < at(1.2) ? -1 : frame; }),
      tilt);
}

TEST(TrackTilt, FlagsAPartWhoseTimeStampsAreStretched) {
  const DrawnTilt tilt = small_tilt();
  const int from = static_cast<int>(.7 * tilt.onset_s() * tilt.frames_per_s);
  const TiltTrack stretched =
      tracked_frames(tilt, [=](int frame) { return std::max(frame, 2 * frame - from); });
  ASSERT_TRUE(stretched.has_reading) << stretched.reason;
  EXPECT_EQ(stretched.status, MeasureStatus::flagged);
  EXPECT_THAT(stretched.warnings, has_warning("speed_changes"));
  // A camera that takes fewer frames from then on has correct time stamps.
  const TiltTrack fewer = tracked_frames(
      tilt, [=](int frame) { return frame > from && (frame - from) % 2 == 1 ? -1 : frame; });
  ASSERT_TRUE(fewer.has_reading) << fewer.reason;
  EXPECT_THAT(fewer.warnings, Not(has_warning("speed_changes")));
  EXPECT_NEAR(fewer.angle_deg.value, tilt.onset_deg, .5);
}

TEST(TrackTilt, WarnsOfAnUnevenRate) {
  DrawnTilt tilt = small_tilt();
  tilt.onset_deg = 12;
  tilt.uneven = .6;
  EXPECT_THAT(tracked_tilt(tilt).warnings, has_warning("uneven_rate"));
}

}  // namespace
}  // namespace repose::vision
