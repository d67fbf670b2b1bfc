#include "vision/video/video_decoder.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <opencv2/core.hpp>

#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"
#include "vision/video/film_writer.h"

namespace repose::vision {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::TemporaryFolder;

constexpr int kDark = 40, kLight = 220;

/// Dark, with a light top quarter.
Picture light_above(int width, int height) {
  Picture picture{.width = width, .height = height, .bgr = {}};
  for (int y = 0; y < height; ++y) {
    picture.bgr.insert(picture.bgr.end(), 3 * static_cast<std::size_t>(width),
                       static_cast<std::uint8_t>(y < height / 4 ? kLight : kDark));
  }
  return picture;
}

void write_film(const std::filesystem::path& file, const Picture& picture, int frames) {
  FilmWriter film(file, 25);
  for (int k = 0; k < frames; ++k) film.add(picture);
  film.close();
}

/// A row of an MP4's display matrix.
std::string row(int first, int second) {
  std::string bytes;
  for (const int number : {first, second, 0}) {
    for (const int shift : {8, 0, -8, -16}) {  // units of 1/65536, the highest byte first
      bytes += static_cast<char>(shift >= 0 ? number >> shift : 0);
    }
  }
  return bytes;
}

constexpr std::size_t kMatrixBytes = 36;

/// A number of two bytes before the binary point and two after it.
std::string fixed(double number) {
  const auto whole = static_cast<std::uint32_t>(number * 65536);
  std::string bytes;
  for (const int shift : {24, 16, 8, 0}) bytes += static_cast<char>(whole >> shift);
  return bytes;
}

/// Sets a film's display width, which is stored after the track's matrix.
void stretch_film(const std::filesystem::path& file, double width) {
  std::string bytes = testing::text_of(file);
  bytes.replace(bytes.rfind(row(1, 0) + row(0, 1)) + kMatrixBytes, 4, fixed(width));
  std::ofstream(file, std::ios::binary) << bytes;
}

void turn_film(const std::filesystem::path& file, const std::string& matrix) {
  std::string bytes = testing::text_of(file);
  const std::string unturned = row(1, 0) + row(0, 1);
  // The film has one such matrix and its track another, which decides.
  bytes.replace(bytes.rfind(unturned), matrix.size(), matrix);
  std::ofstream(file, std::ios::binary) << bytes;
}

cv::Mat first_picture(const std::filesystem::path& file) {
  VideoDecoder film(file);
  cv::Mat bgr;
  if (film.advance()) film.copy_to(bgr);
  return bgr;
}

TEST(VideoDecoder, TurnsPicturesAsTheFilmSays) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "film.mp4";
  struct Case {
    std::string matrix;
    cv::Size size;
    cv::Point light;
    cv::Point dark;
  };
  for (const Case& turned : {Case{row(1, 0) + row(0, 1), {64, 48}, {32, 3}, {32, 44}},
                             {row(0, 1) + row(-1, 0), {48, 64}, {44, 32}, {3, 32}},
                             {row(-1, 0) + row(0, -1), {64, 48}, {32, 44}, {32, 3}},
                             {row(0, -1) + row(1, 0), {48, 64}, {3, 32}, {44, 32}}}) {
    write_film(file, light_above(64, 48), 1);
    turn_film(file, turned.matrix);
    const cv::Mat bgr = first_picture(file);
    ASSERT_EQ(bgr.size(), turned.size);
    EXPECT_NEAR(bgr.at<cv::Vec3b>(turned.light)[1], kLight, 4) << turned.size;
    EXPECT_NEAR(bgr.at<cv::Vec3b>(turned.dark)[1], kDark, 4) << turned.size;
  }
}

/// Dark, with a light upper left quarter.
Picture light_corner(int width, int height) {
  Picture picture = light_above(width, 2 * height);
  picture.height = height;
  picture.bgr.resize(picture.bgr.size() / 2);
  for (std::size_t k = 0; k < picture.bgr.size(); ++k) {
    const auto x = static_cast<int>(k / 3) % width;
    if (x >= width / 2) picture.bgr[k] = kDark;
  }
  return picture;
}

TEST(VideoDecoder, MirrorsPicturesAsTheFilmSays) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "film.mp4";
  struct Case {
    std::string matrix;
    cv::Size size;
    cv::Point light;
  };
  for (const Case& shown : {Case{row(-1, 0) + row(0, 1), {64, 48}, {50, 10}},
                            {row(1, 0) + row(0, -1), {64, 48}, {14, 38}},
                            {row(0, 1) + row(1, 0), {48, 64}, {10, 14}},
                            {row(0, -1) + row(-1, 0), {48, 64}, {38, 50}},
                            {row(2, 0) + row(0, 2), {64, 48}, {14, 10}}}) {
    write_film(file, light_corner(64, 48), 1);
    turn_film(file, shown.matrix);
    const cv::Mat bgr = first_picture(file);
    ASSERT_EQ(bgr.size(), shown.size);
    EXPECT_NEAR(bgr.at<cv::Vec3b>(shown.light)[1], kLight, 4) << shown.light;
    const cv::Point other(shown.size.width - shown.light.x, shown.size.height - shown.light.y);
    EXPECT_NEAR(bgr.at<cv::Vec3b>(other)[1], kDark, 4) << shown.light;
  }
}

TEST(VideoDecoder, RefusesPicturesThatAreToBeShownAskew) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "film.mp4";
  for (const std::string& matrix : {row(1, 1) + row(-1, 1), row(1, 1) + row(0, 1)}) {
    write_film(file, light_above(64, 48), 1);
    turn_film(file, matrix);
    EXPECT_THAT(error_of([&] { first_picture(file); }),
                AllOf(HasSubstr("turned by"), HasSubstr("Fix: ")));
  }
}

TEST(VideoDecoder, MakesPixelsSquareAsTheFilmSaysTheyAreNot) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "film.mp4";
  struct Case {
    double shown_width;
    int width;
  };
  for (const Case& wide : {Case{128, 128}, Case{32, 32}, Case{64, 64}}) {
    write_film(file, light_corner(64, 48), 2);
    stretch_film(file, wide.shown_width);
    const cv::Mat bgr = first_picture(file);
    ASSERT_EQ(bgr.size(), cv::Size(wide.width, 48));
    EXPECT_NEAR(bgr.at<cv::Vec3b>(10, wide.width / 4)[1], kLight, 4) << wide.width;
    EXPECT_NEAR(bgr.at<cv::Vec3b>(10, 3 * wide.width / 4)[1], kDark, 4) << wide.width;
    EXPECT_EQ(VideoDecoder(file).claimed_pixels(), wide.width * 48);
  }
  write_film(file, light_corner(64, 48), 2);
  stretch_film(file, 640);
  EXPECT_THAT(error_of([&] { VideoDecoder(file).claimed_pixels(); }),
              AllOf(HasSubstr("pixels are 10 times as wide as high"), HasSubstr("Fix: ")));
}

TEST(VideoDecoder, ReadsTheLastColumnsOfAnyWidth) {
  const TemporaryFolder folder;
  for (const char* name : {"film.mp4", "film.gif"}) {
    for (const int width : {2, 8, 18, 33, 63, 65, 85, 86, 127, 129}) {
      write_film(folder.path() / name, light_above(width, 40), 1);
      const cv::Mat bgr = first_picture(folder.path() / name);
      ASSERT_GE(bgr.cols, width - 1) << name << width;
      for (int x = 0; x < bgr.cols; ++x) {
        ASSERT_NEAR(bgr.at<cv::Vec3b>(4, x)[0], kLight, 10) << name << width << " at " << x;
        ASSERT_NEAR(bgr.at<cv::Vec3b>(30, x)[2], kDark, 10) << name << width << " at " << x;
      }
    }
  }
}

TEST(VideoDecoder, SaysWhatTheFilmClaimsOfItself) {
  const TemporaryFolder folder;
  for (const char* name : {"film.mp4", "film.gif"}) {
    write_film(folder.path() / name, light_above(64, 48), 7);
    VideoDecoder film(folder.path() / name);
    EXPECT_EQ(film.claimed_pixels(), 64 * 48) << name;
    EXPECT_NEAR(film.claimed_frames_per_s().value_or(0), 25, 0.01) << name;
    EXPECT_EQ(film.claimed_frames(), 7) << name;
    for (int k = 0; k < 7; ++k) {
      ASSERT_TRUE(film.advance()) << name;
      EXPECT_NEAR(film.time_stamp_s().value_or(-1), k / 25.0, 1e-6) << name;
    }
    EXPECT_FALSE(film.advance()) << name;
    EXPECT_FALSE(film.advance()) << "the end stays the end";
  }
}

TEST(VideoDecoder, RefusesWhatIsNoFilm) {
  const TemporaryFolder folder;
  write_film(folder.path() / "film.mp4", light_above(64, 48), 7);
  const std::string film = testing::text_of(folder.path() / "film.mp4");
  for (const std::string& content :
       {std::string(), film.substr(0, 40), film.substr(0, film.size() / 2),
        std::string("#EXTM3U\nhttp://localhost/film.mp4\n"),
        "ffconcat version 1.0\nfile '" + (folder.path() / "film.mp4").string() + "'\n"}) {
    const auto file = folder.write("other.mp4", content);
    EXPECT_THAT(error_of([&] { VideoDecoder decoder(file); }),
                AllOf(HasSubstr("other.mp4: the film cannot be decoded"), HasSubstr("Fix: ")))
        << content.size();
  }
}

}  // namespace
}  // namespace repose::vision
