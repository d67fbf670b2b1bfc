// Films of drops, rolls and tilts over the studio's HTTP interface.
#include <algorithm>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>

#include "calibrate/measured/tracked_film.h"
#include "tests/studio/served_folder.h"
#include "tests/support/places.h"

namespace repose::studio {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

/// A folder with films of each experiment, and a study of drops and tilts.
class FilmsOfBench : public ::testing::Test {
 protected:
  FilmsOfBench() {
    namespace fs = std::filesystem;
    const fs::path films = repose::testing::source_folder() / "samples/from_camera/films";
    for (const char* name : {"drop_1.mp4", "drop_2.mp4", "tilt_1.mp4", "roll_1.mp4"}) {
      fs::copy_file(films / name, studio_.folder.path() / name);
    }
    studio_.post("/api/studies", {{"study", "peas"},
                                  {"grains", "pea"},
                                  {"plate", "wood"},
                                  {"experiments", {"drop", "tilt"}}});
    set("experiment.drop", "height_mm", "200");
  }

  void set(const std::string& section, const std::string& key, const std::string& value) {
    const Json study = studio_.get("/api/study?study=peas.toml");
    studio_.put("/api/numbers?study=peas.toml",
                {{"numbers", {{section, {{key, value}}}}}, {"version", study.at("version")}});
  }
  Json track(const std::string& file, const Json& told, int status = 200) const {
    return studio_.post("/api/film/track?file=" + file, told, status);
  }
  Json to_sheet(const Json& found, const Json& bounces, int status = 200) const {
    return studio_.post("/api/film/readings?study=peas.toml&number=" + found.at("number").dump(),
                        {{"bounces", bounces}}, status);
  }

  test::ServedFolder studio_;
};

TEST_F(FilmsOfBench, AreTrackedAsTheCommandLineTracksThem) {
  const Json found = track("drop_1.mp4", {{"experiment", "drop"}});
  EXPECT_THAT(found.at("command").get<std::string>(), StartsWith("repose track drop "));
  const auto same = calibrate::tracked_film(
      {.film = {studio_.folder.path() / "drop_1.mp4"}, .filmed = vision::Filmed::drop});
  EXPECT_EQ(found.at("tracked"), calibrate::tracked_json(same));
  ASSERT_GE(found.at("tracked").at("bounces").size(), 3);
  const auto overlay = studio_.client->Get("/api/film/overlay?number=" + found.at("number").dump());
  EXPECT_EQ(overlay->get_header_value("Content-Type"), "image/jpeg");
  EXPECT_EQ(studio_.client->Get("/api/film/overlay?number=77")->status, 400);
}

TEST_F(FilmsOfBench, AKnownLengthIsTheScale) {
  const Json by_gravity = track("drop_1.mp4", {{"experiment", "drop"}});
  const Json told{{"experiment", "drop"},
                  {"scale", {{"line", {10, 10, 10, 110}}, {"length_mm", 72}}}};
  const Json found = track("drop_1.mp4", told);
  EXPECT_THAT(found.at("command").get<std::string>(), EndsWith("--scale 10,10,10,110,72"));
  EXPECT_EQ(by_gravity.at("tracked").at("track").at("scale"), "gravity");
  EXPECT_EQ(found.at("tracked").at("track").at("scale"), "given");
  EXPECT_NEAR(found.at("tracked").at("track").at("mm_per_px").get<double>(), .72, 1e-9);
}

TEST_F(FilmsOfBench, ARollNeedsOneScale) {
  const Json none = track("roll_1.mp4", {{"experiment", "roll"}}, 400);
  EXPECT_THAT(none.at("error").get<std::string>(), HasSubstr("there is no scale yet"));
  const Json found = track("roll_1.mp4", {{"experiment", "roll"}, {"released_mm", 100}});
  EXPECT_THAT(found.at("command").get<std::string>(), EndsWith("--released 100"));
  EXPECT_EQ(found.at("tracked").at("status"), "ok");
  const Json both = track("roll_1.mp4",
                          {{"experiment", "roll"},
                           {"released_mm", 100},
                           {"scale", {{"line", {10, 10, 10, 110}}, {"length_mm", 72}}}},
                          400);
  EXPECT_THAT(both.at("error").get<std::string>(), HasSubstr("two scales"));
  EXPECT_THAT(track("roll_1.mp4", {{"experiment", "heap"}}, 400).at("error").get<std::string>(),
              HasSubstr("drop, roll or tilt"));
}

TEST_F(FilmsOfBench, AreRefusedWithTheReasonWhereTheyShowSomethingElse) {
  const Json found = track("tilt_1.mp4", {{"experiment", "drop"}});
  EXPECT_EQ(found.at("tracked").at("status"), "refused");
  EXPECT_THAT(found.at("tracked").at("reason").get<std::string>(), HasSubstr("Fix: "));
  EXPECT_THAT(to_sheet(found, {1}, 400).at("error").get<std::string>(),
              HasSubstr("gives no reading"));
}

TEST_F(FilmsOfBench, AreLookedAtFrameByFrame) {
  const Json film = studio_.get("/api/film?file=drop_1.mp4");
  const auto times_s = film.at("times_s").get<std::vector<double>>();
  EXPECT_TRUE(std::ranges::is_sorted(times_s));
  const Json found = track("drop_1.mp4", {{"experiment", "drop"}});
  EXPECT_EQ(times_s.size(), found.at("tracked").at("film").at("frames"));
  EXPECT_EQ(film.at("width"), found.at("tracked").at("film").at("width"));
  const auto last = studio_.client->Get("/api/film/frame?file=drop_1.mp4&number=" +
                                        std::to_string(times_s.size() - 1));
  EXPECT_EQ(last->get_header_value("Content-Type"), "image/jpeg");
  EXPECT_EQ(studio_.client
                ->Get("/api/film/frame?file=drop_1.mp4&number=" + std::to_string(times_s.size()))
                ->status,
            400);
  EXPECT_EQ(studio_.client->Get("/api/film?file=peas.toml")->status, 400);
}

TEST_F(FilmsOfBench, GiveTheSheetOfAStudyTheirReadings) {
  const Json first = track("drop_1.mp4", {{"experiment", "drop"}});
  EXPECT_EQ(to_sheet(first, {1}).at("sheet"), "peas/drops.csv");
  to_sheet(track("drop_2.mp4", {{"experiment", "drop"}}), {1});
  // Submitted again, it keeps its place.
  to_sheet(first, {1});
  const std::string sheet = studio_.text("peas/drops.csv");
  EXPECT_EQ(std::ranges::count(sheet, '\n'), 3) << sheet;
  EXPECT_THAT(sheet, StartsWith("drop_mm,rebound_mm,sample,in_air,drop_uncertainty_mm\n"));
  EXPECT_THAT(sheet, HasSubstr(",drop_1,0,"));
  to_sheet(track("tilt_1.mp4", {{"experiment", "tilt"}}), Json::array());
  EXPECT_THAT(studio_.text("peas/tilts.csv"), HasSubstr(",tilt_1"));
  // The study accepts them.
  EXPECT_EQ(studio_.get("/api/study?study=peas.toml").at("faults"), Json::array());
}

TEST_F(FilmsOfBench, WriteNothingIntoASheetThatTheyDoNotFit) {
  const Json found = track("drop_1.mp4", {{"experiment", "drop"}});
  const std::string empty = studio_.text("peas/drops.csv");
  // A later bounce falls from a height other than the study's.
  EXPECT_THAT(to_sheet(found, {2}, 400).at("error").get<std::string>(), HasSubstr("drop_mm"));
  EXPECT_EQ(studio_.text("peas/drops.csv"), empty);
  // Heights that were read in air cannot be mixed with those of a film.
  const Json study = studio_.get("/api/study?study=peas.toml");
  studio_.put("/api/sheet?study=peas.toml&experiment=drop",
              {{"columns", {"drop_mm", "rebound_mm"}},
               {"rows", Json::array({Json::array({"200", "70"})})},
               {"version", study.at("experiments").at(0).at("sheet").at("version")}});
  EXPECT_THAT(to_sheet(found, {1}, 400).at("error").get<std::string>(),
              HasSubstr("in_air differs from row to row"));
  EXPECT_EQ(studio_.text("peas/drops.csv"), "drop_mm,rebound_mm\n200,70\n");
  const Json roll = track("roll_1.mp4", {{"experiment", "roll"}, {"released_mm", 100}});
  EXPECT_THAT(to_sheet(roll, Json::array(), 400).at("error").get<std::string>(),
              HasSubstr("names no sheet in this folder for roll"));
}

}  // namespace
}  // namespace repose::studio
