#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include <gmock/gmock.h>

#include "render/film/film.h"
#include "tests/support/drawn_drop.h"
#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"
#include "vision/drawing/drop_overlay.h"
#include "vision/track/drop_track.h"

namespace repose::vision {
namespace {

using repose::testing::DrawnDrop;
using repose::testing::TemporaryFolder;
using ::testing::Contains;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

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
  render::Film film(file, plays_at > 0 ? plays_at : drop.frames_per_s);
  for (int frame = 0; frame < drop.frames(); ++frame) film.add(drop.picture(frame));
  film.close();
  return file;
}

DropTrack tracked(const DrawnDrop& drop, const TrackOptions& options = {}, double plays_at = 0) {
  const TemporaryFolder folder;
  return track_drop(film_of(folder, drop, plays_at), options);
}

/// A line of 100 px somewhere, of its right length.
TrackOptions scaled_options(const DrawnDrop& drop) {
  return {.scale = ScaleBar{.line = {{20, 30}, {20, 130}}, .length_mm = 100 * drop.mm_per_px}};
}

::testing::Matcher<std::vector<Warning>> warns_of(const char* code) {
  return Contains(Field(&Warning::code, code));
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
  ASSERT_THAT(track.warnings, warns_of("frame_rate"));
  EXPECT_THAT(track.warnings[0].message, HasSubstr("times slower"));
  ASSERT_FALSE(track.bounces.empty());
  EXPECT_NEAR(track.bounces[0].restitution.value, .6,
              std::min(.02, track.bounces[0].restitution.uncertainty));
  EXPECT_NEAR(track.bounces[0].rebound_mm.value, 90, 3);
}

TEST(TrackDrop, FollowsTheGrainWhereAHandAndALeaningCameraAreInTheWay) {
  DrawnDrop drop = small_drop();
  drop.has_hand = true;
  drop.lean_rad = .05;
  const DropTrack track = tracked(drop);
  ASSERT_FALSE(track.bounces.empty()) << track.reason;
  EXPECT_NEAR(track.bounces[0].restitution.value, .6, .015);
  EXPECT_NEAR(std::abs(track.lean_rad), .05, .004);
  EXPECT_THAT(track.warnings, warns_of("leaning"));
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
  for (int frame = 0; frame < drop.frames(); ++frame) {
    // Two are missing: their time goes by all the same.
    if (frame == 5 || frame == 30) continue;
    write_picture(folder.path() / ("frame" + std::to_string(frame) + ".png"), drop.picture(frame));
  }
  const DropTrack track = track_drop({folder.path(), drop.frames_per_s});
  ASSERT_FALSE(track.bounces.empty()) << track.reason;
  EXPECT_NEAR(track.bounces.front().restitution.value, drop.restitution, .02);
  EXPECT_EQ(track.film.dropped_frames, 2);
  EXPECT_THAT(track.warnings, warns_of("dropped_frames"));
}

/// Of each frame every other row is that of a frame that was taken half a frame later.
std::filesystem::path interlaced_film(const TemporaryFolder& folder, DrawnDrop drop) {
  const double frames_per_s = drop.frames_per_s;
  drop.frames_per_s *= 2;
  const auto file = folder.path() / "interlaced.mp4";
  render::Film film(file, frames_per_s);
  for (int frame = 0; frame + 1 < drop.frames(); frame += 2) {
    Picture woven = drop.picture(frame);
    const Picture later = drop.picture(frame + 1);
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
