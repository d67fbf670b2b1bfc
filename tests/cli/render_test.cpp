#include <cstdlib>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "dem/state/state_file.h"
#include "tests/cli/command_test.h"
#include "vision/picture/picture.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

/// Three balls on a plane, as a state and as a trajectory of three states.
class RenderCommand : public CommandTest {
 protected:
  RenderCommand() : CommandTest({"render"}) {
    const dem::ContactTable contacts(
        {{.name = "glass", .density_kg_m3 = 2500, .young_modulus_pa = 1e7, .poisson_ratio = .25}},
        {dem::PairCoefficients{}}, dem::RollingModel::none);
    dem::SimulationSetup setup{.kinds = {{dem::sphere_shape(.01), 0}},
                               .walls = {{.shape = dem::Plane{}}},
                               .contacts = contacts};
    setup.timestep_s = 1e-4;
    dem::Simulation simulation(setup);
    for (int k = 0; k < 3; ++k) simulation.add({.position = {.021 * k, 0, .02}});
    dem::TrajectoryWriter film(path("film"), .01, "{}");
    for (int k = 0; k < 3; ++k) {
      film.add(simulation);
      simulation.advance(100);
    }
    dem::write_state(path("state.vtp"), simulation, "{}");
  }
};

TEST_F(RenderCommand, WritesPictureMaskAndTruth) {
  const Finished done = run({"state.vtp", "--size", "200,100", "--mm-per-px", ".5", "--out",
                             "a.png", "--mask", "mask.png", "--truth", "truth.json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto picture = vision::read_picture(path("a.png"));
  const auto mask = vision::read_picture(path("mask.png"));
  EXPECT_EQ(picture.width, 200);
  for (std::size_t k = 0; k < mask.bgr.size(); ++k) ASSERT_EQ(mask.bgr[k], 255 - picture.bgr[k]);
  const json truth = json::parse(text("truth.json"));
  EXPECT_EQ(truth["mm_per_px"], .5);
  EXPECT_EQ(truth["camera"]["kind"], "orthographic");
  EXPECT_TRUE(truth["ground_px"].is_array());
  EXPECT_GT(truth["outline_px"].size(), 100U);
}

TEST_F(RenderCommand, WritesModelFilmAndPhoto) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"state.vtp", "--out", "a.glb"},
           {"state.vtp", "--out", "a.jpg", "--style", "photo", "--passes", "2", "--size", "160,90",
            "--camera", "distance_mm=400,height_mm=30,pitch_deg=3,roll_deg=1,focal_mm=60,k1=-.1"},
           {"state.vtp", "--out", "a.gif", "--turntable", "3", "--size", "64,48"},
           {"film/trajectory.pvd", "--out", "a.mp4", "--size", "64,48", "--view", "30"}}) {
    const Finished done = run(words);
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_GT(text(words[2]).size(), 200U) << words[2];
  }
}

TEST_F(RenderCommand, FilmsARunInRealTimeAndSaysWhatIsExact) {
  const Finished done = run({"film/trajectory.pvd",
                             "--style",
                             "photo",
                             "--passes",
                             "2",
                             "--size",
                             "96,64",
                             "--fps",
                             "200",
                             "--exposure-ms",
                             "3",
                             "--hold-s",
                             ".05",
                             "--noise",
                             ".01",
                             "--camera",
                             "distance_mm=1000,height_mm=20",
                             "--out",
                             "a.mp4",
                             "--truth",
                             "a.json"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_GT(text("a.mp4").size(), 200U);
  const json truth = json::parse(text("a.json"));
  EXPECT_EQ(truth["frames_per_s"], 200);
  EXPECT_NEAR(truth["exposure_ms"].get<double>(), 3, 1e-9);
  const double ruler_px = truth["scale"][2].get<double>() - truth["scale"][0].get<double>();
  EXPECT_NEAR(truth["scale"][4].get<double>() / ruler_px, truth["mm_per_px"].get<double>(), 1e-4);
  EXPECT_EQ(truth["frames"].size(), 25U) << "0.02 s, and twice 0.05 s";
  EXPECT_EQ(truth["frames"][0]["grains_mm"].size(), 3U);
  EXPECT_EQ(truth["frames"][0]["grains_px"].size(), 3U);
}

TEST_F(RenderCommand, TheSameBytesAtAnyNumberOfThreadsOfTheDriver) {
  for (const std::string style : {"silhouette", "photo"}) {
    std::string first;
    for (const char* threads : {"0", "1", "2", "5"}) {
      ::setenv("LP_NUM_THREADS", threads, 1);
      const Finished done =
          run({"state.vtp", "--style", style, "--size", "320,180", "--out", "a.png"});
      ::unsetenv("LP_NUM_THREADS");
      ASSERT_EQ(done.exit_code, 0) << done.err;
      if (first.empty()) first = text("a.png");
      EXPECT_EQ(text("a.png"), first) << style << ' ' << threads;
    }
  }
}

TEST_F(RenderCommand, ErrorsAreOneLineEachAndLeaveNothing) {
  folder_.write("notes.vtp", std::string("no state"));
  const std::vector<std::pair<std::vector<std::string>, const char*>> cases = {
      {{"missing.vtp", "--out", "a.png"}, "missing.vtp"},
      {{"notes.vtp", "--out", "a.png"}, "notes.vtp"},
      {{"missing.pvd", "--out", "a.mp4"}, "missing.pvd"},
      {{"notes.vtp"}, "--out"},
      {{"state.vtp", "--out", "a.txt"}, "a.txt"},
      {{"state.vtp", "--out", "no/a.png"}, "no/a.png"},
      {{"state.vtp", "--out", "a.mp4"}, "--turntable"},
      {{"state.vtp", "--out", "a.png", "--size", "0,100"}, "--size"},
      {{"state.vtp", "--out", "a.png", "--size", "20000,100"}, "16384"},
      {{"state.vtp", "--out", "a.png", "--view", "above"}, "--view"},
      {{"state.vtp", "--out", "a.png", "--style", "oil"}, "--style"},
      {{"state.vtp", "--out", "a.png", "--show", "dust"}, "--show"},
      {{"state.vtp", "--out", "a.png", "--seed", "3"}, "--seed"},
      {{"state.vtp", "--out", "a.png", "--camera", "zoom=3"}, "zoom"},
      {{"state.vtp", "--out", "a.png", "--camera", "distance_mm=1,focal_mm=50"}, "inside the heap"},
      {{"state.vtp", "--out", "a.glb", "--mask", "m.png"}, "--mask"},
      {{"state.vtp", "--out", "state.vtp"}, "would overwrite an input file"},
      {{"film/trajectory.pvd", "--out", "a.png"}, "film"},
      {{"film/trajectory.pvd", "--out", "a.mp4", "--fps", "-1"}, "--fps"},
      {{"film/trajectory.pvd", "--out", "a.mp4", "--hold-s", "1"}, "--fps"},
      {{"film/trajectory.pvd", "--out", "a.mp4", "--truth", "t.json"}, "--truth"},
      {{"film/trajectory.pvd", "--out", "a.mp4", "--fps", "60", "--exposure-ms", "4"}, "photo"},
      {{"film/trajectory.pvd", "--out", "a.mp4", "--fps", "60", "--style", "photo", "--exposure-ms",
        "40"},
       "--exposure-ms 40"},
      {{"state.vtp", "--out", "a.png", "--fps", "60"}, "--fps"},
  };
  for (const auto& [words, named] : cases) {
    const Finished done = run(words);
    EXPECT_EQ(done.exit_code, 2) << named;
    EXPECT_THAT(done.err, AllOf(HasSubstr(named), HasSubstr("Fix: "))) << named;
    EXPECT_THAT(done.out, IsEmpty());
  }
  EXPECT_THAT(folder_.names(), UnorderedElementsAre("film", "state.vtp", "notes.vtp"));
}

}  // namespace
}  // namespace repose::testing
