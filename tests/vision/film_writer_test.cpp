#include "vision/video/film_writer.h"

#include <array>
#include <csignal>
#include <filesystem>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <malloc.h>
#include <opencv2/core/mat.hpp>
#include <sys/resource.h>

#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"
#include "vision/film/film_reader.h"

namespace repose::vision {
namespace {

using repose::testing::TemporaryFolder;
using repose::testing::text_of;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

Picture grey_picture(int width, int height, int grey) {
  return {.width = width,
          .height = height,
          .bgr = std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height),
                                           static_cast<std::uint8_t>(grey))};
}

TEST(FilmWriter, KeepsEveryFrameInItsOrder) {
  const TemporaryFolder folder;
  for (const char* name : {"film.mp4", "film.gif"}) {
    const auto file = folder.path() / name;
    FilmWriter film(file, 10);
    for (int k = 0; k < 5; ++k) film.add(grey_picture(65, 48, 40 + 40 * k));
    film.close();
    FilmReader film_again(file);
    FilmFrame frame;
    for (int k = 0; k < 5; ++k) {
      ASSERT_TRUE(film_again.next(frame)) << name << k;
      EXPECT_NEAR(frame.bgr.at<cv::Vec3b>(20, 20)[1], 40 + 40 * k, 4) << name << k;
      EXPECT_NEAR(frame.time_s, 0.1 * k, 1e-6) << name << k;
    }
    EXPECT_FALSE(film_again.next(frame)) << name;
  }
}

/// A film of a moving pattern with noise.
std::string film_text(const std::filesystem::path& file) {
  std::mt19937 random(7);
  Picture picture = grey_picture(160, 120, 0);
  FilmWriter film(file, 30);
  for (int frame = 0; frame < 60; ++frame) {
    std::size_t at = 0;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < 3 * picture.width; ++x) {
        const std::uint32_t noise = random() % 6;
        picture.bgr[at++] = static_cast<std::uint8_t>(100 + (x / 3 + frame) % 50 + y % 30 +
                                                      static_cast<int>(noise));
      }
    }
    film.add(picture);
  }
  film.close();
  return text_of(file);
}

TEST(FilmWriter, HasTheSameBytesWhateverWasInMemory) {
  const TemporaryFolder folder;
  std::array<std::string, 3> films;
  for (std::size_t k = 0; k < films.size(); ++k) {
    mallopt(M_PERTURB, std::array{0, 1, 85}[k]);  // fill value of new memory
    films[k] = film_text(folder.path() / "film.mp4");
  }
  mallopt(M_PERTURB, 0);
  EXPECT_TRUE(films[0] == films[1] && films[0] == films[2]);
}

TEST(FilmWriter, AGifRepeatsForEver) {
  const TemporaryFolder folder;
  FilmWriter film(folder.path() / "film.gif", 10);
  film.add(grey_picture(8, 8, 100));
  film.close();
  EXPECT_THAT(text_of(folder.path() / "film.gif"), HasSubstr("NETSCAPE2.0"));
}

TEST(FilmWriter, WithoutAnEndNothingIsLeft) {
  const TemporaryFolder folder;
  for (const char* name : {"film.mp4", "film.gif"}) {
    FilmWriter film(folder.path() / name, 10);
    film.add(grey_picture(64, 48, 100));
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(FilmWriter, AFullDiskLeavesTheEarlierFilm) {
  const TemporaryFolder folder;
  const auto file = folder.write("film.mp4", std::string("the earlier film"));
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit usual = {};
  ::getrlimit(RLIMIT_FSIZE, &usual);
  rlimit small = usual;
  small.rlim_cur = 2000;  // bytes: writes beyond this fail, as on a full disk
  ::setrlimit(RLIMIT_FSIZE, &small);
  const std::string error = error_of([&] {
    FilmWriter film(file, 10);
    for (int k = 0; k < 50; ++k) film.add(grey_picture(320, 240, (37 * k) % 256));
    film.close();
  });
  ::setrlimit(RLIMIT_FSIZE, &usual);
  EXPECT_THAT(error, AllOf(HasSubstr("film.mp4: cannot be written"), HasSubstr("Fix: ")));
  EXPECT_EQ(text_of(file), "the earlier film");
  EXPECT_THAT(folder.names(), ElementsAre("film.mp4"));
}

TEST(FilmWriter, ErrorsAreNamed) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of([&] { FilmWriter film(folder.path() / "film.avi", 10); }),
              HasSubstr(".mp4"));
  EXPECT_THAT(error_of([&] {
                FilmWriter film(folder.path() / "film.gif", 10);
                film.close();
              }),
              HasSubstr("no pictures"));
  EXPECT_THAT(error_of([&] {
                FilmWriter film(folder.path() / "film.gif", 10);
                film.add(grey_picture(8, 8, 0));
                film.add(grey_picture(8, 9, 0));
              }),
              HasSubstr("one size"));
  EXPECT_THAT(error_of([&] {
                FilmWriter film(folder.path() / "no" / "film.mp4", 10);
                film.add(grey_picture(64, 48, 0));
                film.close();
              }),
              HasSubstr("film.mp4"));
  EXPECT_THAT(folder.names(), IsEmpty());
}

}  // namespace
}  // namespace repose::vision
