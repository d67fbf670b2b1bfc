#include "vision/film/film_angle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "base/units.h"
#include "tests/support/drawn_heap_film.h"
#include "tests/support/error_of.h"
#include "tests/support/heap_picture.h"
#include "tests/support/temporary_folder.h"
#include "tests/vision/warnings.h"
#include "vision/video/film_writer.h"

namespace repose::vision {
namespace {

using repose::testing::draw_heap;
using repose::testing::DrawnHeapFilm;
using repose::testing::heap_truth;
using repose::testing::small_heap;
using repose::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class FilmAngleOf : public ::testing::Test {
 protected:
  std::filesystem::path write(const std::vector<Picture>& frames, double frames_per_s,
                              const char* name = "heap.mp4") const {
    const auto file = folder_.path() / name;
    vision::FilmWriter film(file, frames_per_s);
    for (const Picture& frame : frames) film.add(frame);
    film.close();
    return file;
  }
  FilmAngle measured(const DrawnHeapFilm& film, const MeasureOptions& options = {}) const {
    return measure_film(write(film.pictures(), film.frames_per_s), options);
  }

  TemporaryFolder folder_;
};

using FilmAngleAccuracy = FilmAngleOf;

double error_deg(const ReposeAngle& angle, const DrawnHeapFilm& film) {
  return std::abs(angle.angle_rad.value() - heap_truth(film.scene).mean_rad().value()) / kDegree;
}

void expect_heaps_angle(const FilmAngle& film, const DrawnHeapFilm& drawn) {
  ASSERT_TRUE(film.heap.angle.angle_rad) << film.heap.angle.reason;
  EXPECT_LT(error_deg(film.heap.angle, drawn), .3);
  EXPECT_LT(error_deg(film.heap.angle, drawn), film.heap.angle.uncertainty_rad.value() / kDegree);
}

TEST_F(FilmAngleOf, AHeapThatCameToRestIsThatOfItsLastSecond) {
  const DrawnHeapFilm drawn{.scene = small_heap(), .noise = 20};
  const std::vector<Picture> frames = drawn.pictures();
  const FilmAngle film = measure_film(write(frames, drawn.frames_per_s));
  expect_heaps_angle(film, drawn);
  EXPECT_EQ(film.heap.angle.status, MeasureStatus::ok);
  EXPECT_THAT(film.heap.angle.warnings, Not(has_warning("short_rest")));
  ASSERT_TRUE(film.stretch);
  EXPECT_GT(film.stretch->from_s, drawn.grows_s - .05);
  EXPECT_NEAR(film.stretch->to_s - film.stretch->from_s, 1, .15);
  EXPECT_EQ(film.film.frames, drawn.frames());
  EXPECT_NEAR(film.film.frames_per_s, drawn.frames_per_s, .01);
}

TEST_F(FilmAngleOf, AFilmThatLiesOnItsSideIsTurnedAsItIsRead) {
  const DrawnHeapFilm drawn{.scene = small_heap(), .noise = 5};
  std::vector<Picture> frames = drawn.pictures();
  for (Picture& frame : frames) frame = turned(std::move(frame), 270);
  const auto file = write(frames, drawn.frames_per_s);
  EXPECT_FALSE(measure_film(file).heap.angle.angle_rad);
  const FilmAngle film = measure_film({file, {}, {}, 90});
  expect_heaps_angle(film, drawn);
  EXPECT_EQ(film.picture.width, drawn.pictures().front().width);
}

TEST_F(FilmAngleAccuracy, ManyFramesAreNearerToTheTruthThanOneOfThem) {
  double of_films_deg = 0, of_single_frames_deg = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const DrawnHeapFilm drawn{.scene = small_heap(seed), .noise = 30};
    const std::vector<Picture> frames = drawn.pictures();
    of_films_deg += error_deg(measure_film(write(frames, drawn.frames_per_s)).heap.angle, drawn);
    of_single_frames_deg += error_deg(measure_repose_angle(frames.back()), drawn);
  }
  EXPECT_LT(of_films_deg, of_single_frames_deg);
}

TEST_F(FilmAngleOf, ASceneWithFlickerATimerAndAHandAtTheEndIsThatBeforeTheHand) {
  const DrawnHeapFilm drawn{
      .scene = small_heap(4), .hand_s = .4, .flicker = .04, .has_timer = true};
  const FilmAngle film = measured(drawn);
  expect_heaps_angle(film, drawn);
  ASSERT_TRUE(film.stretch);
  EXPECT_NEAR(film.stretch->to_s, drawn.grows_s + drawn.rests_s, .17);
  EXPECT_THAT(film.heap.angle.warnings, AllOf(has_warning("moves_after"), has_warning("writing")));
}

TEST_F(FilmAngleOf, AHeapThatNeverRestsIsRefusedWithWhereItMoves) {
  const FilmAngle film = measured({.scene = small_heap(1, 240), .grows_s = 1, .rests_s = 0});
  EXPECT_FALSE(film.heap.angle.angle_rad);
  EXPECT_FALSE(film.stretch);
  EXPECT_FALSE(film.picture.empty()) << "it is shown why";
  EXPECT_THAT(film.heap.angle.reason,
              AllOf(HasSubstr("nothing in the film is at rest: at last it moved within"),
                    HasSubstr("Fix: film at least 1 s after the last grain has stopped")));
}

TEST_F(FilmAngleOf, AHeapThatRestsAndThenGrowsOnIsRefused) {
  std::vector<Picture> frames =
      DrawnHeapFilm{.scene = small_heap(1, 240), .grows_s = 0, .rests_s = 1}.pictures();
  auto bigger = small_heap(1, 240);
  bigger.form.base *= 1.2;
  bigger.form.grains_high *= 1.2;
  for (const Picture& frame :
       DrawnHeapFilm{.scene = bigger, .grows_s = 0, .rests_s = .4}.pictures()) {
    frames.push_back(frame);
  }
  const FilmAngle film = measure_film(write(frames, 12));
  EXPECT_THAT(film.heap.angle.reason, HasSubstr("the film's end still moves: after a rest until"));
}

TEST_F(FilmAngleOf, AShortFilmAtRestIsMeasuredAndFlagged) {
  const DrawnHeapFilm drawn{.scene = small_heap(4), .grows_s = 0, .rests_s = .75};
  const FilmAngle film = measured(drawn);
  expect_heaps_angle(film, drawn);
  EXPECT_EQ(film.heap.angle.status, MeasureStatus::flagged);
  EXPECT_THAT(film.heap.angle.warnings, has_warning("short_rest"));
}

/// The picture shifted to the left by `left_px`.
Picture moved(const Picture& picture, int left_px) {
  Picture seen = picture;
  const std::ptrdiff_t from = std::ptrdiff_t{3} * left_px;
  std::rotate(seen.bgr.begin(), seen.bgr.begin() + from, seen.bgr.end());
  return seen;
}

TEST_F(FilmAngleOf, ACutAndACameraThatMovesAreNamed) {
  const Picture heap = draw_heap(small_heap(1, 240)).picture;
  std::vector<Picture> shaken, cut(8, heap);
  for (int frame = 0; frame < 12; ++frame) shaken.push_back(moved(heap, 2 * frame));
  EXPECT_THAT(measure_film(write(shaken, 12)).heap.angle.reason, HasSubstr("the camera moves"));
  Picture other = heap;
  for (std::uint8_t& byte : other.bgr) byte = static_cast<std::uint8_t>(255 - byte);
  cut.insert(cut.end(), 8, other);
  EXPECT_THAT(measure_film(write(cut, 12)).heap.angle.reason,
              HasSubstr("another scene begins with frame 9. Rule: one shot."));
}

TEST_F(FilmAngleOf, AFilmOfFewFramesOrFewASecondIsRefused) {
  const Picture heap = draw_heap(small_heap(1, 240)).picture;
  EXPECT_THAT(measure_film(write({heap}, 25)).heap.angle.reason, HasSubstr("Rule: 8 or more"));
  EXPECT_THAT(measure_film(write(std::vector(9, heap), 2)).heap.angle.reason,
              HasSubstr("the film has 2 frames per second. Rule: 4 or more. Fix: "));
}

TEST_F(FilmAngleOf, NoiseIsRefused) {
  std::vector<Picture> frames(12, Picture{.width = 160, .height = 120, .bgr = {}});
  std::minstd_rand random(5);
  for (Picture& frame : frames) {
    for (int k = 0; k < 3 * frame.width * frame.height; ++k) {
      frame.bgr.push_back(static_cast<std::uint8_t>(random() >> 8U));
    }
  }
  const FilmAngle film = measure_film(write(frames, 25));
  EXPECT_EQ(film.heap.angle.status, MeasureStatus::refused);
  EXPECT_THAT(film.heap.angle.reason, HasSubstr("Fix: "));
}

TEST_F(FilmAngleOf, WhatMovesInAnExcludedBoxIsNoMovement) {
  const DrawnHeapFilm drawn{.scene = small_heap(1, 240), .grows_s = 0, .rests_s = 0, .hand_s = .9};
  EXPECT_FALSE(measured(drawn).stretch);
  MeasureOptions options;
  options.excluded = {{.x = 125, .y = 45, .width = 115, .height = 55}};
  EXPECT_TRUE(measured(drawn, options).stretch);
}

TEST_F(FilmAngleOf, UnevenTimeStampsAreUsedAndSaid) {
  const DrawnHeapFilm drawn{
      .scene = small_heap(1, 240), .frames_per_s = 20, .grows_s = 0, .rests_s = .7, .noise = 1};
  const auto file = write(drawn.pictures(), drawn.frames_per_s, "heap.gif");
  std::string bytes = repose::testing::text_of(file);
  const std::string extension("\x21\xF9\x04", 3);
  constexpr std::size_t kDelay = 4;  // hundredths of a second, after the extension's flags
  bool is_long = false;
  for (std::size_t at = bytes.find(extension); at != std::string::npos;
       at = bytes.find(extension, at + 1)) {
    bytes[at + kDelay] = is_long ? 6 : 4;
    is_long = !is_long;
  }
  std::ofstream(file, std::ios::binary) << bytes;
  const FilmAngle film = measure_film(file);
  EXPECT_THAT(film.heap.angle.warnings, has_warning("variable_rate"));
  ASSERT_TRUE(film.stretch);
  EXPECT_NEAR(film.film.length_s, 13 * .05, .03);
}

TEST_F(FilmAngleOf, AFileThatIsEmptyOrCutOffIsSaid) {
  folder_.write("empty.mp4", std::string());
  EXPECT_THAT(error_of([&] { measure_film(folder_.path() / "empty.mp4"); }),
              HasSubstr("empty.mp4: is empty or cannot be read. Fix: "));
  const DrawnHeapFilm drawn{.scene = small_heap(1, 240), .grows_s = 0, .rests_s = .2};
  const auto file = write(drawn.pictures(), drawn.frames_per_s);
  const std::string bytes = repose::testing::text_of(file);
  folder_.write("cut.mp4", bytes.substr(0, bytes.size() / 2));
  EXPECT_THAT(error_of([&] { measure_film(folder_.path() / "cut.mp4"); }),
              HasSubstr("cut.mp4: the film cannot be decoded: it is damaged"));
}

}  // namespace
}  // namespace repose::vision
