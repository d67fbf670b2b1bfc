#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "render/film/film.h"
#include "tests/cli/command_test.h"
#include "tests/support/drawn_drop.h"

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
    render::Film film(path(name), drop.frames_per_s);
    for (int frame = 0; frame < drop.frames(); ++frame) film.add(drop.picture(frame));
    film.close();
  }
};

TEST_F(TrackCommand, FilmsOfDropsBecomeATableThatTheBenchReads) {
  draw("a.mp4", .6);
  draw("b.mp4", .5);
  const Finished done = run({"drop", "a.mp4", "b.mp4", "--csv", "drops.csv", "--json", "t.json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("mean of 2 first bounces: 0.5"), HasSubstr("a.mp4")));
  EXPECT_THAT(text("drops.csv"), StartsWith("sample,bounce,drop_mm,rebound_mm,"));

  const json films = json::parse(text("t.json"));
  ASSERT_EQ(films.size(), 2U);
  EXPECT_EQ(films[0]["status"], "ok");
  EXPECT_NEAR(films[0]["bounces"][0]["restitution"].get<double>(), .6, .015);
  EXPECT_NEAR(films[1]["bounces"][0]["restitution"].get<double>(), .5, .015);
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
