#include "vision/hints/hint_file.h"

#include <string>

#include <gmock/gmock.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "tests/support/temporary_folder.h"
#include "tests/vision/pictures.h"

namespace repose::vision {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::SizeIs;

class HintFile : public ::testing::Test {
 protected:
  std::filesystem::path picture() const { return folder_.path() / "heap.jpg"; }
  PictureSettings read_all(PictureSettings given = {}) const {
    return with_saved_hints(std::move(given), picture());
  }
  MeasureOptions read(MeasureOptions options = {}) const {
    return read_all({.measuring = std::move(options), .scale = {}}).measuring;
  }
  void save(const MeasureOptions& options) const {
    save_hints({.measuring = options, .scale = {}}, picture());
  }
  void write_camera() const {
    base::write_whole_file(folder_.path() / "camera.toml",
                           "width_px = 300\nheight_px = 200\nfocal_px = 400\ncentre_x_px = 150\n"
                           "centre_y_px = 100\n");
  }
  std::string complaint(const std::string& text) const {
    base::write_whole_file(hint_file_of(picture()), text);
    try {
      read();
    } catch (const base::InputError& error) {
      return error.what();
    }
    return {};
  }
  testing::TemporaryFolder folder_;
};

TEST_F(HintFile, WithoutOneNothingChanges) {
  const MeasureOptions options = read();
  EXPECT_TRUE(options.hints.empty());
  EXPECT_EQ(options.hints.source, "");
}

TEST_F(HintFile, WhatIsSavedIsReadAgain) {
  MeasureOptions options;
  options.hints.turn_deg = 270;
  options.hints.heap = Box{.x = 1, .y = 2, .width = 30, .height = 40};
  options.hints.half = Side::right;
  options.hints.ground = Segment{{0, 41.5}, {31, 40}};
  options.hints.keep = {{10, 20}, {11, 21.25}};
  options.hints.drop = {{3, 4}};
  options.excluded = {{5, 6, 7, 8}};
  options.camera_pitch_rad = 4 * kDegree;
  options.hints.mask_file = folder_.path() / "a mask \"here\".png";
  write_picture(options.hints.mask_file, picture_of(cv::Mat3b(20, 30, cv::Vec3b(9, 9, 9))));
  save(options);
  for (int time = 0; time < 2; ++time) {  // hints given again are not duplicated
    const MeasureOptions again = read(time == 0 ? MeasureOptions{} : options);
    EXPECT_EQ(again.hints.source, "heap.jpg.repose.toml");
    ASSERT_TRUE(again.hints.heap && again.hints.ground && again.camera_pitch_rad);
    EXPECT_EQ(again.hints.turn_deg, 270);
    EXPECT_EQ(again.hints.heap->height, 40);
    EXPECT_EQ(again.hints.ground->from.y, 41.5);
    EXPECT_EQ(again.hints.half, Side::right);
    EXPECT_THAT(again.hints.keep, SizeIs(2));
    EXPECT_EQ(again.hints.keep.at(1).y, 21.25);
    EXPECT_THAT(again.hints.drop, SizeIs(1));
    EXPECT_THAT(again.excluded, SizeIs(1));
    EXPECT_NEAR(*again.camera_pitch_rad, 4 * kDegree, 1e-6);
    EXPECT_EQ(again.hints.mask.width, 20) << "turned with the picture";
  }
}

TEST_F(HintFile, WhatItSaysIsKeptWhenItIsSavedAgain) {
  write_picture(folder_.path() / "mask.png", picture_of(cv::Mat3b(20, 30, cv::Vec3b(9, 9, 9))));
  base::write_whole_file(hint_file_of(picture()),
                         "ground = [0, 18, 30, 18]\nmask = \"mask.png\"\n");
  save(read());
  EXPECT_EQ(read().hints.mask.width, 30);
  EXPECT_TRUE(read().hints.ground);
}

TEST_F(HintFile, WhatIsGivenStandsAboveTheFile) {
  base::write_whole_file(hint_file_of(picture()), "heap = [1, 2, 3, 4]\npitch_deg = 3\n");
  MeasureOptions given;
  given.hints.heap = Box{.x = 9, .y = 9, .width = 9, .height = 9};
  given.camera_pitch_rad = 0;
  const MeasureOptions options = read(given);
  EXPECT_EQ(options.hints.heap->x, 9);
  EXPECT_EQ(options.camera_pitch_rad, 0);
}

TEST_F(HintFile, ScaleAndLensAreSavedAndReadAgain) {
  write_camera();
  PictureSettings board;
  board.scale.lens_file = folder_.path() / "camera.toml";
  board.scale.finds_board = true;
  board.scale.square_mm = 23.5;
  board.scale.board_offset_mm = 120;
  save_hints(board, picture());
  PictureSettings again = read_all();
  ASSERT_TRUE(again.scale.lens);
  EXPECT_EQ(again.scale.lens->focal_px.value, 400);
  EXPECT_TRUE(again.scale.finds_board);
  EXPECT_EQ(again.scale.square_mm, 23.5);
  EXPECT_EQ(again.scale.board_offset_mm, 120);
  EXPECT_EQ(again.measuring.hints.source, hint_file_of(picture()).filename())
      << "a lens changes the angle";

  PictureSettings given;
  given.scale.scale = ScaleBar{.line = {{0, 10}, {200, 10.5}}, .length_mm = 80};
  again = read_all(given);
  EXPECT_FALSE(again.scale.finds_board) << "one scale: the one that is given";
  EXPECT_TRUE(again.scale.lens);

  save_hints(given, picture());
  again = read_all();
  ASSERT_TRUE(again.scale.scale);
  EXPECT_EQ(again.scale.scale->line.to.y, 10.5);
  EXPECT_EQ(again.scale.scale->length_mm, 80);
  EXPECT_FALSE(again.scale.lens);
  EXPECT_EQ(again.measuring.hints.source, "") << "two points and a distance do not";
}

TEST_F(HintFile, AllThatIsWrongIsSaidAtOnce) {
  EXPECT_THAT(complaint("heap = [1, 2, 3]\nground = 'level'\nkeep = [[1, nan]]\ndrop = 3\n"
                        "mask = 7\npitch_deg = 'low'\nhaep = [1, 2, 3, 4]\n"),
              AllOf(HasSubstr(":1: heap: must be [x, y, width, height]"),
                    HasSubstr(":2: ground: must be [x1, y1, x2, y2]"), HasSubstr(":3: keep"),
                    HasSubstr(":4: drop"), HasSubstr(":5: mask"), HasSubstr(":6: pitch_deg"),
                    HasSubstr(":7: haep: is not a hint")));
  EXPECT_THAT(complaint("scale = [0, 0, 5, 0, 40]\nsquare_mm = -1\nboard = 'yes'\n"
                        "board_behind_mm = 20\n"),
              AllOf(HasSubstr(":1: scale: must be [x1, y1, x2, y2, mm]"),
                    HasSubstr(":2: square_mm: must be a number above 0"),
                    HasSubstr(":3: board: must be true or false"),
                    HasSubstr(":4: board_behind_mm: needs the focal length")));
  EXPECT_THAT(complaint("scale = [0, 0, 50, 0, 40]\nboard = true\n"), HasSubstr("one scale"));
  EXPECT_THAT(complaint("square_mm = 20\n"), HasSubstr("it needs board = true"));
  EXPECT_THAT(complaint("camera_file = \"none.toml\"\n"), HasSubstr("none.toml"));
  EXPECT_THAT(complaint("heap = [1, 2\n"), HasSubstr("must be TOML"));
  EXPECT_THAT(complaint("rotate = 45\n"), HasSubstr("rotate: must be one of 90, 180, 270"));
  EXPECT_THAT(complaint("half = \"both\"\n"), HasSubstr("must be \"left\" or \"right\""));
  EXPECT_THAT(complaint("mask = \"nowhere.png\"\n"), HasSubstr("nowhere.png"));
}

}  // namespace
}  // namespace repose::vision
