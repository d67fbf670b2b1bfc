#include "vision/camera/board.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/cli/command_test.h"
#include "tests/support/drawn_board.h"
#include "tests/support/heap_conditions.h"
#include "tests/support/heap_draft.h"
#include "tests/support/heap_picture.h"
#include "tests/support/heap_random.h"
#include "vision/picture/picture.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

struct BoardCommand : CommandTest {
  BoardCommand() : CommandTest({"board"}) {}
};

TEST_F(BoardCommand, WritesAPageToPrint) {
  const Finished done = run({"--out", "board.pdf"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("24 mm"), HasSubstr("100 mm")));
  EXPECT_THAT(text("board.pdf"), StartsWith("%PDF"));
  const std::string first = text("board.pdf");
  ASSERT_EQ(run({"--out", "board.pdf"}).exit_code, 0);
  EXPECT_EQ(text("board.pdf"), first);

  ASSERT_EQ(run({"--out", "board.png", "--paper", "letter", "--dpi", "150"}).exit_code, 0);
  const vision::Picture page = vision::read_picture(path("board.png"));
  EXPECT_EQ(page.width, 1650);
  EXPECT_EQ(vision::find_board(page).size(), 54U);
}

TEST_F(BoardCommand, SaysAllThatIsWrong) {
  const Finished done = run({"--out", "board.jpg", "--paper", "a3", "--dpi", "5"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.err, AllOf(HasSubstr("--out board.jpg"), HasSubstr("--paper a3"),
                              HasSubstr("--dpi 5"), HasSubstr("Fix")));
  EXPECT_EQ(run({}).exit_code, 2);
  EXPECT_THAT(run({"--out", "board.pdf", "--dpi", "300"}).err, HasSubstr("a PDF has no pixels"));
  EXPECT_FALSE(exists("board.pdf"));
}

struct CameraCommand : CommandTest {
  CameraCommand() : CommandTest({"camera"}) {}

  void draw(int count, double most_tilt_deg = 35) {
    const BoardCamera camera{.width = 800,
                             .height = 600,
                             .focal_px = 900,
                             .centre_x_px = 402,
                             .centre_y_px = 297,
                             .k1 = -.15};
    std::filesystem::create_directory(path("boards"));
    Random random(5);
    for (int i = 0; i < count; ++i) {
      const vision::Point middle{800 * random.uniform(.33, .67), 600 * random.uniform(.33, .67)};
      const auto tilt = [&] { return radians(random.uniform(-most_tilt_deg, most_tilt_deg)); };
      const auto place = placed_board(random.uniform(400, 520) * camera.direction(middle), tilt(),
                                      tilt(), random.uniform(-.2, .2));
      vision::write_picture(path("boards/" + std::to_string(i) + ".png"),
                            board_photo(camera, place, {.seed = random.seed()}));
    }
  }
};

TEST_F(CameraCommand, PicturesOfTheBoardBecomeACameraFile) {
  draw(9);
  const Finished done = run({"boards", "--out", "camera.toml", "--json", "camera.json"});
  ASSERT_EQ(done.exit_code, 0) << done.err << done.out;
  EXPECT_THAT(done.out, AllOf(HasSubstr("focal length"), HasSubstr("k1"), HasSubstr("distance")));
  const json camera = json::parse(text("camera.json"));
  EXPECT_NEAR(camera["focal_px"].get<double>(), 900, 6);
  EXPECT_NEAR(camera["k1"].get<double>(), -.15, .02);
  EXPECT_EQ(camera["pictures"].size(), 9U);
  EXPECT_THAT(text("camera.toml"),
              AllOf(StartsWith("# The lens of a camera"), HasSubstr("width_px = 800")));

  const Finished one = run({"boards", "--json", "-", "--threads", "1"});
  EXPECT_EQ(one.out, text("camera.json"));
}

TEST_F(CameraCommand, RefusesWithTheReasonAndWritesNoFile) {
  draw(6, 3);
  const Finished done = run({"boards", "--out", "camera.toml", "--json", "camera.json"});
  EXPECT_EQ(done.exit_code, 3);
  EXPECT_THAT(done.out, AllOf(HasSubstr("refused:"), HasSubstr("face the same way")));
  EXPECT_FALSE(exists("camera.toml"));
  const json camera = json::parse(text("camera.json"));
  EXPECT_EQ(camera["status"], "refused");
  EXPECT_TRUE(camera["focal_px"].is_null());
  EXPECT_THAT(camera["reason"].get<std::string>(), HasSubstr("Fix"));

  EXPECT_EQ(run({"boards/0.png"}).exit_code, 3);
  EXPECT_EQ(run({"boards/none.png"}).exit_code, 2);
  EXPECT_EQ(run({"boards", "--square-mm", "-1"}).exit_code, 2);
}

struct MeasureWithScale : CommandTest {
  MeasureWithScale() : CommandTest({"measure"}) {}

  /// A drawn heap 480 px wide with a board beside it, giving a scale of 0.5 mm per pixel.
  void draw() {
    HeapScene scene = condition_named("clean").scene(3);
    scene.width = 1200;
    scene.height = 800;
    scene.form.base = .4;
    scene.form.center = .3;
    scene.camera.tilt_rad = 0;
    const DrawnHeap heap = draw_heap(scene);
    height_px_ = heap.height_px;
    vision::Picture picture = heap.picture;
    const BoardCamera camera{
        .width = 1200, .height = 800, .focal_px = 3000, .centre_x_px = 600, .centre_y_px = 400};
    draw_board(camera, placed_board({150, 20, 1500}, 0, 0, 0), {}, picture);
    vision::write_picture(path("heap.png"), picture);
  }

  void write_camera(int height = 800) const {
    std::ofstream(path("camera.toml"))
        << "width_px = 1200\nheight_px = " << height
        << "\nfocal_px = 3000\nfocal_uncertainty_px = 9\ncentre_x_px = 600\ncentre_y_px = 400\n"
           "k1 = 0.05\n";
  }

  double height_px_ = 0;
};

TEST_F(MeasureWithScale, ABoardGivesSizesInAllOutputs) {
  draw();
  const Finished done = run({"heap.png", "--board", "--json", "a.json", "--csv", "a.csv"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, AllOf(HasSubstr("height"), HasSubstr("cone's volume"),
                              HasSubstr("mm per pixel"), HasSubstr("board: 54 corners")));
  const json heap = json::parse(text("a.json")).at(0);
  EXPECT_EQ(heap["scale"], "board");
  EXPECT_NEAR(heap["mm_per_px"].get<double>(), .5, .01);
  EXPECT_NEAR(heap["height_mm"].get<double>(), .5 * height_px_, .1 * height_px_);
  EXPECT_NEAR(heap["base_mm"].get<double>(), 240, .05 * 240);
  EXPECT_GT(heap["base_mm_uncertainty"].get<double>(), .02 * 240) << "for distortion alone";
  EXPECT_GT(heap["left"]["run_out_mm"].get<double>(), 80);
  EXPECT_EQ(heap["board"]["corners"], 54);
  EXPECT_THAT(heap["board"]["missing"].get<std::string>(), HasSubstr("camera file"));
  EXPECT_THAT(text("a.csv"), HasSubstr("cone_volume_ml"));

  const json printed_small = result({"heap.png", "--board", "--square-mm", "12"}).at(0);
  EXPECT_NEAR(printed_small["mm_per_px"].get<double>(), .25, .005);
}

TEST_F(MeasureWithScale, ACameraFileCorrectsThePictureAndIsNamed) {
  draw();
  write_camera();
  const json heap =
      result({"heap.png", "--board", "--camera-file", "camera.toml", "--overlay", "drawn"}).at(0);
  EXPECT_EQ(heap["camera"]["file"], "camera.toml");
  EXPECT_NEAR(heap["board"]["pitch_deg"].get<double>(), 0, 1);
  EXPECT_NEAR(heap["pitch_deg"].get<double>(), heap["board"]["pitch_deg"].get<double>(), 1e-9);
  EXPECT_NEAR(heap["board"]["distance_mm"].get<double>(), 1500, 25);
  EXPECT_TRUE(exists("drawn/heap.png"));

  write_camera(600);
  const Finished wrong = run({"heap.png", "--camera-file", "camera.toml"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, AllOf(HasSubstr("1200 x 800"), HasSubstr("1200 x 600"), HasSubstr("Fix")));
}

TEST_F(MeasureWithScale, WhatGivesMillimetresIsSavedWithTheHints) {
  draw();
  write_camera();
  const std::vector<std::string> typed = {"heap.png",      "--board",     "--square-mm", "23.9",
                                          "--camera-file", "camera.toml", "--save-hints"};
  const json first = result(typed).at(0);
  EXPECT_THAT(text("heap.png.repose.toml"),
              AllOf(HasSubstr("board = true"), HasSubstr("square_mm = 23.9"),
                    HasSubstr("camera_file = 'camera.toml'")));
  const json again = result({"heap.png"}).at(0);
  EXPECT_EQ(again["mm_per_px"], first["mm_per_px"]);
  EXPECT_EQ(again["angle_deg"], first["angle_deg"]);
  EXPECT_EQ(again["camera"]["file"], "camera.toml");
  const json given = result({"heap.png", "--scale", "120,700,600,700,480"}).at(0);
  EXPECT_EQ(given["scale"], "given") << "what is typed stands above what is saved";
}

TEST_F(MeasureWithScale, TheProposalForARefusedPictureRepeatsWhatWasTyped) {
  constexpr std::size_t kWidth = 400, kHeight = 300;
  vision::Picture night{.width = kWidth,
                        .height = kHeight,
                        .bgr = std::vector<std::uint8_t>(3 * kWidth * kHeight, 40)};
  for (std::size_t y = 180; y < 240; ++y) {
    for (std::size_t x = 100; x < 300; ++x) night.bgr[3 * (kWidth * y + x)] = 200;
  }
  vision::write_picture(path("a box.png"), night);
  const Finished done = run(
      {"a box.png", "--scale", "10,20,210,20,100", "--pitch-deg", "3", "--exclude", "0,0,40,40"});
  EXPECT_EQ(done.exit_code, 3);
  std::string words = done.out;  // the table wraps its lines
  std::replace(words.begin(), words.end(), '\n', ' ');
  words = std::regex_replace(words, std::regex(" +"), " ");
  EXPECT_THAT(words, AllOf(HasSubstr("try: repose measure 'a box.png'"),
                           HasSubstr("--scale 10,20,210,20,100"), HasSubstr("--pitch-deg 3"),
                           HasSubstr("--exclude 0,0,40,40"), HasSubstr("--heap ")));
}

TEST_F(MeasureWithScale, TwoPointsGiveASizeAndWhatDoesNotFitIsSaid) {
  draw();
  const json heap =
      result({"heap.png", "--exclude", "602,240,598,440", "--scale", "120,700,600,700,240"}).at(0);
  EXPECT_EQ(heap["scale"], "given");
  EXPECT_DOUBLE_EQ(heap["mm_per_px"].get<double>(), .5);
  EXPECT_NEAR(heap["base_mm"].get<double>(), 240, 20);  // its toes are drawn as loose grains
  EXPECT_TRUE(heap["board"].is_null());

  const json plain = result({"heap.png", "--exclude", "602,240,598,440"}).at(0);
  EXPECT_TRUE(plain["height_mm"].is_null());
  EXPECT_TRUE(plain["scale"].is_null());
  EXPECT_EQ(plain["angle_deg"], heap["angle_deg"]);

  const Finished wrong =
      run({"heap.png", "--board", "--scale", "1,1,2,2,5", "--board-behind", "20"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_THAT(wrong.err, AllOf(HasSubstr("--scale 1,1,2,2,5: must be two points"),
                               HasSubstr("needs --camera-file")));
  EXPECT_THAT(run({"heap.png", "--square-mm", "20"}).err, HasSubstr("Fix: add --board"));
  EXPECT_THAT(run({"heap.png", "--camera-file", "none.toml"}).err, HasSubstr("none.toml"));
}

}  // namespace
}  // namespace repose::testing
