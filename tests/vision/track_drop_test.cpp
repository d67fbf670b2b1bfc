#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/support/drawn_drop.h"
#include "tests/support/drawn_film_file.h"
#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"
#include "tests/vision/warnings.h"
#include "vision/drawing/track_overlays.h"
#include "vision/track/drop_track.h"
#include "vision/video/film_writer.h"

namespace repose::vision {
namespace {

using repose::testing::DrawnDrop;
using repose::testing::TemporaryFolder;
using repose::testing::write_film;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

/// Small, so that many can be drawn.
DrawnDrop small_drop() {
  return {.width = 320,
          .height = 240,
          .frames_per_s = 60,
          .seconds = 1.1,
          .mm_per_px = 1.4,
          .radius_px = 6,
          .release_s = .2};
}

std::filesystem::path film_of(const TemporaryFolder& folder, const DrawnDrop& drop,
                              double plays_at = 0) {
  const auto file = folder.path() / "drop.mp4";
  write_film(file, drop, plays_at);
  return file;
}

DropTrack tracked(const DrawnDrop& drop, const TrackOptions& options = {}, double plays_at = 0) {
  const TemporaryFolder folder;
  return track_drop(film_of(folder, drop, plays_at), options);
}

/// A scale line of 100 px with its correct length.
TrackOptions scaled_options(const DrawnDrop& drop) {
  return {.scale = ScaleBar{.line = {{20, 30}, {20, 130}}, .length_mm = 100 * drop.mm_per_px}};
}

TEST(TrackDrop, FindsRestitutionAndHeightsWithoutAScale) {
  const DrawnDrop drop = small_drop();
  const DropTrack track = tracked(drop);
  EXPECT_EQ(track.status, MeasureStatus::ok) << track.reason;
  ASSERT_GE(track.bounces.size(), 2U);
  for (const Bounce& bounce : track.bounces) {
    EXPECT_NEAR(bounce.restitution.value, .6, bounce.restitution.uncertainty);
  }
  EXPECT_NEAR(track.bounces[0].restitution.value, .6, .01);
  EXPECT_NEAR(track.bounces[0].drop_mm.value, 250, track.bounces[0].drop_mm.uncertainty);
  EXPECT_NEAR(track.bounces[0].rebound_mm.value, 90, 2);
  EXPECT_NEAR(track.bounces[0].time_s, .2 + std::sqrt(2 * .25 / 9.80665), .004);
}

TEST(TrackDrop, GivesHeightsInTheScale) {
  const DrawnDrop drop = small_drop();
  const DropTrack track = tracked(drop, scaled_options(drop));
  ASSERT_FALSE(track.bounces.empty()) << track.reason;
  EXPECT_EQ(track.status, MeasureStatus::ok);
  EXPECT_NEAR(track.bounces[0].rebound_mm.value, 90, 2);
  EXPECT_NEAR(track.gravity_m_s2.value().value, 9.81, .25);
}

TEST(TrackDrop, TellsAFilmThatPlaysSlowerThanItWasTaken) {
  const DrawnDrop drop = small_drop();
  const DropTrack track = tracked(drop, scaled_options(drop), 15);
  EXPECT_EQ(track.status, MeasureStatus::flagged);
  ASSERT_THAT(track.warnings, has_warning("frame_rate"));
  EXPECT_THAT(track.warnings[0].message, HasSubstr("times slower"));
  ASSERT_FALSE(track.bounces.empty());
  EXPECT_NEAR(track.bounces[0].restitution.value, .6,
              std::min(.02, track.bounces[0].restitution.uncertainty));
  EXPECT_NEAR(track.bounces[0].rebound_mm.value, 90, 3);
}

TEST(TrackDrop, FollowsTheGrainWhereAHandAndALeaningCameraAreInTheWay) {
  DrawnDrop drop = small_drop();
  drop.has_hand = true;
  drop.roll_rad = .05;
  const DropTrack track = tracked(drop);
  ASSERT_FALSE(track.bounces.empty()) << track.reason;
  EXPECT_NEAR(track.bounces[0].restitution.value, .6, .015);
  EXPECT_NEAR(std::abs(track.roll_rad), .05, .004);
  EXPECT_THAT(track.warnings, has_warning("leaning"));
}

TEST(TrackDrop, DrawsTheStrobePictureWithItsCaption) {
  const DropTrack track = tracked(small_drop(), {.draws_strobe = true});
  EXPECT_EQ(track.strobe.width, 320);
  const Picture overlay = draw_drop_overlay(track, "drop.mp4");
  EXPECT_EQ(overlay.width, 960);
  EXPECT_GT(overlay.height, 720);
}

TEST(TrackDropRefuses, AFilmInWhichNothingMoves) {
  DrawnDrop drop = small_drop();
  drop.release_s = 9;
  drop.seconds = .5;
  const DropTrack track = tracked(drop);
  EXPECT_EQ(track.status, MeasureStatus::refused);
  EXPECT_THAT(track.reason, HasSubstr("nothing moves"));
  EXPECT_THAT(track.bounces, IsEmpty());
}

TEST(TrackDropRefuses, AFilmOfAFewFrames) {
  DrawnDrop drop = small_drop();
  drop.seconds = .1;
  EXPECT_THAT(tracked(drop).reason, HasSubstr("the film has 6 frames. Rule: 8 or more"));
}

TEST(TrackDropRefuses, AFallWithoutItsRise) {
  DrawnDrop drop = small_drop();
  drop.seconds = .4;
  EXPECT_THAT(tracked(drop).reason, HasSubstr("no bounce was seen"));
}

/// A board with squares of 12 px beside the fall.
DropTrack tracked_beside_board(const DrawnDrop& drop) {
  return tracked(drop, {.board = BoardPlacing{.square_mm = 12 * drop.mm_per_px}});
}

TEST(TrackDrop, GivesHeightsInTheMillimetresOfABoard) {
  DrawnDrop drop = small_drop();
  drop.board_square_px = 12;
  const DropTrack track = tracked_beside_board(drop);
  ASSERT_FALSE(track.bounces.empty()) << track.reason;
  EXPECT_EQ(track.status, MeasureStatus::ok);
  EXPECT_EQ(track.board.size(), 4U);
  EXPECT_NEAR(track.mm_per_px.value(), drop.mm_per_px, .01 * drop.mm_per_px);
  const Estimate& fall = track.bounces[0].drop_mm;
  EXPECT_NEAR(fall.value, 250, fall.uncertainty);
  EXPECT_GT(fall.uncertainty, .02 * 250) << "without a lens its distortion is allowed for";
  EXPECT_LT(fall.uncertainty, .08 * 250);
}

TEST(TrackDrop, HeightsAreByGravityWhereNoBoardIsSeenAndThatIsFlagged) {
  const DropTrack track = tracked_beside_board(small_drop());
  ASSERT_FALSE(track.bounces.empty()) << track.reason;
  EXPECT_EQ(track.status, MeasureStatus::flagged);
  EXPECT_THAT(track.warnings, has_warning("no_board"));
  EXPECT_FALSE(track.has_scale);
  EXPECT_NEAR(track.bounces[0].drop_mm.value, 250, track.bounces[0].drop_mm.uncertainty);
}

/// Applies a lens's distortion to undistorted pictures of its size.
class Distortion {
 public:
  explicit Distortion(const Lens& lens) {
    for (int row = 0; row < lens.height; ++row) {
      for (int k = 0; k < lens.width; ++k) {
        const Point from = lens.corrected({k + .5, row + .5});
        const int x = std::clamp(static_cast<int>(from.x), 0, lens.width - 1);
        const int y = std::clamp(static_cast<int>(from.y), 0, lens.height - 1);
        from_.push_back(static_cast<std::size_t>(3) * (y * lens.width + x));
      }
    }
  }
  Picture operator()(const Picture& picture) const {
    Picture seen = picture;
    for (std::size_t k = 0; k < from_.size(); ++k) {
      for (std::size_t c = 0; c < 3; ++c) seen.bgr[3 * k + c] = picture.bgr[from_[k] + c];
    }
    return seen;
  }

 private:
  std::vector<std::size_t> from_;
};

/// Mean distance of the grain's positions from those in another film of the same drop.
double distance_px(const DropTrack& track, const DropTrack& other) {
  double sum = 0;
  int count = 0;
  for (const GrainPlace& place : track.places) {
    const auto same = std::ranges::find(other.places, place.time_s, &GrainPlace::time_s);
    if (same == other.places.end()) continue;
    sum += std::hypot(place.centre.x - same->centre.x, place.centre.y - same->centre.y);
    ++count;
  }
  return sum / count;
}

TEST(TrackDrop, TheLensIsTakenOutOfTheFrames) {
  DrawnDrop drop = small_drop();
  drop.board_square_px = 14;
  const Lens lens{.width = 2 * drop.width,
                  .height = 2 * drop.height,
                  .focal_px = {700, 2},
                  .centre_x_px = {1. * drop.width, 1},
                  .centre_y_px = {1. * drop.height, 1},
                  .k1 = {-.35, .002},
                  .k2 = {},
                  .p1 = {},
                  .p2 = {},
                  .k3 = {}};
  const TemporaryFolder folder;
  const auto file = folder.path() / "drop.mp4";
  {
    vision::FilmWriter film(file, drop.frames_per_s);
    const Distortion distorted(lens_for(lens, drop.width, drop.height));
    const cv::Mat scene = drop.scene();
    for (int frame = 0; frame < drop.frames(); ++frame) {
      film.add(distorted(drop.picture(frame, scene)));
    }
    film.close();
  }
  const TrackOptions options{.board = BoardPlacing{.square_mm = 14 * drop.mm_per_px}};
  const DropTrack with = track_drop({file, std::nullopt, lens}, options);
  const DropTrack without = track_drop(file);
  const Lens seen = lens_for(lens, drop.width, drop.height);
  const ScaleBar bar{.line = {seen.seen({20, 30}), seen.seen({20, 130})},
                     .length_mm = 100 * drop.mm_per_px};
  const DropTrack by_bar = track_drop({file, std::nullopt, lens}, {.scale = bar});
  const DropTrack plain = tracked(drop);
  ASSERT_FALSE(with.bounces.empty()) << with.reason;
  EXPECT_LT(distance_px(with, plain), .5);
  EXPECT_GT(distance_px(without, plain), 1.5);
  EXPECT_NEAR(with.bounces[0].restitution.value, .6, .01);
  EXPECT_NEAR(with.mm_per_px.value(), drop.mm_per_px, .01 * drop.mm_per_px);
  EXPECT_NEAR(with.bounces[0].drop_mm.value, 250, with.bounces[0].drop_mm.uncertainty);
  EXPECT_NEAR(by_bar.mm_per_px.value(), drop.mm_per_px, .002 * drop.mm_per_px);
  Lens other = lens;
  other.height = lens.width;
  EXPECT_THAT(error_of([&] {
                track_drop({file, std::nullopt, other});
              }),
              HasSubstr("the camera file is for"));
}

TEST(TrackDropRefuses, AnotherScene) {
  DrawnDrop drop = small_drop();
  drop.cut = 30;
  EXPECT_THAT(tracked(drop).reason, HasSubstr("another scene begins"));
}

TEST(TrackDropRefuses, AMovingCamera) {
  DrawnDrop drop = small_drop();
  drop.shake_px = 7;
  EXPECT_THAT(tracked(drop).reason, HasSubstr("the camera moves"));
}

TEST(TrackDropRefuses, SeveralGrains) {
  DrawnDrop drop = small_drop();
  drop.grains = 2;
  EXPECT_THAT(tracked(drop).reason, HasSubstr("several grains bounce"));
}

TEST(TrackDropFiles, WhatIsNoFilmIsAnErrorThatSaysSo) {
  const TemporaryFolder folder;
  const auto error = [&](const char* name, const std::string& text) {
    const auto file = folder.path() / name;
    std::ofstream(file, std::ios::binary) << text;
    return error_of([&] { track_drop(file); });
  };
  EXPECT_THAT(error("empty.mp4", ""), HasSubstr("empty.mp4: is empty"));
  EXPECT_THAT(error("list.m3u8", "#EXTM3U\n/etc/hostname\n"), HasSubstr("is no film"));
  EXPECT_THAT(error("cut.mp4", std::string("\0\0\0\x18", 4) + "ftypmp42 and then nothing"),
              HasSubstr("cannot be decoded"));
  EXPECT_THAT(error_of([&] { track_drop(folder.path() / "none.mp4"); }),
              HasSubstr("no such file. Fix: "));
  EXPECT_THAT(error_of([&] { track_drop(folder.path()); }), HasSubstr("is a folder"));
}

TEST(TrackDrop, AFolderOfItsFramesIsTheSameFilm) {
  const DrawnDrop drop = small_drop();
  const TemporaryFolder folder;
  const cv::Mat scene = drop.scene();
  for (int frame = 0; frame < drop.frames(); ++frame) {
    // Two are missing: their time still passes.
    if (frame == 5 || frame == 30) continue;
    write_picture(folder.path() / ("frame" + std::to_string(frame) + ".png"),
                  drop.picture(frame, scene));
  }
  const DropTrack track = track_drop({folder.path(), drop.frames_per_s});
  ASSERT_FALSE(track.bounces.empty()) << track.reason;
  EXPECT_NEAR(track.bounces.front().restitution.value, drop.restitution, .02);
  EXPECT_EQ(track.film.dropped_frames, 2);
  EXPECT_THAT(track.warnings, has_warning("dropped_frames"));
}

/// From frame `from` on, half of the frames, or all of them with time stamps twice as far apart.
DropTrack tracked_from(const DrawnDrop& drop, int from, bool is_stretched) {
  const TemporaryFolder folder;
  const cv::Mat scene = drop.scene();
  for (int frame = 0; frame < drop.frames(); ++frame) {
    if (!is_stretched && frame > from && (frame - from) % 2 == 1) continue;
    const int number = is_stretched ? std::max(frame, 2 * frame - from) : frame;
    write_picture(folder.path() / ("frame" + std::to_string(number) + ".png"),
                  drop.picture(frame, scene));
  }
  return track_drop({folder.path(), drop.frames_per_s});
}

TEST(TrackDrop, HeightsByGravityAreFlaggedWhereItsFramesBeginToComeMoreSlowlyBeforeTheFall) {
  DrawnDrop drop = small_drop();
  drop.frames_per_s = 120;
  const int before_fall = static_cast<int>(.1 * drop.frames_per_s);
  const DropTrack track = tracked_from(drop, before_fall, true);
  ASSERT_FALSE(track.bounces.empty()) << track.reason;
  EXPECT_NEAR(track.bounces.front().restitution.value, drop.restitution, .02);
  EXPECT_GT(track.bounces.front().drop_mm.value, 3 * drop.drop_mm) << "as slow motion makes it";
  EXPECT_EQ(track.status, MeasureStatus::flagged);
  EXPECT_THAT(track.warnings, has_warning("speed_changes"));
  // Flights before and after show that the time stamps are correct.
  const DropTrack fewer =
      tracked_from(drop, static_cast<int>(.5 * drop.seconds * drop.frames_per_s), false);
  ASSERT_FALSE(fewer.bounces.empty()) << fewer.reason;
  EXPECT_THAT(fewer.warnings, Not(has_warning("speed_changes")));
  EXPECT_NEAR(fewer.bounces.front().drop_mm.value, drop.drop_mm, .1 * drop.drop_mm);
}

/// A film of some of a drop's frames, at evenly spaced time stamps.
DropTrack tracked_frames(const DrawnDrop& drop, const std::vector<int>& frames, double plays_at) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "drop.mp4";
  vision::FilmWriter film(file, plays_at);
  const cv::Mat scene = drop.scene();
  for (const int frame : frames) film.add(drop.picture(frame, scene));
  film.close();
  return track_drop(file);
}

/// Lasts longer, so that bounces remain if the first is missed.
DrawnDrop bouncy_drop() {
  DrawnDrop drop = small_drop();
  drop.seconds = 2;
  drop.restitution = .8;
  drop.sideways_px_s = 5;
  return drop;
}

void expect_first_bounce(const DropTrack& track, const DrawnDrop& drop, double height_off) {
  ASSERT_FALSE(track.bounces.empty()) << track.reason;
  const Bounce& first = track.bounces.front();
  EXPECT_EQ(first.number, 1);
  EXPECT_NEAR(first.restitution.value, drop.restitution, .015);
  EXPECT_NEAR(first.drop_mm.value, drop.drop_mm, height_off * drop.drop_mm);
}

TEST(TrackDrop, FramesThatRepeatAreLeftOut) {
  const DrawnDrop drop = bouncy_drop();
  std::vector<int> frames;
  for (int k = 0; k < 2 * drop.frames(); ++k) frames.push_back(k / 2);
  const DropTrack track = tracked_frames(drop, frames, 2 * drop.frames_per_s);
  EXPECT_EQ(track.status, MeasureStatus::ok) << track.reason;
  EXPECT_THAT(track.warnings, has_warning("repeated_frames"));
  expect_first_bounce(track, drop, .03);
}

TEST(TrackDrop, FramesOfALowerRateWithRepeatsAmongThemGetTheirTimesBack) {
  DrawnDrop drop = bouncy_drop();
  drop.frames_per_s = 50;
  std::vector<int> frames;
  for (int k = 0; k < 120; ++k) frames.push_back(5 * k / 6);
  const DropTrack track = tracked_frames(drop, frames, 60);
  EXPECT_EQ(track.status, MeasureStatus::ok) << track.reason;
  EXPECT_THAT(track.warnings, has_warning("repeated_frames"));
  expect_first_bounce(track, drop, .03);
  EXPECT_NEAR(track.film.frames_per_s, 50, .1);
}

TEST(TrackDrop, FramesThatAreLeftOutBehindEvenStampsAreSeenInTheFlights) {
  const DrawnDrop drop = bouncy_drop();
  std::vector<int> frames;
  for (int k = 0; k < drop.frames(); ++k) {
    if (k != 20 && k != 34 && k != 35 && k != 47 && k != 75) frames.push_back(k);
  }
  const DropTrack track = tracked_frames(drop, frames, drop.frames_per_s);
  EXPECT_EQ(track.status, MeasureStatus::flagged) << track.reason;
  EXPECT_THAT(track.warnings, has_warning("skipped_frames"));
  expect_first_bounce(track, drop, .04);
}

TEST(TrackDrop, AFilmThatChangesItsSpeedIsNamedSo) {
  DrawnDrop drop = bouncy_drop();
  drop.frames_per_s = 240;
  std::vector<int> frames;
  for (int k = 0; k < 90; k += 8) frames.push_back(k);
  for (int k = 90; k < 330; k += 2) frames.push_back(k);
  for (int k = 330; k < drop.frames(); k += 8) frames.push_back(k);
  const DropTrack track = tracked_frames(drop, frames, 30);
  EXPECT_NE(track.status, MeasureStatus::ok);
  if (track.bounces.empty()) {
    EXPECT_THAT(track.reason, HasSubstr("the film changes its speed"));
  } else {
    EXPECT_THAT(track.warnings, has_warning("speed_changes"));
  }
}

/// A folder of frames with some missing, whose time still passes.
DropTrack tracked_without(const DrawnDrop& drop, int from, int to) {
  const TemporaryFolder folder;
  const cv::Mat scene = drop.scene();
  for (int frame = 0; frame < drop.frames(); ++frame) {
    if (frame >= from && frame < to) continue;
    write_picture(folder.path() / ("frame" + std::to_string(frame) + ".png"),
                  drop.picture(frame, scene));
  }
  return track_drop({folder.path(), drop.frames_per_s});
}

TEST(TrackDrop, BouncesAreNumberedFromTheFirstOneThoughItIsNotSeen) {
  // It falls from .2 s to .426 s, and again until .787 s and 1.076 s.
  const DropTrack track = tracked_without(bouncy_drop(), 23, 40);
  ASSERT_FALSE(track.bounces.empty()) << track.reason;
  EXPECT_EQ(track.status, MeasureStatus::flagged);
  EXPECT_THAT(track.warnings, has_warning("first_bounce_missing"));
  EXPECT_FALSE(track.has_first_bounce());
  EXPECT_EQ(track.bounces.front().number, 2);
  EXPECT_NEAR(track.bounces.front().time_s, .787, .01);
  EXPECT_THAT(track.unread_bounces, ::testing::SizeIs(1));
}

TEST(TrackDrop, BouncesThatAreNotSeenAreCounted) {
  const DropTrack track = tracked_without(bouncy_drop(), 42, 53);
  ASSERT_FALSE(track.bounces.empty()) << track.reason;
  EXPECT_TRUE(track.has_first_bounce());
  EXPECT_THAT(track.warnings, Not(has_warning("first_bounce_missing")));
  ASSERT_GE(track.bounces.size(), 2U);
  EXPECT_EQ(track.bounces[1].number, 3);
  ASSERT_THAT(track.unread_bounces, ::testing::SizeIs(1));
  EXPECT_EQ(track.unread_bounces.front().number, 2);
  EXPECT_NEAR(track.unread_bounces.front().time_s.value_or(0), .787, .01);
}

TEST(TrackDrop, AFilmThatPlaysTooFastForAnyBenchIsFlagged) {
  const DrawnDrop drop = small_drop();
  const DropTrack track = tracked(drop, {}, 6000);
  EXPECT_EQ(track.status, MeasureStatus::flagged);
  ASSERT_THAT(track.warnings, has_warning("frame_rate"));
  EXPECT_THAT(track.warnings.front().message, HasSubstr("slower or faster"));
}

/// In each frame, every other row comes from half a frame interval later.
std::filesystem::path interlaced_film(const TemporaryFolder& folder, DrawnDrop drop) {
  const double frames_per_s = drop.frames_per_s;
  drop.frames_per_s *= 2;
  const auto file = folder.path() / "interlaced.mp4";
  vision::FilmWriter film(file, frames_per_s);
  const cv::Mat scene = drop.scene();
  for (int frame = 0; frame + 1 < drop.frames(); frame += 2) {
    Picture woven = drop.picture(frame, scene);
    const Picture later = drop.picture(frame + 1, scene);
    const auto row_bytes = static_cast<std::ptrdiff_t>(3) * woven.width;
    for (std::ptrdiff_t row = 1; row < woven.height; row += 2) {
      std::copy_n(later.bgr.begin() + row * row_bytes, row_bytes,
                  woven.bgr.begin() + row * row_bytes);
    }
    film.add(woven);
  }
  film.close();
  return file;
}

TEST(TrackDrop, InterlacedFilmsAreRefusedWithTheRemedy) {
  DrawnDrop drop = small_drop();
  drop.frames_per_s = 30;
  const TemporaryFolder folder;
  const DropTrack track = track_drop(interlaced_film(folder, drop));
  EXPECT_EQ(track.status, MeasureStatus::refused);
  EXPECT_THAT(track.reason, ::testing::AllOf(HasSubstr("interlaced"), HasSubstr("ffmpeg")));
}

}  // namespace
}  // namespace repose::vision
