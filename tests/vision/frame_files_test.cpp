#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"
#include "tests/vision/plain_picture.h"
#include "vision/film/film_reader.h"
#include "vision/picture/picture.h"

namespace repose::vision {
namespace {

using repose::testing::TemporaryFolder;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

std::vector<std::pair<std::string, std::int64_t>> listed(const TemporaryFolder& folder) {
  std::vector<std::pair<std::string, std::int64_t>> names;
  for (const FrameFile& frame : frame_files(folder.path())) {
    names.emplace_back(frame.file.filename().string(), frame.place);
  }
  return names;
}

TEST(FrameFiles, AreInTheOrderOfTheirNumbers) {
  const TemporaryFolder folder;
  for (const char* name : {"f10.png", "f9.png", "f8.PNG", "notes.txt", ".f1.png"}) {
    folder.write(name, std::string("x"));
  }
  EXPECT_THAT(listed(folder),
              ElementsAre(Pair("f8.PNG", 0), Pair("f9.png", 1), Pair("f10.png", 2)));
}

TEST(FrameFiles, MissingNumbersLeaveGaps) {
  const TemporaryFolder folder;
  for (const char* name : {"a_01_b.jpg", "a_02_b.jpg", "a_05_b.jpg"}) {
    folder.write(name, std::string("x"));
  }
  EXPECT_THAT(listed(folder),
              ElementsAre(Pair("a_01_b.jpg", 0), Pair("a_02_b.jpg", 1), Pair("a_05_b.jpg", 4)));
}

TEST(FrameFiles, EveryTenthIsAPlaceEach) {
  const TemporaryFolder folder;
  for (const char* name : {"f100.png", "f110.png", "f130.png"}) {
    folder.write(name, std::string("x"));
  }
  EXPECT_THAT(listed(folder),
              ElementsAre(Pair("f100.png", 0), Pair("f110.png", 1), Pair("f130.png", 3)));
}

TEST(FrameFiles, WhatIsNoFilmIsRefused) {
  const std::vector<std::pair<std::vector<const char*>, const char*>> cases = {
      {{}, "no pictures"},
      {{"1.txt"}, "no pictures"},
      {{"f1.png", "heap.png"}, "no number"},
      {{"f1.png", "g2.png"}, "differ in more than a number"},
      {{"f1.png", "f2.jpg"}, "differ in more than a number"},
      {{"f1.png", "f01.png"}, "the same number"},
      {{"f99999999999999999999999.png"}, "no number"}};
  for (const auto& [names, what] : cases) {
    const TemporaryFolder folder;
    for (const char* name : names) folder.write(name, std::string("x"));
    EXPECT_THAT(error_of([&] { frame_files(folder.path()); }),
                AllOf(HasSubstr(what), HasSubstr("Rule: "), HasSubstr("Fix: ")));
  }
}

TEST(FilmReader, ReadsAFolderAtItsRateAndSkipsWhatIsMissing) {
  const TemporaryFolder folder;
  write_picture(folder.path() / "f1.png", plain_picture(20, 10, 10));
  write_picture(folder.path() / "f2.png", plain_picture(20, 10, 20));
  write_picture(folder.path() / "f4.png", plain_picture(20, 10, 40));
  FilmReader film({folder.path(), 50});
  EXPECT_EQ(film.claimed_frames(), 3);
  FilmFrame frame;
  ASSERT_TRUE(film.next(frame));
  EXPECT_EQ(frame.bgr.at<cv::Vec3b>(0, 0)[0], 10);
  EXPECT_EQ(frame.time_s, 0);
  ASSERT_TRUE(film.skip(frame));
  ASSERT_TRUE(film.next(frame));
  EXPECT_EQ(frame.bgr.at<cv::Vec3b>(0, 0)[0], 40);
  EXPECT_NEAR(frame.time_s, .06, 1e-12);
  EXPECT_FALSE(film.next(frame));
}

TEST(FilmReader, RefusesAFolderOfSeveralSizesOrWithoutARate) {
  const TemporaryFolder folder;
  write_picture(folder.path() / "f1.png", plain_picture(20, 10, 10));
  write_picture(folder.path() / "f2.png", plain_picture(20, 12, 20));
  EXPECT_THAT(error_of([&] {
                FilmReader film({folder.path(), 50});
                FilmFrame frame;
                while (film.next(frame)) continue;
              }),
              HasSubstr("size of its frames changes"));
  EXPECT_THAT(error_of([&] { FilmReader film(folder.path()); }), HasSubstr("--fps"));
}

}  // namespace
}  // namespace repose::vision
