#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command_test.h"
#include "tests/support/drawn_drop.h"
#include "tests/support/drawn_film_file.h"
#include "tests/support/drawn_roll.h"
#include "tests/support/drawn_tilt.h"
#include "vision/picture/picture.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

struct TrackCommand : CommandTest {
  TrackCommand() : CommandTest({"track"}) {}

  void draw(const char* name, double restitution, double seconds = .9) {
    const DrawnDrop drop{.width = 240,
                         .height = 200,
                         .seconds = seconds,
                         .mm_per_px = 1.8,
                         .restitution = restitution,
                         .radius_px = 5,
                         .release_s = .1};
    write_film(path(name), drop);
  }

  void write(const char* name, const DrawnRoll& roll) { write_film(path(name), roll); }

  DrawnRoll draw_roll(const char* name, double stopped_mm) {
    const DrawnRoll roll{.width = 300,
                         .height = 150,
                         .seconds = 1.9,
                         .mm_per_px = 1.2,
                         .stopped_mm = stopped_mm,
                         .radius_px = 6,
                         .release_s = .2,
                         .roll_s = 1.2};
    write(name, roll);
    return roll;
  }
};

TEST_F(TrackCommand, AFilmWithoutItsFirstBounceIsInNoTableOfFirstBounces) {
  const DrawnDrop drop{.width = 240, .height = 200, .seconds = 1, .mm_per_px = 1.8, .radius_px = 5};
  vision::FilmWriter film(path("end.mp4"), drop.frames_per_s);
  const cv::Mat scene = drop.scene();
  // It rises from its first bounce, at .526 s.
  for (int frame = 33; frame < drop.frames(); ++frame) film.add(drop.picture(frame, scene));
  film.close();
  const Finished first = run({"drop", "end.mp4", "--csv", "first.csv", "--json", "t.json"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(text("first.csv").find('\n') + 1, text("first.csv").size()) << "its header alone";
  const json track = json::parse(text("t.json"))[0];
  EXPECT_EQ(track["status"], "flagged");
  EXPECT_EQ(track["bounces"][0]["number"], 2);
  EXPECT_EQ(track["unread_bounces"][0]["number"], 1);
  EXPECT_TRUE(track["unread_bounces"][0]["time_s"].is_null());
  EXPECT_THAT(first.out, HasSubstr("the first bounce was not read"));
  ASSERT_EQ(run({"drop", "end.mp4", "--bounces", "all", "--csv", "all.csv"}).exit_code, 0);
  EXPECT_THAT(text("all.csv"), HasSubstr("\nend,2,"));
}

TEST_F(TrackCommand, FilmsOfDropsBecomeATableThatTheBenchReads) {
  draw("a.mp4", .6);
  draw("b.mp4", .5);
  const Finished done = run({"drop", "a.mp4", "b.mp4", "--csv", "drops.csv", "--json", "t.json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("mean of 2 first bounces: 0.5"), HasSubstr("a.mp4")));
  EXPECT_THAT(text("drops.csv"), StartsWith("sample,bounce,drop_mm,rebound_mm,in_air,"));

  const json films = json::parse(text("t.json"));
  ASSERT_EQ(films.size(), 2U);
  EXPECT_EQ(films[0]["status"], "ok");
  EXPECT_NEAR(films[0]["bounces"][0]["restitution"].get<double>(), .6, .03);
  EXPECT_NEAR(films[1]["bounces"][0]["restitution"].get<double>(), .5, .03);
  EXPECT_EQ(films[0]["track"]["scale"], "gravity");

  const Finished bench = run_repose(folder_, {"bench", "restitution", "drops.csv", "--json", "-"});
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  EXPECT_EQ(json::parse(bench.out)["quantities"][0]["n"], 2);
}

TEST_F(TrackCommand, TheNumberOfThreadsChangesNothing) {
  draw("a.mp4", .6);
  draw("b.mp4", .7);
  const Finished one = run({"drop", "a.mp4", "b.mp4", "--json", "-", "--threads", "1"});
  const Finished two = run({"drop", "a.mp4", "b.mp4", "--json", "-", "--threads", "2"});
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(one.out, two.out);
}

TEST_F(TrackCommand, AnOverlayOfOneFilmIsAPictureAndOfSeveralAFolder) {
  draw("a.mp4", .6);
  EXPECT_EQ(run({"drop", "a.mp4", "--overlay", "a.png"}).exit_code, 0);
  EXPECT_TRUE(exists("a.png"));
  EXPECT_EQ(run({"drop", "a.mp4", "--overlay", "drawn"}).exit_code, 0);
  EXPECT_TRUE(exists("drawn/a.png"));
  const Finished wrong = run({"drop", "a.mp4", "b.mp4", "--overlay", "x.png"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("Fix: name a folder."));
}

TEST_F(TrackCommand, AFolderOfFramesIsAFilmWithItsRate) {
  const DrawnDrop drop{.width = 240,
                       .height = 200,
                       .seconds = .9,
                       .mm_per_px = 1.8,
                       .radius_px = 5,
                       .release_s = .1};
  std::filesystem::create_directory(path("frames"));
  const cv::Mat scene = drop.scene();
  for (int frame = 0; frame < drop.frames(); ++frame) {
    vision::write_picture(path("frames/f" + std::to_string(frame) + ".png"),
                          drop.picture(frame, scene));
  }
  const Finished done =
      run({"drop", "frames/", "--fps", "60", "--json", "t.json", "--overlay", "overlays"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const json film = json::parse(text("t.json"))[0];
  EXPECT_EQ(film["file"], "frames");
  EXPECT_NEAR(film["bounces"][0]["restitution"].get<double>(), drop.restitution, .03);
  EXPECT_GT(text("overlays/frames.png").size(), 1000U);
  const Finished unrated = run({"drop", "frames"});
  EXPECT_EQ(unrated.exit_code, 2);
  EXPECT_THAT(unrated.err, HasSubstr("--fps"));
  const Finished no_folder = run({"drop", "a.mp4", "--fps", "60"});
  EXPECT_EQ(no_folder.exit_code, 2);
  EXPECT_THAT(no_folder.err, HasSubstr("no folder is named"));
}

TEST_F(TrackCommand, ARefusedFilmHasAReasonAndNoNumber) {
  draw("short.mp4", .6, .3);
  const Finished done = run({"drop", "short.mp4", "--json", "t.json", "--csv", "t.csv"});
  EXPECT_EQ(done.exit_code, 3);
  EXPECT_THAT(done.out, HasSubstr("refused: "));
  const json film = json::parse(text("t.json"))[0];
  EXPECT_EQ(film["status"], "refused");
  EXPECT_THAT(film["bounces"], IsEmpty());
  EXPECT_EQ(film["track"], nullptr);
  EXPECT_THAT(film["reason"].get<std::string>(), HasSubstr("Fix: "));
}

TEST_F(TrackCommand, CopiesOfAFilmCountOnce) {
  draw_roll("a.mp4", 150);
  draw_roll("b.mp4", 170);
  std::filesystem::copy(folder_.path() / "a.mp4", folder_.path() / "c.mp4");
  const Finished done = run({"roll", "a.mp4", "b.mp4", "c.mp4", "--released", "100", "--json",
                             "r.json", "--csv", "r.csv"});
  EXPECT_THAT(text("r.csv"), AllOf(HasSubstr("\nb,"), ::testing::Not(HasSubstr("\nc,"))));
  EXPECT_THAT(done.out, HasSubstr("mean of 2 rolls"));
  EXPECT_THAT(done.err, HasSubstr("c.mp4: the same film as a.mp4, counted once"));
  const json films = json::parse(text("r.json"));
  EXPECT_EQ(films[2]["copy_of"], "a.mp4");
  EXPECT_TRUE(films[1]["copy_of"].is_null());
  for (const char* far : {"1e-9", "1e9"}) {
    EXPECT_THAT(run({"roll", "a.mp4", "--released", far}).err, HasSubstr("--released"));
  }
}

TEST_F(TrackCommand, FilmsOfRollsBecomeATableThatTheBenchReads) {
  const DrawnRoll roll = draw_roll("a.mp4", 150);
  draw_roll("b.mp4", 170);
  const Finished done = run({"roll", "a.mp4", "b.mp4", "--released", "100", "--csv", "rolls.csv",
                             "--json", "r.json", "--overlay", "drawn"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("mean of 2 rolls: 1"), HasSubstr("incline [°]")));
  EXPECT_TRUE(exists("drawn/b.png"));
  EXPECT_THAT(text("rolls.csv"), StartsWith("sample,incline_deg,released_mm,stopped_mm,"));
  const json film = json::parse(text("r.json"))[0];
  EXPECT_EQ(film["experiment"], "roll");
  EXPECT_NEAR(film["roll"]["stopped_mm"].get<double>(), 150, 3);
  EXPECT_NEAR(film["roll"]["incline_deg"].get<double>(), roll.incline_deg, .5);
  EXPECT_EQ(film["track"]["scale"], "released");
  const Finished bench = run_repose(folder_, {"bench", "rolling", "rolls.csv", "--json", "-"});
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  EXPECT_EQ(json::parse(bench.out)["quantities"][0]["n"], 2);
}

TEST_F(TrackCommand, ABoardGivesTheScaleAndACameraFileItsLens) {
  const DrawnRoll roll{.width = 360,
                       .height = 180,
                       .seconds = 1.9,
                       .mm_per_px = 1.2,
                       .stopped_mm = 170,
                       .radius_px = 6,
                       .release_s = .2,
                       .roll_s = 1.2,
                       .board_square_px = 14};
  write("a.mp4", roll);
  folder_.write("camera.toml", std::string("[lens]\n"));
  EXPECT_THAT(run({"roll", "a.mp4", "--board", "--camera-file", "camera.toml"}).err,
              HasSubstr("--camera-file camera.toml"));
  const Finished done = run({"roll", "a.mp4", "--board", "--square-mm", "16.8", "--json", "r.json",
                             "--overlay", "a.png"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const json read = json::parse(text("r.json"))[0];
  EXPECT_EQ(read["track"]["scale"], "board");
  EXPECT_EQ(read["track"]["board_px"].size(), 4U);
  EXPECT_NEAR(read["roll"]["stopped_mm"].get<double>(), roll.stopped_mm, 2);
}

TEST_F(TrackCommand, ARollNeedsOneScaleAndNoBounces) {
  const Finished none = run({"roll", "a.mp4", "--bounces", "all"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_THAT(none.err, AllOf(HasSubstr("there is no scale"), HasSubstr("--bounces: is for track "
                                                                        "drop")));
  EXPECT_THAT(run({"roll", "a.mp4", "--scale", "0,0,99,0,90", "--released", "9"}).err,
              HasSubstr("there are two scales"));
  EXPECT_THAT(run({"roll", "a.mp4", "--board", "--released", "9", "--board-behind", "5"}).err,
              AllOf(HasSubstr("there are two scales"), HasSubstr("it needs --camera-file")));
  EXPECT_THAT(run({"tilt", "a.mp4", "--board"}).err, HasSubstr("--board: is for track drop"));
  EXPECT_THAT(run({"drop", "a.mp4", "--released", "9"}).err, HasSubstr("is for track roll"));
}

TEST_F(TrackCommand, FilmsOfTiltsBecomeATableThatTheBenchReads) {
  const DrawnTilt tilt = small_tilt();
  write_film(path("a.mp4"), tilt);
  const Finished done =
      run({"tilt", "a.mp4", "--csv", "tilts.csv", "--json", "t.json", "--overlay", "a.png"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("slides at [°]"));
  EXPECT_TRUE(exists("a.png"));
  EXPECT_THAT(text("tilts.csv"), StartsWith("sample,angle_deg,"));
  const json film = json::parse(text("t.json"))[0];
  EXPECT_EQ(film["experiment"], "tilt");
  EXPECT_NEAR(film["tilt"]["angle_deg"].get<double>(), tilt.onset_deg, .4);
  EXPECT_EQ(film["track"]["plate"].size(), film["film"]["frames"].get<std::size_t>());
  const Finished bench = run_repose(folder_, {"bench", "sliding", "tilts.csv", "--json", "-"});
  ASSERT_EQ(bench.exit_code, 0) << bench.err;
  EXPECT_EQ(json::parse(bench.out)["quantities"][0]["n"], 1);
  EXPECT_THAT(run({"tilt", "a.mp4", "--scale", "0,0,99,0,90"}).err, HasSubstr("angles need none"));
}

TEST_F(TrackCommand, AllThatIsWrongIsSaidAtOnce) {
  const Finished done = run({"slide", "a.mp4", "--scale", "1,2,3,4", "--bounces", "some",
                             "--threads", "0", "--json", "a.mp4"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.err,
              AllOf(HasSubstr("drop"), HasSubstr("--scale 1,2,3,4: must be two points"),
                    HasSubstr("--bounces some"), HasSubstr("--threads 0"), HasSubstr("--json")));
}

TEST_F(TrackCommand, AFileThatIsNoFilmDoesNotKeepOthersFromTheirNumbers) {
  draw("a.mp4", .6);
  folder_.write("note.mp4", std::string("hello"));
  const Finished done = run({"drop", "note.mp4", "a.mp4", "--csv", "-"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.err, HasSubstr("note.mp4: is no film that repose reads"));
  EXPECT_THAT(done.out, HasSubstr("\na,1,"));
}

}  // namespace
}  // namespace repose::testing
