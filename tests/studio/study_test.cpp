// Studies over HTTP: created from a form, their sheets filled in, their numbers changed.
#include <filesystem>
#include <string>

#include "tests/studio/served_folder.h"
#include "tests/support/places.h"
#include "tests/support/run_program.h"

namespace repose::studio {
namespace {

using test::ServedFolder;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

class StudioStudies : public ::testing::Test {
 protected:
  const Json kPeas = Json::parse(R"({"study": "peas", "grains": "pea", "plate": "wood",
      "experiments": ["drop", "tilt"]})");

  void start_peas() { studio_.post("/api/studies", kPeas); }

  /// One of the study's experiments, as sent to the page.
  Json experiment(const std::string& name) {
    const Json study = studio_.get("/api/study?study=peas.toml");
    for (const Json& one : study.at("experiments")) {
      if (one.at("experiment") == name) return one;
    }
    return {};
  }

  static std::string texts(const Json& faults) {
    std::string all;
    for (const Json& fault : faults) all += fault.at("text").get<std::string>() + '\n';
    return all;
  }

  ServedFolder studio_;
};

constexpr const char* kDrops = "/api/sheet?study=peas.toml&experiment=drop";

TEST_F(StudioStudies, TheFormAsksWhatTheCommandLineAsks) {
  const Json form = studio_.get("/api/new");
  EXPECT_EQ(form.at("grains").size(), 9U);
  EXPECT_EQ(form.at("grains").at(0).at("with_wall").at("restitution"), Json({.3, .9}));
  EXPECT_THAT(form.at("grains").at(0).at("source"), HasSubstr("Boac"));
  EXPECT_THAT(form.at("parts"), Contains("incline"));
  const Json draft = studio_.post("/api/new", kPeas);
  EXPECT_THAT(draft.at("faults"), IsEmpty());
  EXPECT_EQ(draft.at("command"),
            "repose new peas.toml --grains pea --plate wood --experiments drop,tilt");
  EXPECT_EQ(draft.at("usual").at("grain_mm"), Json({7.6, 7.2, 6.9}));
  EXPECT_FALSE(std::filesystem::exists(studio_.folder.path() / "peas.toml"));
}

TEST_F(StudioStudies, AStudyFromTheFormIsTheOneOfTheCommandLine) {
  EXPECT_EQ(studio_.post("/api/studies", kPeas).at("study"), "peas.toml");
  const testing::TemporaryFolder other;
  const auto typed = testing::run_program(
      testing::program(), other,
      {"new", "peas.toml", "--grains", "pea", "--plate", "wood", "--experiments", "drop,tilt"});
  ASSERT_EQ(typed.exit_code, 0) << typed.err;
  for (const char* name : {"peas.toml", "peas/drops.csv", "peas/tilts.csv"}) {
    EXPECT_EQ(studio_.text(name), testing::text_of(other.path() / name)) << name;
  }
  const Json studies = studio_.get("/api/studies").at("studies");
  ASSERT_EQ(studies.size(), 1U);
  EXPECT_EQ(studies.at(0).at("title"), "Peas on wood");
  // Its sheets are empty.
  ASSERT_EQ(studies.at(0).at("faults").size(), 2U);
  EXPECT_THAT(studies.at(0).at("faults").at(0), StartsWith("peas/drops.csv: no readings yet"));
  EXPECT_EQ(experiment("drop").at("sheet").at("columns").at(0).at("usual"), "500");
  EXPECT_EQ(experiment("drop").at("sheet").at("columns").at(1).at("usual"), nullptr);
  studio_.post("/api/studies", kPeas, 400);
}

TEST_F(StudioStudies, EachFieldOfTheFormHasItsFaults) {
  const Json draft = studio_.post("/api/new", Json::parse(R"({"study": "../peas",
      "grains": "pee", "grain_mm": ["7,5", "", ""], "density_kg_m3": "heavy", "tube": "wood",
      "experiments": ["drop"]})"));
  std::string fields;
  for (const Json& fault : draft.at("faults")) {
    fields += fault.at("field").get<std::string>() + ';';
  }
  EXPECT_THAT(fields, AllOf(HasSubstr("study;"), HasSubstr("kind of grain;"), HasSubstr("size;"),
                            HasSubstr("density;"), HasSubstr("tube;")));
  EXPECT_THAT(texts(draft.at("faults")), AllOf(HasSubstr("has 1 of its 3 numbers"),
                                               HasSubstr("is \"heavy\""), Not(HasSubstr("--"))));
  for (const char* name : {"../peas", "/tmp/peas", ".peas", "-peas", "", "a/b"}) {
    Json said = kPeas;
    said["study"] = name;
    studio_.post("/api/studies", said, 400);
  }
  studio_.post("/api/studies", Json::array(), 400);
  EXPECT_THAT(studio_.folder.names(), ElementsAre(".repose-studio.lock"));
}

TEST_F(StudioStudies, WrongCellsAreToldAsTheCommandLineTellsThem) {
  start_peas();
  const Json wrong = studio_.post(kDrops, Json::parse(R"({"columns": ["drop_mm", "rebound_mm"],
      "rows": [["500", "180"], ["500", "abc"], ["500", "600"], ["300", "100"]]})"));
  ASSERT_EQ(wrong.at("faults").size(), 3U) << wrong;
  const auto place = [&](std::size_t k) {
    const Json& fault = wrong.at("faults").at(k);
    return Json{fault.at("row"), fault.at("column")};
  };
  EXPECT_EQ(place(0), Json({1, 1}));
  EXPECT_EQ(place(1), Json({3, 0}));  // not the study's height
  EXPECT_EQ(place(2), Json({2, 1}));
  studio_.folder.write("peas/drops.csv",
                       std::string("drop_mm,rebound_mm\n500,180\n500,abc\n500,600\n300,100\n"));
  const auto typed = testing::run_program(testing::program(), studio_.folder,
                                          {"calibrate", "peas.toml", "--dry-run"});
  EXPECT_EQ(typed.exit_code, 2);
  for (const Json& fault : wrong.at("faults")) {
    EXPECT_THAT(typed.err, HasSubstr(fault.at("text").get<std::string>()));
  }
}

TEST_F(StudioStudies, ASheetIsSavedAsItIsTypedWrongOrNot) {
  start_peas();
  Json cells = Json::parse(R"({"columns": ["drop_mm", "rebound_mm"],
      "rows": [["500", "180,5"], ["", ""], ["500", "a,\"b"]]})");
  studio_.put(kDrops, cells, 409);  // without a version
  cells["version"] = experiment("drop").at("sheet").at("version");
  const Json saved = studio_.put(kDrops, cells);
  EXPECT_EQ(saved.at("faults").size(), 1U);
  EXPECT_EQ(studio_.text("peas/drops.csv"),
            "drop_mm,rebound_mm\n500,\"180,5\"\n,\n500,\"a,\"\"b\"\n");
  const Json sheet = experiment("drop").at("sheet");
  EXPECT_EQ(sheet.at("version"), saved.at("version"));
  EXPECT_EQ(sheet.at("rows").at(1), Json({"500", "a,\"b"}));
  // Another page still has the previous version.
  const Json late = studio_.put(kDrops, cells, 409);
  EXPECT_THAT(late.at("error"), HasSubstr("was changed meanwhile"));
}

TEST_F(StudioStudies, WhatIsNoTableIsRefused) {
  start_peas();
  for (const char* cells :
       {"[]", R"({"columns": []})", R"({"columns": ["drop_mm"], "rows": [["1", "2"]]})",
        R"({"columns": ["drop_mm"], "rows": [[1]]})",
        R"({"columns": ["drop_mm"], "rows": [["1\n2"]]})"}) {
    studio_.post(kDrops, Json::parse(cells), 400);
  }
  studio_.post("/api/sheet?study=peas.toml&experiment=roll", Json::object(), 400);
  studio_.post("/api/sheet?study=other.toml&experiment=drop", Json::object(), 400);
}

TEST_F(StudioStudies, TheProtocolIsThatOfTheExperimentAndIsCheckedByIt) {
  start_peas();
  const Json keys = experiment("drop").at("keys");
  EXPECT_EQ(keys.at(0).at("key"), "height_mm");
  EXPECT_THAT(keys.at(0).at("rule"), HasSubstr("a number above 0"));
  const auto numbers = [](const char* height) {
    return Json{{"numbers", {{"experiment.drop", {{"height_mm", height}}}}}};
  };
  constexpr const char* kNumbers = "/api/numbers?study=peas.toml";
  EXPECT_THAT(studio_.post(kNumbers, numbers("250")).at("faults"), IsEmpty());
  for (const char* wrong : {"-5", "high", "1e99"}) {
    const Json faults = studio_.post(kNumbers, numbers(wrong)).at("faults");
    ASSERT_EQ(faults.size(), 1U) << wrong;
    EXPECT_EQ(faults.at(0).at("key"), "experiment.drop.height_mm");
    EXPECT_THAT(texts(faults), Not(HasSubstr("/")));  // no name of a temporary file
  }
  const std::string before = studio_.text("peas.toml");
  Json change = numbers("-5");
  change["version"] = studio_.get("/api/study?study=peas.toml").at("version");
  EXPECT_EQ(studio_.put(kNumbers, change).at("saved"), false);
  EXPECT_EQ(studio_.text("peas.toml"), before);
  change["numbers"] = numbers("250").at("numbers");
  EXPECT_EQ(studio_.put(kNumbers, change).at("saved"), true);
  EXPECT_THAT(studio_.text("peas.toml"), HasSubstr("\nheight_mm = 250\n"));
  studio_.put(kNumbers, change, 409);  // previous version
  studio_.post(kNumbers, Json{{"numbers", {{"particle", {{"density_kg_m3", "1"}}}}}}, 400);
  // The study, the folder of its sheets, and the studio's lock.
  EXPECT_EQ(studio_.folder.names().size(), 3U) << "nothing is left of what was tried";
}

TEST_F(StudioStudies, ABrokenStudyIsShownWithWhatIsWrong) {
  studio_.folder.write("broken.toml", std::string("[particle\nx = 1\n"));
  studio_.folder.write("camera.toml", std::string("width = 1\n"));
  studio_.folder.write("a.jpg.repose.toml", std::string("[particle]\n"));
  studio_.folder.write("table.toml", std::string("[parameter.a]\nmin = 0\nmax = 1\n"));
  const Json studies = studio_.get("/api/studies").at("studies");
  ASSERT_EQ(studies.size(), 2U);
  EXPECT_EQ(studies.at(0).at("study"), "broken.toml");
  EXPECT_THAT(studies.at(0).at("faults").at(0), HasSubstr("broken.toml:1:"));
  EXPECT_EQ(studies.at(1).at("is_table"), true);
  EXPECT_EQ(studio_.get("/api/study?study=broken.toml").at("faults").size(), 1U);
  studio_.post("/api/sheet?study=broken.toml&experiment=drop", Json::object(), 400);
}

TEST_F(StudioStudies, NothingOutsideTheFolderIsShownOrWritten) {
  const testing::TemporaryFolder other;
  other.write("peas.toml", std::string("[study]\n"));
  other.write("drops.csv", std::string("drop_mm,rebound_mm\n500,180\n"));
  start_peas();
  const std::string text = studio_.text("peas.toml");
  const std::string inside = "\"peas/drops.csv\"";
  const auto with_sheet = [&](const std::string& sheet) {
    std::string changed = text;
    changed.replace(changed.rfind(inside), inside.size(), '"' + sheet + '"');
    studio_.folder.write("peas.toml", changed);
  };
  with_sheet((other.path() / "drops.csv").string());
  EXPECT_EQ(experiment("drop").at("sheet"), nullptr);
  std::filesystem::create_symlink(other.path() / "drops.csv", studio_.folder.path() / "link.csv");
  with_sheet("link.csv");
  EXPECT_EQ(experiment("drop").at("sheet"), nullptr);
  studio_.put(kDrops, Json::parse(R"({"columns": ["drop_mm"], "rows": []})"), 400);
  std::filesystem::create_symlink(other.path() / "peas.toml", studio_.folder.path() / "link.toml");
  for (const std::string& name :
       {std::string("link.toml"), "../" + other.path().filename().string() + "/peas.toml",
        (other.path() / "peas.toml").string(), std::string(""), std::string("./peas.toml")}) {
    const std::string encoded = httplib::detail::encode_query_param(name);
    studio_.get("/api/study?study=" + encoded, 400);
    studio_.get("/api/calibration?study=" + encoded, 400);
    EXPECT_EQ(studio_.client->Get("/files/report?study=" + encoded)->status, 400);
  }
  EXPECT_EQ(testing::text_of(other.path() / "drops.csv"), "drop_mm,rebound_mm\n500,180\n");
}

TEST_F(StudioStudies, StrangersAreNotAnswered) {
  start_peas();
  httplib::Client stranger("127.0.0.1", studio_.port);
  for (const char* path : {"/api/studies", "/api/new", "/api/study?study=peas.toml", "/api/tasks",
                           "/api/calibration?study=peas.toml", "/files/report?study=peas.toml",
                           "/files/calibration?study=peas.toml&name=result.json"}) {
    EXPECT_EQ(stranger.Get(path)->status, 403) << path;
    EXPECT_EQ(studio_.client->Get(path, {{"Origin", "http://evil.example"}})->status, 403) << path;
    EXPECT_EQ(studio_.client->Get(path, {{"Host", "evil.example"}})->status, 403) << path;
  }
  const std::string body = kPeas.dump();
  for (const char* path :
       {"/api/new", "/api/studies", kDrops, "/api/numbers?study=peas.toml",
        "/api/tasks?study=peas.toml&task=calibrate", "/api/export?study=peas.toml&to=yade"}) {
    EXPECT_EQ(stranger.Post(path, body, "application/json")->status, 403) << path;
  }
  EXPECT_EQ(stranger.Put(kDrops, body, "application/json")->status, 403);
  EXPECT_EQ(stranger.Put("/api/numbers?study=peas.toml", body, "application/json")->status, 403);
  EXPECT_EQ(stranger.Delete("/api/tasks?study=peas.toml&task=calibrate")->status, 403);
}

TEST_F(StudioStudies, BoundsOfWhatIsSoughtAreChangedInTheStudy) {
  start_peas();
  const Json study = studio_.get("/api/study?study=peas.toml");
  const std::string name = study.at("sought").at(0).at("name");
  EXPECT_EQ(name, "contact.particle_wall.restitution");
  const auto with = [&](const char* key, const char* number) {
    return Json{{"numbers", {{name, {{key, number}}}}}, {"version", study.at("version")}};
  };
  const std::string before = studio_.text("peas.toml");
  // The upper bound below the lower one.
  EXPECT_FALSE(studio_.put("/api/numbers?study=peas.toml", with("max", "0.001")).at("saved"));
  studio_.put("/api/numbers?study=peas.toml", with("step", "1"), 400);
  EXPECT_EQ(studio_.text("peas.toml"), before);
  EXPECT_TRUE(studio_.put("/api/numbers?study=peas.toml", with("max", "0.85")).at("saved"));
  EXPECT_EQ(studio_.get("/api/study?study=peas.toml").at("sought").at(0).at("max"), .85);
}

}  // namespace
}  // namespace repose::studio
