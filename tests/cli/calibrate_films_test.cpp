#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/calibrate/sphere_study.h"
#include "tests/cli/command_test.h"
#include "tests/support/drawn_drop.h"
#include "tests/support/drawn_film_file.h"
#include "tests/support/drawn_heap_film.h"
#include "tests/support/drawn_roll.h"
#include "tests/support/drawn_tilt.h"
#include "vision/video/film_writer.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr double kDrop_mm = 250;

/// A drop whose rebound is measured in videos, with only restitution free.
class CalibrateFilms : public CommandTest {
 protected:
  CalibrateFilms() : CommandTest({"calibrate"}) {
    folder_.write("study.toml", calibrate::test::kSoftBall + R"([contact.particle_wall]
restitution = { min = 0.2, max = 0.9 }
sliding_friction = 0.3
rolling_friction = 0.01
[contact.particle_particle]
restitution = 0.2
sliding_friction = 0.2
rolling_friction = 0.04
[experiment.drop]
height_mm = 250
grains = 1
measured = { videos = ["drops/*.mp4"] }
)");
    std::filesystem::create_directory(path("drops"));
  }

  static DrawnDrop drop_of(double restitution) {
    return {.width = 240,
            .height = 200,
            .frames_per_s = 60,
            .seconds = .9,
            .mm_per_px = 1.8,
            .drop_mm = kDrop_mm,
            .restitution = restitution,
            .radius_px = 5,
            .release_s = .1};
  }
  void draw(const char* name, double restitution, double plays_at = 60) const {
    write_film(path(name), drop_of(restitution), plays_at);
  }
  /// A video that starts after the first bounce, while the grain rises.
  void draw_end(const char* name) const {
    const DrawnDrop drop = drop_of(.6);
    vision::FilmWriter film(path(name), drop.frames_per_s);
    const cv::Mat scene = drop.scene();
    for (int frame = 21; frame < drop.frames(); ++frame) film.add(drop.picture(frame, scene));
    film.close();
  }

  Finished calibrated() const {
    return run({"study.toml", "--budget", "quick", "--out", "out", "--json", "result.json"});
  }
};

TEST_F(CalibrateFilms, OfDropsGiveTheRestitutionThatTheyWereDrawnWith) {
  draw("drops/a.mp4", .62);
  draw("drops/b.mp4", .60);
  draw("drops/c.mp4", .58);
  const Finished done = calibrated();
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const json result = json::parse(text("result.json"));
  EXPECT_NEAR(result["observables"][0]["measured"], kDrop_mm * .6 * .6, 3);
  const json& restitution = result["parameters"][0];
  EXPECT_EQ(restitution["verdict"], "determined");
  EXPECT_LT(restitution["interval"][0], .6);
  EXPECT_GT(restitution["interval"][1], .6);
  EXPECT_NEAR(restitution["value"], .6, .02);

  const json notes = json::parse(text("out/study.json"));
  ASSERT_EQ(notes["films"].size(), 3U);
  EXPECT_EQ(notes["films"][0]["status"], "ok");
  EXPECT_GT(notes["films"][0]["uncertainty"], 0);

  ASSERT_EQ(run_repose(folder_, {"report", "out"}).exit_code, 0);
  EXPECT_THAT(text("out/report.html"), HasSubstr("3 films, all of which could be read"));
  EXPECT_THAT(text("out/tables/films.csv"), HasSubstr("\nc.mp4,drop,"));
}

TEST_F(CalibrateFilms, ThatGiveNoReadingAreNamedAndLeftOut) {
  draw("drops/a.mp4", .6);
  draw("drops/b.mp4", .605);
  draw("drops/slow.mp4", .6, 30);
  draw_end("drops/end.mp4");
  folder_.write("drops/note.mp4", std::string("hello"));
  const Finished done = calibrated();
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.err, AllOf(HasSubstr("drops/note.mp4: is no film that repose reads"),
                              HasSubstr("the first bounce was not read"),
                              HasSubstr("drops/slow.mp4: drop_mm = "),
                              HasSubstr("the study has height_mm = 250 in [experiment.drop]"),
                              HasSubstr("(this film is left out)"), Not(HasSubstr("a.mp4"))));
  const json result = json::parse(text("result.json"));
  EXPECT_NEAR(result["observables"][0]["measured"], kDrop_mm * .6 * .6, 3);
  ASSERT_EQ(run_repose(folder_, {"report", "out"}).exit_code, 0);
  EXPECT_THAT(text("out/report.html"), HasSubstr("5 films, 2 of which could be read"));
}

TEST_F(CalibrateFilms, NoneOfWhichGivesAReadingAreAllNamed) {
  draw("drops/slow.mp4", .6, 30);
  folder_.write("drops/note.mp4", std::string("hello"));
  const Finished refused = calibrated();
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, AllOf(HasSubstr("slow.mp4: "), HasSubstr("note.mp4: "),
                                 HasSubstr("none of the 2 films of [experiment.drop] gives")));
  EXPECT_FALSE(exists("out/study.json"));
}

TEST_F(CalibrateFilms, APatternThatNoFileHasIsAnError) {
  const Finished refused = calibrated();
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("drops/*.mp4: no file has such a name. Fix: "));
  const Finished empty =
      run({"study.toml", "--set", "experiment.drop.measured = { videos = [\"drops\"] }"});
  EXPECT_EQ(empty.exit_code, 2);
  EXPECT_THAT(empty.err, HasSubstr("no films in this folder"));
}

TEST_F(CalibrateFilms, OfRollsHaveTheirMillimetresFromTheRelease) {
  const DrawnRoll roll{.width = 300,
                       .height = 150,
                       .seconds = 1.9,
                       .mm_per_px = 1.2,
                       .stopped_mm = 150,
                       .radius_px = 6,
                       .release_s = .2,
                       .roll_s = 1.2};
  write_film(path("roll.mp4"), roll);
  const auto with_incline = [](const std::string& degrees) {
    return "experiment.roll = { incline_deg = " + degrees +
           ", release_mm = 100, measured = { videos = [\"roll.mp4\"] } }";
  };
  const Words words = {"study.toml", "--dry-run", "--set",
                       "experiment.drop.measured = { values = [90] }", "--set"};
  const auto told = [&](const std::string& setting) {
    Words all = words;
    all.push_back(setting);
    return run(all);
  };
  EXPECT_EQ(told(with_incline("20")).exit_code, 0) << told(with_incline("20")).err;
  const Finished other = told(with_incline("25"));
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err, AllOf(HasSubstr("roll.mp4: incline_deg = "),
                               HasSubstr("the study has incline_deg = 25 in [experiment.roll]")));
}

TEST_F(CalibrateFilms, OfTiltsMustHaveAboutTheRateOfTheStudy) {
  const DrawnTilt tilt = small_tilt();
  write_film(path("tilt.mp4"), tilt);
  const auto told = [&](const std::string& rate) {
    return run({"study.toml", "--dry-run", "--set", "experiment.drop.measured = { values = [90] }",
                "--set",
                "experiment.tilt = { rate_deg_s = " + rate +
                    ", measured = { videos = [\"tilt.mp4\"] } }"});
  };
  EXPECT_EQ(told("7").exit_code, 0) << told("7").err;
  const Finished other = told("2");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_THAT(other.err,
              AllOf(HasSubstr("tilt.mp4: rate_deg_s = "), HasSubstr("the same within 20 %"),
                    HasSubstr("the study has rate_deg_s = 2 in [experiment.tilt]")));
}

TEST_F(CalibrateFilms, AreTakenFromFoldersToo) {
  draw("drops/a.mp4", .6);
  folder_.write("drops/readme.txt", std::string("no film"));
  const Finished told =
      run({"study.toml", "--dry-run", "--set",
           "experiment.drop.measured = { videos = [\"drops\", \"drops/a.mp4\"] }"});
  EXPECT_EQ(told.exit_code, 0) << told.err;
  EXPECT_THAT(told.err, HasSubstr("a.mp4: named twice, tracked once"));
}

TEST_F(CalibrateFilms, OfHeapsCountAtRestAndOthersAreLeftOut) {
  const std::vector<vision::Picture> frames =
      DrawnHeapFilm{.scene = small_heap(), .grows_s = .5, .rests_s = .8}.pictures();
  const auto write = [&](const char* name, std::size_t count) {
    vision::FilmWriter film(path(name), DrawnHeapFilm{}.frames_per_s);
    for (std::size_t k = 0; k < count; ++k) film.add(frames[count == 9 ? k % 5 : k]);
    film.close();
  };
  write("falls.mp4", 9);
  write("heap.mp4", frames.size());
  const std::string heap =
      "experiment.heap = { tube_diameter_mm = 60, tube_height_mm = 150, grains = 12, "
      "measured = { videos = [\"falls.mp4\", \"heap.mp4\"] } }";
  const Finished both = run({"study.toml", "--dry-run", "--set",
                             "experiment.drop.measured = { values = [90] }", "--set", heap});
  EXPECT_EQ(both.exit_code, 0) << both.err;
  EXPECT_THAT(both.err, AllOf(HasSubstr("falls.mp4: refused, left out: nothing in the film is at "
                                        "rest"),
                              HasSubstr("heap.mp4: flagged, but counted")));
}

}  // namespace
}  // namespace repose::testing
