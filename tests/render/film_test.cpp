#include "render/film/film.h"

#include <csignal>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <opencv2/core/mat.hpp>
#include <opencv2/videoio.hpp>
#include <sched.h>
#include <sys/resource.h>

#include "tests/render/drawn.h"
#include "tests/support/temporary_folder.h"

namespace repose::render {
namespace {

using repose::testing::TemporaryFolder;
using repose::testing::text_of;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

vision::Picture grey_picture(int width, int height, int grey) {
  return {.width = width,
          .height = height,
          .bgr = std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height),
                                           static_cast<std::uint8_t>(grey))};
}

TEST(Film, KeepsEveryFrameInItsOrder) {
  const TemporaryFolder folder;
  for (const char* name : {"film.mp4", "film.gif"}) {
    const auto file = folder.path() / name;
    Film film(file, 10);
    for (int k = 0; k < 5; ++k) film.add(grey_picture(65, 48, 40 + 40 * k));
    film.close();
    cv::VideoCapture film_again(file.string(), cv::CAP_FFMPEG);
    ASSERT_TRUE(film_again.isOpened()) << name;
    cv::Mat frame;
    for (int k = 0; k < 5; ++k) {
      ASSERT_TRUE(film_again.read(frame)) << name << k;
      EXPECT_NEAR(frame.at<cv::Vec3b>(20, 20)[1], 40 + 40 * k, 4) << name << k;
    }
    EXPECT_FALSE(film_again.read(frame)) << name;
  }
}

/// Of a rough picture that moves.
std::string film_text(const std::filesystem::path& file) {
  vision::Picture picture = grey_picture(160, 120, 0);
  Film film(file, 30);
  for (std::size_t frame = 0; frame < 60; ++frame) {
    for (std::size_t k = 0; k < picture.bgr.size(); ++k) {
      picture.bgr[k] = static_cast<std::uint8_t>((k + 7 * frame) * (k + 13) % 251);
    }
    film.add(picture);
  }
  film.close();
  return text_of(file);
}

TEST(Film, HasTheSameBytesHoweverManyProcessorsThereAre) {
  const TemporaryFolder folder;
  const std::string on_all = film_text(folder.path() / "all.mp4");
  cpu_set_t all, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof all, &all), 0);
  CPU_ZERO(&one);
  CPU_SET(sched_getcpu(), &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  const std::string on_one = film_text(folder.path() / "one.mp4");
  EXPECT_EQ(sched_setaffinity(0, sizeof all, &all), 0);
  EXPECT_TRUE(on_all == on_one);
  cpu_set_t after;
  ASSERT_EQ(sched_getaffinity(0, sizeof after, &after), 0);
  EXPECT_TRUE(CPU_EQUAL(&after, &all)) << "a film leaves the processors as they were";
}

TEST(Film, AGifRepeatsForEver) {
  const TemporaryFolder folder;
  Film film(folder.path() / "film.gif", 10);
  film.add(grey_picture(8, 8, 100));
  film.close();
  EXPECT_THAT(text_of(folder.path() / "film.gif"), HasSubstr("NETSCAPE2.0"));
}

TEST(Film, WithoutAnEndNothingIsLeft) {
  const TemporaryFolder folder;
  for (const char* name : {"film.mp4", "film.gif"}) {
    Film film(folder.path() / name, 10);
    film.add(grey_picture(64, 48, 100));
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(Film, AFullDiskLeavesTheEarlierFilm) {
  const TemporaryFolder folder;
  const auto file = folder.write("film.mp4", std::string("the earlier film"));
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit usual = {};
  ::getrlimit(RLIMIT_FSIZE, &usual);
  rlimit small = usual;
  small.rlim_cur = 2000;  // bytes: what is beyond them cannot be written, as on a full disk
  ::setrlimit(RLIMIT_FSIZE, &small);
  const std::string error = error_of([&] {
    Film film(file, 10);
    for (int k = 0; k < 50; ++k) film.add(grey_picture(320, 240, (37 * k) % 256));
    film.close();
  });
  ::setrlimit(RLIMIT_FSIZE, &usual);
  EXPECT_THAT(error, AllOf(HasSubstr("film.mp4: cannot be written"), HasSubstr("Fix: ")));
  EXPECT_EQ(text_of(file), "the earlier film");
  EXPECT_THAT(folder.names(), ElementsAre("film.mp4"));
}

TEST(Film, ErrorsAreNamed) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of([&] { Film film(folder.path() / "film.avi", 10); }), HasSubstr(".mp4"));
  EXPECT_THAT(error_of([&] {
                Film film(folder.path() / "film.gif", 10);
                film.close();
              }),
              HasSubstr("no pictures"));
  EXPECT_THAT(error_of([&] {
                Film film(folder.path() / "film.gif", 10);
                film.add(grey_picture(8, 8, 0));
                film.add(grey_picture(8, 9, 0));
              }),
              HasSubstr("one size"));
  EXPECT_THAT(error_of([&] {
                Film film(folder.path() / "no" / "film.mp4", 10);
                film.add(grey_picture(64, 48, 0));
                film.close();
              }),
              HasSubstr("film.mp4"));
  EXPECT_THAT(folder.names(), IsEmpty());
}

}  // namespace
}  // namespace repose::render
