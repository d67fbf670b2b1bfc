#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "tests/cli/run_program.h"
#include "tests/support/heap_picture.h"
#include "vision/picture/picture.h"

namespace repose::testing {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;
using ::testing::UnorderedElementsAre;
using Words = std::vector<std::string>;

/// A folder with drawn pictures in it; they are drawn once for all tests.
class Measure : public ::testing::Test {
 protected:
  void draw_heap_to(const std::string& name) const {
    static const vision::Picture heap = [] {
      HeapScene scene;
      scene.width = 600;
      scene.height = 400;
      return draw_heap(scene).picture;
    }();
    vision::write_picture(folder_.path() / name, heap);
  }
  void draw_slopes_to(const std::string& name, double angle_rad) const {
    HeapScene scene;
    scene.width = 600;
    scene.height = 400;
    scene.form.left_rad = scene.form.right_rad = angle_rad;
    vision::write_picture(folder_.path() / name, draw_heap(scene).picture);
  }
  void draw_plain(const std::string& name, int width = 300, std::uint8_t brightness = 0) const {
    const auto bytes =
        std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(width);
    vision::write_picture(
        folder_.path() / name,
        {.width = width, .height = width, .bgr = std::vector<std::uint8_t>(bytes, brightness)});
  }
  Finished run(const Words& words) const {
    Words all = {"measure"};
    all.insert(all.end(), words.begin(), words.end());
    return run_repose(folder_, all);
  }
  std::string text(const std::string& name) const { return text_of(folder_.path() / name); }
  bool exists(const std::string& name) const {
    return std::filesystem::exists(folder_.path() / name);
  }

  TemporaryFolder folder_;
};

std::size_t letters(const std::string& line) {
  return static_cast<std::size_t>(std::count_if(line.begin(), line.end(), [](char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0) != 0x80;
  }));
}

using MeasureThreads = Measure;

TEST_F(Measure, EveryResultSaysByWhichDefinitionItIs) {
  draw_heap_to("a.png");
  draw_slopes_to("b.png", .4);
  const Finished usual = run({"a.png", "b.png", "--summary", "usual.json"});
  EXPECT_THAT(usual.out, Not(HasSubstr("all angles by")));
  EXPECT_EQ(json::parse(text("usual.json"))["definition"], "flank_20_80");
  const Finished named =
      run({"a.png", "b.png", "--definition", "height-over-base", "--summary", "named.json", "--csv",
           "named.csv", "--json", "all.json", "--report", "page.html"});
  ASSERT_EQ(named.exit_code, 0) << named.err;
  EXPECT_THAT(named.out, HasSubstr("all angles by height_over_base: crest height"));
  EXPECT_EQ(json::parse(text("named.json"))["definition"], "height_over_base");
  EXPECT_THAT(text("named.csv"),
              AllOf(HasSubstr(",definition\n"), HasSubstr(",height_over_base\n")));
  EXPECT_EQ(json::parse(text("all.json"))[0]["definition"], "height_over_base");
  EXPECT_THAT(text("page.html"), HasSubstr("height_over_base: crest height"));
  const Finished own = run({"a.png", "--window", "0.1,0.9", "--summary", "own.json"});
  EXPECT_THAT(own.out, HasSubstr("all angles by line at 10-90 % of the height"));
  EXPECT_TRUE(json::parse(text("own.json"))["definition"].is_null());
}

TEST_F(Measure, AHeapGivesAnAngle) {
  draw_heap_to("heap.png");
  const Finished result = run({"heap.png"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("heap.png"), HasSubstr(" ± "), HasSubstr("ok")));
  EXPECT_THAT(result.out, Not(HasSubstr("mean "))) << "one picture has no mean";
  EXPECT_THAT(result.err, IsEmpty());
}

TEST_F(Measure, PipedTablesAreNarrowAndWithoutColour) {
  const std::string name = "a_very_long_name_of_a_picture_that_somebody_took_in_the_lab.png";
  draw_heap_to(name);
  draw_plain("black.png");
  const Finished result = run({name, "black.png", "--definitions"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, Not(HasSubstr("\033")));
  std::istringstream lines(result.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(letters(line), 80U) << line;
}

TEST_F(Measure, FoldersStandForTheirPicturesByName) {
  std::filesystem::create_directories(folder_.path() / "photos" / "deeper");
  draw_plain("photos/b.png");
  draw_plain("photos/a.JPG");
  draw_plain("photos/deeper/c.png");
  folder_.write("photos/notes.txt", std::string("no picture"));
  draw_plain("photos/heap.overlay.png");
  folder_.write("photos/heap.vtp", std::string("what the overlay is of"));
  const json array = json::parse(run({"photos", "--json", "-"}).out);
  ASSERT_EQ(array.size(), 2U);
  EXPECT_EQ(array[0]["file"], "photos/a.JPG");
  EXPECT_EQ(array[1]["file"], "photos/b.png");
}

TEST_F(Measure, SavedHintsAreUsedAgainAndNamed) {
  draw_heap_to("heap.png");
  const Words hints = {"heap.png", "--heap", "0,20,600,380", "--keep", "300,250", "--json", "-"};
  Words saving = hints;
  saving.emplace_back("--save-hints");
  const Finished first = run(saving);
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(json::parse(first.out)[0]["hints"]["file"], nullptr);
  EXPECT_THAT(text("heap.png.repose.toml"),
              AllOf(HasSubstr("heap = [0, 20, 600, 380]"), HasSubstr("keep = [[300, 250]]")));
  const json again = json::parse(run({"heap.png", "--json", "-"}).out)[0];
  EXPECT_EQ(again["hints"]["file"], "heap.png.repose.toml");
  EXPECT_EQ(again["hints"]["heap"], json::array({0, 20, 600, 380}));
  EXPECT_EQ(again["angle_deg"], json::parse(first.out)[0]["angle_deg"]);
  EXPECT_THAT(run({"heap.png"}).out, HasSubstr("in heap.png.repose.toml: box around the heap"));
}

TEST_F(Measure, APictureThatLiesOnItsSideIsAskedAboutAndTurned) {
  draw_heap_to("upright.png");
  vision::write_picture(folder_.path() / "lying.png",
                        vision::turned(vision::read_picture(folder_.path() / "upright.png"), 270));
  EXPECT_THAT(run({"lying.png"}).out,
              AllOf(HasSubstr("--rotate 90"), HasSubstr("picture lie on its side?")));
  run({"lying.png", "--rotate", "90", "--save-hints"});
  run({"lying.png", "upright.png", "--json", "both.json"});
  const json both = json::parse(text("both.json"));
  EXPECT_EQ(both.at(0).at("angle_deg"), both.at(1).at("angle_deg"));
  EXPECT_EQ(both.at(0).at("hints").at("rotate_deg"), 90);
  EXPECT_THAT(both.at(0).dump(), HasSubstr("turned clockwise by 90 degrees"));
  // All other commands that read the picture do the same.
  EXPECT_THAT(run_repose(folder_, {"compare", "lying.png", "upright.png"}).out,
              HasSubstr("difference"));
  EXPECT_THAT(run({"lying.png", "--rotate", "45"}).err, HasSubstr("--rotate 45"));
}

TEST_F(Measure, HintsThatCannotBeReadAreSaid) {
  draw_heap_to("heap.png");
  const Finished typed = run(
      {"heap.png", "--heap", "1,2,3", "--ground", "a,b", "--keep", "7", "--mask", "nowhere.png"});
  EXPECT_EQ(typed.exit_code, 2);
  EXPECT_THAT(typed.err, AllOf(HasSubstr("--heap 1,2,3"), HasSubstr("--ground a,b"),
                               HasSubstr("--keep 7"), HasSubstr("--mask nowhere.png")));
  const Finished outside = run({"heap.png", "--heap", "500,0,200,100", "--save-hints"});
  EXPECT_EQ(outside.exit_code, 2);
  EXPECT_THAT(outside.err, HasSubstr("--heap"));
  EXPECT_FALSE(exists("heap.png.repose.toml")) << "a hint that was refused is not saved";
}

TEST_F(Measure, FoldersWithoutPicturesAreSaid) {
  std::filesystem::create_directory(folder_.path() / "empty");
  const Finished result = run({"empty"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("empty: no pictures"), HasSubstr("Fix: ")));
}

TEST_F(Measure, UnmeasurablePicturesAreRefusedWithAReason) {
  draw_plain("black.png", 300, 0);
  draw_plain("grey.png", 300, 128);
  draw_plain("dot.png", 1, 200);
  const Finished result = run({"black.png", "grey.png", "dot.png", "--json", "-"});
  EXPECT_EQ(result.exit_code, 3);
  for (const json& picture : json::parse(result.out)) {
    EXPECT_EQ(picture["status"], "refused");
    EXPECT_NE(picture["reason"], "");
    EXPECT_TRUE(picture["angle_deg"].is_null());
    EXPECT_TRUE(picture["uncertainty_deg"].is_null());
  }
}

TEST_F(Measure, AnUnreadablePictureDoesNotStopTheOthers) {
  draw_heap_to("heap.png");
  folder_.write("notes.jpg", std::string("angle: 23 degrees"));
  const std::string whole = text("heap.png");
  folder_.write("half.png", whole.substr(0, whole.size() / 2));
  const Finished result = run({"missing.jpg", "notes.jpg", "half.png", "heap.png"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.out, AllOf(HasSubstr("not read"), HasSubstr(" ± "), HasSubstr("3 not read")));
  EXPECT_THAT(result.err, AllOf(HasSubstr("missing.jpg: there is no such file"),
                                HasSubstr("notes.jpg: no picture"),
                                HasSubstr("half.png: the PNG is truncated")));
}

TEST_F(Measure, JsonHasTheContractsKeys) {
  draw_heap_to("heap.png");
  const Finished result = run({"heap.png", "missing.png", "--json", "-"});
  const json array = json::parse(result.out);
  ASSERT_EQ(array.size(), 2U);
  for (const json& picture : array) {
    for (const char* key :
         {"file", "status", "angle_deg", "uncertainty_deg", "left", "right", "ground_tilt_deg",
          "window", "method", "confidence", "warnings", "segmentation", "strays", "grain_px",
          "height_px", "base_px", "definitions"}) {
      EXPECT_TRUE(picture.contains(key)) << key;
    }
    for (const char* key : {"status", "angle_deg", "uncertainty_deg", "r2", "points"}) {
      EXPECT_TRUE(picture["left"].contains(key)) << key;
    }
  }
  EXPECT_TRUE(array[0]["angle_deg"].is_number());
  EXPECT_FALSE(array[0].contains("reason"));
  EXPECT_EQ(array[0]["window"], json({0.2, 0.8}));
  EXPECT_EQ(array[1]["status"], "refused");
  EXPECT_THAT(array[1]["reason"].get<std::string>(), HasSubstr("no such file"));
  EXPECT_TRUE(array[1]["angle_deg"].is_null());
  EXPECT_TRUE(array[1]["confidence"].is_null());
}

TEST_F(Measure, MethodWindowAndPitchReachTheMeasuring) {
  draw_heap_to("heap.png");
  const auto measured = [&](Words words) {
    words.insert(words.end(), {"heap.png", "--json", "-"});
    return json::parse(run(words).out).at(0);
  };
  const json usual = measured({});
  EXPECT_EQ(measured({"--method", "auto", "--window", "0.2,0.8"}), usual);
  EXPECT_EQ(measured({"--method", "paper"})["method"], "paper");
  EXPECT_EQ(measured({"--window", "0.3,0.7"})["window"], json({0.3, 0.7}));
  EXPECT_NE(measured({"--pitch-deg", "-10"})["angle_deg"], usual["angle_deg"]);
  EXPECT_TRUE(usual["pitch_deg"].is_null());
  const json told_level = measured({"--pitch-deg", "0"});
  EXPECT_EQ(told_level["pitch_deg"], 0);
  EXPECT_EQ(told_level["angle_deg"], usual["angle_deg"]);
  EXPECT_NE(told_level["uncertainty_deg"], usual["uncertainty_deg"]);  // given is not unknown
}

TEST_F(Measure, ABoxOutsideOnePictureErrorsOnlyThatPicture) {
  draw_heap_to("large.png");
  draw_plain("small.png", 100);
  const Finished result = run({"large.png", "small.png", "--exclude", "0,0,120,20", "--json", "-"});
  EXPECT_EQ(result.exit_code, 2);
  const json array = json::parse(result.out);
  EXPECT_TRUE(array[0]["angle_deg"].is_number());
  EXPECT_THAT(result.err, StartsWith("repose: small.png: "));
}

TEST_F(Measure, SeveralPicturesHaveAMeanOfThoseThatAreOk) {
  draw_heap_to("a.png");
  draw_heap_to("b.png");  // a copy: not a second heap
  HeapScene other;
  other.width = 600;
  other.height = 400;
  other.form.left_rad = other.form.right_rad = .5;
  vision::write_picture(folder_.path() / "c.png", draw_heap(other).picture);
  draw_plain("black.png");
  const Finished result =
      run({"a.png", "b.png", "c.png", "black.png", "--summary", "mean.json", "--json", "all.json"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.out, AllOf(HasSubstr("mean "), HasSubstr("n = 2"), HasSubstr("(Student)"),
                                HasSubstr("1 refused, 1 copy of others")));
  EXPECT_THAT(result.err, HasSubstr("b.png: the same picture as a.png, counted once"));
  const json summary = json::parse(text("mean.json"));
  EXPECT_EQ(summary["n"], 2);
  EXPECT_EQ(summary["refused"], 1);
  EXPECT_EQ(summary["copies"], 1);
  EXPECT_LT(summary["interval_deg"][0], summary["mean_deg"]);
  const json all = json::parse(text("all.json"));
  EXPECT_EQ(all[1]["copy_of"], "a.png");
  EXPECT_TRUE(all[2]["copy_of"].is_null());
}

TEST_F(Measure, PicturesThatDifferInANumberAreOfOneHeapWhenAsked) {
  draw_slopes_to("a_1.png", .38);
  draw_slopes_to("a_2.png", .4);
  draw_slopes_to("b-1.png", .42);
  const std::vector<std::string> pictures = {"a_1.png", "a_2.png", "b-1.png"};
  std::vector<std::string> grouped = pictures;
  grouped.insert(grouped.end(),
                 {"--group-by-name", "--summary", "mean.json", "--json", "all.json"});
  const Finished result = run(grouped);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("3 pictures of 2 heaps, n counts heaps"));
  const json summary = json::parse(text("mean.json"));
  EXPECT_EQ(summary["n"], 2);
  EXPECT_EQ(summary["pictures"], 3);
  EXPECT_TRUE(summary["within_heaps_sd_deg"].is_number());
  const json all = json::parse(text("all.json"));
  EXPECT_EQ(all[0]["heap"], "a");
  EXPECT_EQ(all[1]["heap"], "a");
  EXPECT_EQ(all[2]["heap"], "b");
  EXPECT_GT(all[0]["camera_uncertainty_deg"], 0);
  EXPECT_LT(all[0]["camera_uncertainty_deg"], all[0]["uncertainty_deg"]);
  EXPECT_THAT(run(pictures).out, AllOf(HasSubstr("n = 3"), Not(HasSubstr("n counts heaps"))));
}

TEST_F(Measure, AnOutlierIsNamedInEveryOutput) {
  draw_slopes_to("a.png", .37);
  draw_slopes_to("b.png", .38);
  draw_slopes_to("c.png", .39);
  draw_slopes_to("other.png", .8);
  const Finished result = run({"a.png", "b.png", "c.png", "other.png", "--summary", "mean.json",
                               "--json", "all.json", "--report", "page.html"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, AllOf(HasSubstr("is an outlier: the median"), HasSubstr("other.png")));
  const json summary = json::parse(text("mean.json"));
  ASSERT_EQ(summary["outliers"].size(), 1U);
  EXPECT_EQ(summary["outliers"][0]["file"], "other.png");
  EXPECT_GT(summary["outliers"][0]["score"], 3.5);
  const bool is_counted = summary["outliers"][0]["counted"];
  EXPECT_EQ(is_counted, json::parse(text("all.json"))[3]["status"] == "ok");
  EXPECT_EQ(summary["n"], is_counted ? 4 : 3);
  EXPECT_EQ(summary["all"]["n"], 4);
  EXPECT_EQ(json::parse(text("all.json"))[3]["warnings"].back()["code"], "outlier");
  EXPECT_THAT(text("page.html"), HasSubstr("is an outlier: the median"));
}

TEST_F(Measure, ACopyInAnotherFormatIsNoSecondHeap) {
  draw_heap_to("a.png");
  const vision::Picture heap = vision::read_picture(folder_.path() / "a.png");
  // A bitmap with its rows bottom-up: the same pixels in different bytes.
  std::string bitmap = "BM";
  const auto number = [&](std::uint32_t value, int bytes) {
    for (int k = 0; k < bytes; ++k) bitmap += static_cast<char>(value >> (8 * k) & 0xFFU);
  };
  const auto width = static_cast<std::uint32_t>(heap.width);
  const auto height = static_cast<std::uint32_t>(heap.height);
  const std::uint32_t size = 3 * width * height;
  number(54 + size, 4), number(0, 4), number(54, 4), number(40, 4), number(width, 4);
  number(height, 4), number(1, 2), number(24, 2), number(0, 4), number(size, 4);
  number(2835, 4), number(2835, 4), number(0, 4), number(0, 4);
  for (std::uint32_t row = height; row-- > 0;) {
    const auto begin = heap.bgr.begin() + std::ptrdiff_t{3} * width * row;
    bitmap.append(begin, begin + std::ptrdiff_t{3} * width);
  }
  folder_.write("b.bmp", bitmap);
  EXPECT_THAT(run({"a.png", "b.bmp"}).err, HasSubstr("b.bmp: the same picture as a.png"));
}

/// Fields of a line without quotes.
std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> result(1);
  for (const char letter : line) {
    if (letter == ',') {
      result.emplace_back();
    } else {
      result.back() += letter;
    }
  }
  return result;
}

TEST_F(Measure, CsvHasARowForEachPicture) {
  draw_heap_to("heap.png");
  draw_plain("with, comma.png");
  const Finished result = run({"heap.png", "with, comma.png", "missing.png", "--csv", "-"});
  EXPECT_EQ(result.exit_code, 2);
  std::istringstream lines(result.out);
  std::string header, heap, comma, missing, end;
  std::getline(lines, header);
  std::getline(lines, heap);
  std::getline(lines, comma);
  std::getline(lines, missing);
  EXPECT_FALSE(std::getline(lines, end));
  EXPECT_EQ(fields(heap).size(), fields(header).size());
  EXPECT_THAT(heap, StartsWith("heap.png,"));
  EXPECT_THAT(comma, StartsWith("\"with, comma.png\",refused,"));
  EXPECT_EQ(fields(missing).size(), fields(header).size());
}

TEST_F(Measure, OnlyTheOutputAskedForGoesToStandardOutput) {
  draw_heap_to("heap.png");
  const Finished result =
      run({"heap.png", "--json", "all.json", "--csv", "all.csv", "--summary", "-"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(json::parse(result.out)["n"], 1);
  EXPECT_EQ(json::parse(text("all.json")).size(), 1U);
  EXPECT_THAT(text("all.csv"), StartsWith("file,status,"));
}

TEST_F(Measure, OutputsInOnePlaceAreRefused) {
  draw_heap_to("heap.png");
  for (const auto& [json_file, csv_file] :
       {std::pair("-", "-"), {"out", "./out"}, {"heap.png", "x.csv"}}) {
    const Finished result = run({"heap.png", "--json", json_file, "--csv", csv_file});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_THAT(result.err, AllOf(HasSubstr("--json"), HasSubstr("Fix: ")));
  }
  EXPECT_THAT(folder_.names(), ElementsAre("heap.png"));
}

TEST_F(Measure, OverlaysAreDrawnAlsoForRefusedPictures) {
  draw_heap_to("heap.png");
  draw_plain("black.png");
  EXPECT_EQ(run({"heap.png", "black.png", "--overlay", "new/checked"}).exit_code, 0);
  EXPECT_GE(vision::read_picture(folder_.path() / "new/checked/heap.png").width, 600);
  EXPECT_TRUE(exists("new/checked/black.png"));
}

TEST_F(Measure, PicturesOfOneNameHaveOverlaysOfTheirOwn) {
  std::filesystem::create_directory(folder_.path() / "other");
  draw_heap_to("heap.png");
  draw_heap_to("heap.jpg");
  draw_heap_to("other/heap.png");
  const Finished result = run({"heap.jpg", "heap.png", "other/heap.png", "--overlay", "."});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(folder_.names(), UnorderedElementsAre("heap.png", "heap.jpg", "other", "heap-2.png",
                                                    "heap-3.png", "heap-4.png"));
  EXPECT_EQ(vision::read_picture(folder_.path() / "heap.png").height, 400) << "not overwritten";
  EXPECT_THAT(result.err, HasSubstr("heap-2.png"));
}

TEST_F(Measure, AnOverlayFolderThatIsMeasuredIsRefused) {
  draw_heap_to("heap.png");
  const Finished result = run({".", "--overlay", "."});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("--overlay"));
}

TEST_F(Measure, UnwritablePlacesAreSaidBeforeMeasuring) {
  draw_heap_to("heap.png");
  folder_.write("file", std::string("in the way"));
  const Finished result =
      run({"heap.png", "--overlay", "file", "--json", "no/x.json", "--csv", "no/x.csv"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.out, IsEmpty());
  EXPECT_THAT(result.err, AllOf(HasSubstr("--overlay file"), HasSubstr("--json no/x.json"),
                                HasSubstr("--csv no/x.csv")));
}

TEST_F(Measure, LockedFoldersAreSaid) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may do everything";
  draw_heap_to("heap.png");
  std::filesystem::create_directory(folder_.path() / "locked");
  std::filesystem::permissions(folder_.path() / "locked", std::filesystem::perms::none);
  const Finished result = run({"heap.png", "locked", "--json", "locked/x.json"});
  std::filesystem::permissions(folder_.path() / "locked", std::filesystem::perms::owner_all);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, AllOf(HasSubstr("locked: "), HasSubstr("--json locked/x.json")));
}

TEST_F(Measure, APictureNamedTwiceCountsOnce) {
  draw_heap_to("heap.png");
  const Finished result = run({"heap.png", "./heap.png", "--json", "-"});
  EXPECT_EQ(json::parse(result.out).size(), 1U);
  EXPECT_THAT(result.err, HasSubstr("named twice"));
}

TEST_F(MeasureThreads, GiveTheSameBytes) {
  for (const char* name : {"a.png", "b.jpg", "c.png", "d.jpg"}) draw_heap_to(name);
  draw_plain("e.png");
  const auto bytes_with = [&](const std::string& threads) {
    const std::string overlays = "overlays" + threads;
    const Finished result = run({"a.png", "b.jpg", "c.png", "d.jpg", "e.png", "--json", "-",
                                 "--overlay", overlays, "--threads", threads});
    EXPECT_EQ(result.exit_code, 0);
    return result.out + text(overlays + "/a.png") + text(overlays + "/b.png");
  };
  const std::string alone = bytes_with("1");
  EXPECT_EQ(bytes_with("2"), alone);
  EXPECT_EQ(bytes_with("7"), alone);
}

}  // namespace
}  // namespace repose::testing
