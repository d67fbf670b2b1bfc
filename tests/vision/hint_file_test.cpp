#include "vision/hints/hint_file.h"

#include <stdexcept>
#include <string>

#include <gmock/gmock.h>

#include "base/whole_file.h"
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
  MeasureOptions read(MeasureOptions options = {}) const {
    return with_saved_hints(std::move(options), picture());
  }
  std::string complaint(const std::string& text) const {
    base::write_whole_file(hint_file_of(picture()), text);
    try {
      read();
    } catch (const std::invalid_argument& error) {
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
  options.hints.heap = Box{.x = 1, .y = 2, .width = 30, .height = 40};
  options.hints.ground = Segment{{0, 41.5}, {31, 40}};
  options.hints.keep = {{10, 20}, {11, 21.25}};
  options.hints.drop = {{3, 4}};
  options.excluded = {{5, 6, 7, 8}};
  options.camera_pitch_rad = 4 * kDegree;
  options.hints.mask_file = folder_.path() / "a mask \"here\".png";
  write_picture(options.hints.mask_file, picture_of(cv::Mat3b(20, 30, cv::Vec3b(9, 9, 9))));
  save_hints(options, picture());
  for (int time = 0; time < 2; ++time) {  // what is given again is there once
    const MeasureOptions again = read(time == 0 ? MeasureOptions{} : options);
    EXPECT_EQ(again.hints.source, "heap.jpg.repose.toml");
    ASSERT_TRUE(again.hints.heap && again.hints.ground && again.camera_pitch_rad);
    EXPECT_EQ(again.hints.heap->height, 40);
    EXPECT_EQ(again.hints.ground->from.y, 41.5);
    EXPECT_THAT(again.hints.keep, SizeIs(2));
    EXPECT_EQ(again.hints.keep.at(1).y, 21.25);
    EXPECT_THAT(again.hints.drop, SizeIs(1));
    EXPECT_THAT(again.excluded, SizeIs(1));
    EXPECT_NEAR(*again.camera_pitch_rad, 4 * kDegree, 1e-6);
    EXPECT_EQ(again.hints.mask.width, 30);
  }
}

TEST_F(HintFile, WhatItSaysIsKeptWhenItIsSavedAgain) {
  write_picture(folder_.path() / "mask.png", picture_of(cv::Mat3b(20, 30, cv::Vec3b(9, 9, 9))));
  base::write_whole_file(hint_file_of(picture()),
                         "ground = [0, 18, 30, 18]\nmask = \"mask.png\"\n");
  save_hints(read(), picture());
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

TEST_F(HintFile, AllThatIsWrongIsSaidAtOnce) {
  EXPECT_THAT(complaint("heap = [1, 2, 3]\nground = 'level'\nkeep = [[1, nan]]\ndrop = 3\n"
                        "mask = 7\npitch_deg = 'low'\nhaep = [1, 2, 3, 4]\n"),
              AllOf(HasSubstr(":1: heap: must be [x, y, width, height]"),
                    HasSubstr(":2: ground: must be [x1, y1, x2, y2]"), HasSubstr(":3: keep"),
                    HasSubstr(":4: drop"), HasSubstr(":5: mask"), HasSubstr(":6: pitch_deg"),
                    HasSubstr(":7: haep: is not a hint")));
  EXPECT_THAT(complaint("heap = [1, 2\n"), HasSubstr("must be TOML"));
  EXPECT_THAT(complaint("mask = \"nowhere.png\"\n"), HasSubstr("nowhere.png"));
}

}  // namespace
}  // namespace repose::vision
