#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command_test.h"
#include "tests/support/drawn_heap_film.h"
#include "vision/video/film_writer.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

/// A folder with a video in it, drawn once for all tests.
struct MeasureFilms : CommandTest {
  MeasureFilms() : CommandTest({"measure"}) {}

  static const std::vector<vision::Picture>& frames() {
    static const std::vector<vision::Picture> drawn =
        DrawnHeapFilm{.scene = small_heap(), .grows_s = .5, .grows_from = 0, .rests_s = 1.1}
            .pictures();
    return drawn;
  }
  void draw(const std::string& name, std::size_t first = 0) const {
    vision::FilmWriter film(path(name), DrawnHeapFilm{}.frames_per_s);
    for (std::size_t k = first; k < frames().size(); ++k) film.add(frames()[k]);
    film.close();
  }
};

TEST_F(MeasureFilms, AFilmIsMeasuredAtRestWhereverAPictureIs) {
  draw("heap.mp4");
  vision::write_picture(path("photo.png"), frames().back());
  folder_.write("heap.mp4.repose.toml", std::string("exclude = [[0, 0, 60, 30]]\n"));
  const Finished done = run({"heap.mp4", "photo.png", "--overlay", "drawn", "--csv", "a.csv",
                             "--json", "a.json", "--report", "a.html"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out,
              AllOf(HasSubstr("at rest from 0."), HasSubstr("(12 frames per"), HasSubstr("n = 2")));
  EXPECT_TRUE(exists("drawn/heap.png"));
  EXPECT_THAT(text("a.html"), HasSubstr("heap.mp4"));
  EXPECT_THAT(text("a.csv"), HasSubstr(",reason,time_s,film_from_s,film_to_s,film_frames,"
                                       "frames_per_s,camera,scale,mm_per_px,"));
  const json results = json::parse(text("a.json"));
  ASSERT_EQ(results.size(), 2U);
  EXPECT_NEAR(results[0]["angle_deg"].get<double>(), results[1]["angle_deg"].get<double>(), .5);
  EXPECT_EQ(results[0]["film"]["frames"], frames().size());
  EXPECT_NEAR(results[0]["stretch"]["from_s"].get<double>(), .6, .1);
  EXPECT_NEAR(results[0]["stretch"]["to_s"].get<double>(), 1.53, .1);
  EXPECT_GT(results[0]["stretch"]["frames"].get<int>(), 9);
  EXPECT_EQ(results[0]["hints"]["file"], "heap.mp4.repose.toml");
  for (const char* key : {"film", "stretch", "time_s"}) EXPECT_EQ(results[1][key], nullptr) << key;
}

TEST_F(MeasureFilms, AFolderOfFramesIsAFilmWithItsRate) {
  std::filesystem::create_directory(path("frames"));
  for (std::size_t k = 0; k < frames().size(); ++k) {
    vision::write_picture(path("frames/f" + std::to_string(k) + ".png"), frames()[k]);
  }
  const Finished done = run({"frames", "--fps", "12", "--json", "a.json", "--overlay", "drawn"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_TRUE(exists("drawn/frames.png"));
  const json results = json::parse(text("a.json"));
  ASSERT_EQ(results.size(), 1U) << "a film, and not its pictures";
  EXPECT_EQ(results[0]["film"]["frames"], frames().size());
  EXPECT_NEAR(results[0]["stretch"]["from_s"].get<double>(), .6, .1);
  const Finished series = run({"frames", "--fps", "12", "--every", "0.5", "--csv", "-"});
  EXPECT_EQ(series.exit_code, 0) << series.err;
}

TEST_F(MeasureFilms, EveryGivesTheAngleOverTimeAtAnyNumberOfThreads) {
  draw("heap.mp4");
  const Finished one = run({"heap.mp4", "--every", "0.5", "--threads", "1", "--json", "1.json",
                            "--overlay", "drawn", "--summary", "mean.json"});
  ASSERT_EQ(one.exit_code, 0) << one.err;
  run({"heap.mp4", "--every", "0.5", "--threads", "2", "--json", "2.json"});
  EXPECT_EQ(text("1.json"), text("2.json"));
  const json rows = json::parse(text("1.json"));
  ASSERT_EQ(rows.size(), 5U) << "the heap at rest, and frames near 0, 0.5, 1 and 1.5 s";
  EXPECT_EQ(rows[0]["time_s"], nullptr);
  EXPECT_EQ(rows[1]["time_s"], 0);
  EXPECT_EQ(rows[1]["status"], "refused") << "there is no heap yet";
  EXPECT_NEAR(rows[4]["time_s"].get<double>(), 1.5, .01);
  EXPECT_EQ(rows[4]["stretch"]["frames"], 1);
  EXPECT_NEAR(rows[4]["angle_deg"].get<double>(), rows[0]["angle_deg"].get<double>(), 1);
  EXPECT_TRUE(exists("drawn/heap.png") && exists("drawn/heap_at_0.000s.png") &&
              exists("drawn/heap_at_1.500s.png"));
  EXPECT_EQ(json::parse(text("mean.json"))["n"], 1) << "frames are no repeats";
  EXPECT_THAT(one.out,
              AllOf(HasSubstr("\n   0.00 s"), HasSubstr("\n   1.50 s"), Not(HasSubstr("mean 2"))));
}

TEST_F(MeasureFilms, EveryNeedsAFilmAndAStepThatFitsIt) {
  draw("heap.mp4", frames().size() - 8);
  vision::write_picture(path("photo.png"), frames().back());
  const Finished pictures = run({"photo.png", "--every", "0.1"});
  EXPECT_EQ(pictures.exit_code, 2);
  EXPECT_THAT(pictures.err, HasSubstr("--every 0.1: there are pictures only. Rule: it is for "
                                      "films"));
  for (const char* wrong : {"0", "nan"}) {
    const Finished done = run({"photo.png", "--every", wrong});
    EXPECT_THAT(done.err, HasSubstr("must be a time in seconds, more than 0. Fix: --every 0.1"));
  }
  const Finished longer = run({"heap.mp4", "--every", "9"});
  EXPECT_EQ(longer.exit_code, 2);
  EXPECT_THAT(longer.err, HasSubstr("heap.mp4: --every 9 is longer than the film"));
}

TEST_F(MeasureFilms, OfAFolderAllCountButThoseTakenAlongWithAPicture) {
  std::filesystem::create_directory(path("heaps"));
  vision::write_picture(path("heaps/one.png"), frames().back());
  folder_.write("heaps/one.MOV", std::string("as a telephone takes it"));
  draw("heaps/two.mp4", frames().size() - 10);
  const Finished done = run({"heaps", "--json", "-"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  const json rows = json::parse(done.out);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[1]["file"], "heaps/two.mp4");
  EXPECT_THAT(done.err, HasSubstr("heaps/one.MOV: left out, since a picture has its name"));
}

TEST_F(MeasureFilms, AFilmWithoutRestIsRefusedAndOneThatIsNoneNotRead) {
  vision::FilmWriter film(path("falls.mp4"), DrawnHeapFilm{}.frames_per_s);
  for (std::size_t k = 0; k < 9; ++k) film.add(frames()[k % 6]);
  film.close();
  folder_.write("none.mp4", std::string("no film"));
  const Finished refused = run({"falls.mp4", "none.mp4", "--json", "-", "--overlay", "drawn"});
  EXPECT_EQ(refused.exit_code, 2);
  const json row = json::parse(refused.out)[0];
  EXPECT_EQ(row["angle_deg"], nullptr);
  EXPECT_EQ(row["stretch"], nullptr);
  EXPECT_THAT(row["reason"].get<std::string>(),
              AllOf(HasSubstr("nothing in the film is at rest"),
                    HasSubstr("an excluded box (--exclude X,Y,W,H)")));
  EXPECT_TRUE(exists("drawn/falls.png"));
  EXPECT_THAT(refused.err, HasSubstr("none.mp4: is no film that repose reads"));
}

}  // namespace
}  // namespace repose::testing
