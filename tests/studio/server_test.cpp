// The studio over HTTP, as a browser uses it.
#include "studio/server.h"

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <sys/resource.h>

#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/compared/compared_json.h"
#include "calibrate/compared/compared_sets.h"
#include "studio/http.h"
#include "tests/support/heap_picture.h"
#include "tests/support/hollow_conditions.h"
#include "tests/support/temporary_folder.h"
#include "vision/hints/hint_file.h"
#include "vision/hints/painted_mask.h"
#include "vision/picture/picture.h"

namespace repose::studio {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// Simulates a full disk: while it exists, no file of this process grows beyond a few bytes.
class FullDisk {
 public:
  FullDisk() : earlier_handler_(::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &earlier_);
    rlimit small = earlier_;
    constexpr rlim_t kRoom_bytes = 16;
    small.rlim_cur = kRoom_bytes;
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &earlier_);
    ::signal(SIGXFSZ, earlier_handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;
  FullDisk(FullDisk&&) = delete;
  FullDisk& operator=(FullDisk&&) = delete;

 private:
  rlimit earlier_ = {};
  sighandler_t earlier_handler_;
};

/// A studio on a folder with a heap in it, and its page.
class StudioServer : public ::testing::Test {
 protected:
  StudioServer() {
    vision::write_picture(folder_.path() / "heap a.png", heap().picture);
    server_ = std::make_unique<Server>(StudioOptions{.folder = folder_.path()});
    thread_ = std::thread([this] { server_->run(); });
    const std::string address = server_->address();
    const std::size_t token = address.find("token=");
    port_ = std::stoi(address.substr(std::string("http://127.0.0.1:").size()));
    token_ = address.substr(token + std::string("token=").size());
    client_ = std::make_unique<httplib::Client>("127.0.0.1", port_);
    client_->set_read_timeout(120);
    client_->set_default_headers({{"Cookie", "repose_" + std::to_string(port_) + "=" + token_}});
  }
  ~StudioServer() override {
    server_->stop();
    thread_.join();
  }
  StudioServer(const StudioServer&) = delete;
  StudioServer& operator=(const StudioServer&) = delete;
  StudioServer(StudioServer&&) = delete;
  StudioServer& operator=(StudioServer&&) = delete;

  static const testing::DrawnHeap& heap() {
    static const testing::DrawnHeap drawn = testing::draw_heap(testing::hollow_power(2));
    return drawn;
  }

  Json get(const std::string& path, int status = 200) {
    const auto answer = client_->Get(path);
    EXPECT_TRUE(answer) << path;
    EXPECT_EQ(answer->status, status) << answer->body;
    return Json::parse(answer->body);
  }

  /// Of the heap, as a parameter.
  std::string version() {
    const Json listed = get("/api/folder").at("files").at(0).at("version");
    return "&version=" + httplib::detail::encode_query_param(listed.get<std::string>());
  }

  testing::TemporaryFolder folder_;
  std::unique_ptr<Server> server_;
  std::thread thread_;
  int port_ = 0;
  std::string token_;
  std::unique_ptr<httplib::Client> client_;
};

TEST_F(StudioServer, ShowsTheFolderAndMeasuresWhatIsInIt) {
  const Json folder = get("/api/folder");
  ASSERT_EQ(folder.at("files").size(), 1U);
  EXPECT_EQ(folder.at("files").at(0).at("file"), "heap a.png");
  EXPECT_EQ(folder.at("files").at(0).at("kind"), "picture");
  EXPECT_GE(folder.at("definitions").size(), 5U);

  const Json answer = get("/api/measured?file=heap%20a.png");
  const Json& measured = answer.at("measured");
  EXPECT_NE(measured.at("status"), "refused");
  EXPECT_NEAR(measured.at("angle_deg"), *heap().mean_rad() * 57.29578, 3);
  EXPECT_EQ(answer.at("marks").at("width"), heap().picture.width);
  EXPECT_GT(answer.at("marks").at("outline").size(), 100U);
  EXPECT_THAT(answer.at("command"), HasSubstr("'"));  // the name contains a space
  EXPECT_EQ(get("/api/measured?file=heap%20a.png"), answer);
}

TEST_F(StudioServer, MeasuresAgainByWhatIsToldAndSavesItWhenAsked) {
  Json told = get("/api/measured?file=heap%20a.png").at("told");
  const vision::Segment ground = heap().ground;
  told["ground"] = {ground.from.x, ground.from.y - 4, ground.to.x, ground.to.y - 4};
  told["keep"] = {{heap().picture.width / 2, ground.from.y - 20}};
  const auto again =
      client_->Post("/api/measure?file=heap%20a.png", told.dump(), "application/json");
  ASSERT_EQ(again->status, 200) << again->body;
  const Json answer = Json::parse(again->body);
  EXPECT_EQ(answer.at("told").at("ground"), told.at("ground"));
  EXPECT_THAT(answer.at("command"), HasSubstr("--ground"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "heap a.png.repose.toml"));

  const auto saved =
      client_->Put("/api/hints?file=heap%20a.png" + version(), told.dump(), "application/json");
  ASSERT_EQ(saved->status, 200) << saved->body;
  const vision::PictureSettings kept = vision::with_saved_hints({}, folder_.path() / "heap a.png");
  EXPECT_NEAR(kept.measuring.hints.ground->from.y, ground.from.y - 4, .01);
  EXPECT_EQ(get("/api/measured?file=heap%20a.png").at("measured").at("angle_deg"),
            answer.at("measured").at("angle_deg"));
  EXPECT_EQ(get("/api/folder").at("files").at(0).at("has_hints"), true);

  EXPECT_EQ(client_->Delete("/api/hints?file=heap%20a.png" + version())->status, 200);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "heap a.png.repose.toml"));
  EXPECT_EQ(get("/api/measured?file=heap%20a.png").at("told").at("ground"), nullptr);
}

TEST_F(StudioServer, WhatAnotherWindowHasSavedIsNotWrittenOver) {
  const std::string began = version();
  Json told = get("/api/measured?file=heap%20a.png").at("told");
  told["exclude"] = {{1, 1, 20, 20}};
  const auto save = [&](const std::string& with_version) {
    return client_->Put("/api/hints?file=heap%20a.png" + with_version, told.dump(),
                        "application/json");
  };
  ASSERT_EQ(save(began)->status, 200);
  told["exclude"] = {{5, 5, 20, 20}};
  for (const std::string& stale : {began, std::string()}) {
    const auto second = save(stale);
    EXPECT_EQ(second->status, 409);
    EXPECT_THAT(second->body, HasSubstr("another window"));
    EXPECT_EQ(client_->Delete("/api/hints?file=heap%20a.png" + stale)->status, 409);
  }
  const auto kept = vision::with_saved_hints({}, folder_.path() / "heap a.png").measuring.excluded;
  ASSERT_EQ(kept.size(), 1U);
  EXPECT_EQ(kept.front().x, 1);
  EXPECT_EQ(save(version())->status, 200);
}

TEST_F(StudioServer, WhatIsPaintedBecomesAMaskThatTheCommandLineReads) {
  const std::filesystem::path picture = folder_.path() / "heap a.png";
  Json told = get("/api/measured?file=heap%20a.png").at("told");
  EXPECT_EQ(told.at("has_mask"), false);
  const vision::Segment ground = heap().ground;
  const double middle = (ground.from.x + ground.to.x) / 2, width = 21;
  told["painted"] = {
      {{"says", "heap"},
       {"width", width},
       {"path", {{middle - 30, ground.from.y - 20}, {middle + 30, ground.from.y - 20}}}},
      {{"says", "no_heap"}, {"width", width}, {"path", {{12, 12}}}},
      {{"says", "nothing"}, {"width", 5}, {"path", {{middle, ground.from.y - 20}}}}};
  const auto again =
      client_->Post("/api/measure?file=heap%20a.png", told.dump(), "application/json");
  ASSERT_EQ(again->status, 200) << again->body;
  EXPECT_THAT(again->body, HasSubstr("--mask"));
  EXPECT_FALSE(std::filesystem::exists(vision::mask_file_of(picture)));
  ASSERT_EQ(
      client_->Put("/api/hints?file=heap%20a.png" + version(), told.dump(), "application/json")
          ->status,
      200);
  const vision::Hints hints = vision::with_saved_hints({}, picture).measuring.hints;
  EXPECT_EQ(hints.mask_file, vision::mask_file_of(picture));
  ASSERT_EQ(hints.mask.width, heap().picture.width);
  const auto level = [&](double x, double y) {
    const auto at = static_cast<std::size_t>(y) * hints.mask.width + static_cast<std::size_t>(x);
    return int{hints.mask.bgr[3 * at]};
  };
  EXPECT_EQ(level(middle - 25, ground.from.y - 20), 255);
  EXPECT_EQ(level(12, 12), 0);
  EXPECT_EQ(level(middle, ground.from.y - 20), 128);
  EXPECT_EQ(level(12, 60), 128);
  // The mask is not listed as a heap, and is deleted with the other saved data.
  EXPECT_EQ(get("/api/folder").at("files").size(), 1U);
  const Json saved = get("/api/measured?file=heap%20a.png");
  EXPECT_EQ(saved.at("told").at("has_mask"), true);
  EXPECT_EQ(Json::parse(again->body).at("measured").at("angle_deg"),
            saved.at("measured").at("angle_deg"));
  EXPECT_EQ(client_->Get("/api/mask?file=heap%20a.png")->get_header_value("Content-Type"),
            "image/png");
  EXPECT_EQ(client_->Delete("/api/hints?file=heap%20a.png" + version())->status, 200);
  EXPECT_FALSE(std::filesystem::exists(vision::mask_file_of(picture)));
  EXPECT_EQ(client_->Get("/api/mask?file=heap%20a.png")->status, 400);
}

TEST_F(StudioServer, AMaskTurnsWithItsPicture) {
  const std::filesystem::path picture = folder_.path() / "heap a.png";
  Json told = get("/api/measured?file=heap%20a.png").at("told");
  told["rotate_deg"] = 90;
  told["painted"] = {{{"says", "no_heap"}, {"width", 9}, {"path", {{10, 30}}}}};
  ASSERT_EQ(
      client_->Put("/api/hints?file=heap%20a.png" + version(), told.dump(), "application/json")
          ->status,
      200);
  // Rotated clockwise by 90 degrees, (10, 30) comes from 30 to the right and 10 from below.
  const vision::Picture mask = vision::read_picture(vision::mask_file_of(picture));
  ASSERT_EQ(mask.width, heap().picture.width);
  const auto at = static_cast<std::size_t>(mask.height - 11) * mask.width + 30;
  EXPECT_EQ(mask.bgr[3 * at], 0);
  const vision::Picture turned = vision::with_saved_hints({}, picture).measuring.hints.mask;
  EXPECT_EQ(turned.bgr[3 * (std::size_t{30} * turned.width + 10)], 0);
}

TEST_F(StudioServer, AFullDiskLeavesAllAsItWasAndIsSaid) {
  const std::string bytes = testing::text_of(folder_.path() / "heap a.png");
  Json told = get("/api/measured?file=heap%20a.png").at("told");
  const std::string began = version();
  const auto before = folder_.names();
  {
    const FullDisk full;
    const auto added = client_->Post("/api/file?file=b.png", bytes, "image/png");
    EXPECT_EQ(added->status, 400);
    EXPECT_THAT(added->body,
                AllOf(HasSubstr("b.png"), HasSubstr("cannot be written"), HasSubstr("Fix: ")));
    told["exclude"] = {{1, 1, 20, 20}};
    const auto saved =
        client_->Put("/api/hints?file=heap%20a.png" + began, told.dump(), "application/json");
    EXPECT_EQ(saved->status, 400);
    EXPECT_THAT(saved->body, HasSubstr("cannot be written"));
  }
  EXPECT_THAT(folder_.names(), ::testing::UnorderedElementsAreArray(before));
  EXPECT_EQ(client_->Post("/api/file?file=b.png", bytes, "image/png")->status, 200);
}

TEST_F(StudioServer, OfAThousandPicturesEachAnswersWhileTheOthersAreMeasured) {
  constexpr int kPictures = 1000;
  vision::Picture picture = vision::reduced(heap().picture, 400);
  for (int k = 0; k < kPictures; ++k) {
    picture.bgr[0] = static_cast<std::uint8_t>(k);
    picture.bgr[1] = static_cast<std::uint8_t>(k / 256);
    vision::write_picture(folder_.path() / fmt::format("b_{:04}.png", k), picture);
  }
  // Ten times what each takes on an idle machine: a list that is reread for each of its files, or a
  // wait for all of them, takes longer.
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  EXPECT_EQ(get("/api/folder").at("files").size(), kPictures + 1U);
  EXPECT_LT(Clock::now() - start, std::chrono::seconds(2));
  std::thread others([&] {
    httplib::Client other("127.0.0.1", port_);
    other.set_read_timeout(120);
    for (int k = 0; k < 10; ++k) {
      other.Get(fmt::format("/api/measured?file=b_{:04}.png&token={}", k, token_));
    }
  });
  const auto asked = Clock::now();
  EXPECT_EQ(get("/api/measured?file=b_0999.png").at("measured").at("file"),
            (folder_.path() / "b_0999.png").string());
  EXPECT_LT(Clock::now() - asked, std::chrono::seconds(20));
  others.join();
}

TEST_F(StudioServer, WhatCannotBeMeantIsRefusedAndNothingIsSaved) {
  for (const char* told : {"", "[", "[]", R"({"heap": "all"})", R"({"heap": [-5, 0, 9999, 9]})"}) {
    const auto saved =
        client_->Put("/api/hints?file=heap%20a.png" + version(), told, "application/json");
    EXPECT_TRUE(saved->status == 400 ||
                Json::parse(saved->body).at("measured").at("status") == "refused")
        << told;
  }
  get("/api/measured?file=nowhere.png", 400);
  get("/api/measured", 400);
}

TEST_F(StudioServer, NoNameLeadsOutOfTheFolder) {
  const testing::TemporaryFolder other;
  vision::write_picture(other.path() / "secret.png", heap().picture);
  std::ofstream(folder_.path() / "notes.txt") << "private";
  const std::string up = "../" + other.path().filename().string() + "/secret.png";
  for (const std::string& name :
       {up, (other.path() / "secret.png").string(), std::string("./heap a.png"),
        std::string("notes.txt"), std::string("/etc/passwd"), std::string("..")}) {
    const auto encoded = httplib::detail::encode_query_param(name);
    EXPECT_EQ(client_->Get("/api/measured?file=" + encoded)->status, 400) << name;
    EXPECT_EQ(client_->Get("/api/picture?file=" + encoded)->status, 400) << name;
    EXPECT_EQ(client_->Delete("/api/hints?file=" + encoded)->status, 400) << name;
    EXPECT_EQ(client_->Post("/api/file?file=" + encoded, "x", "image/png")->status, 400) << name;
  }
  EXPECT_EQ(client_->Get("/../../etc/passwd")->status, 404);
}

TEST_F(StudioServer, AFileThatIsAddedReplacesNone) {
  const std::string bytes = testing::text_of(folder_.path() / "heap a.png");
  const auto add = [&](const std::string& name, const std::string& content) {
    const auto answer = client_->Post("/api/file?file=" + httplib::detail::encode_query_param(name),
                                      content, "image/png");
    return Json::parse(answer->body);
  };
  EXPECT_EQ(add("heap a.png", bytes).at("file"), "heap a-2.png");
  EXPECT_EQ(add("heap a.png", bytes).at("file"), "heap a-3.png");
  EXPECT_EQ(get("/api/set").at("copies"), 2);
  EXPECT_EQ(add("broken.png", "no picture").at("file"), "broken.png");
  const Json broken = get("/api/measured?file=broken.png").at("measured");
  EXPECT_EQ(broken.at("status"), "refused");
  EXPECT_THAT(broken.at("reason"), HasSubstr("broken.png"));
  EXPECT_THAT(add("heap.exe", "x").at("error"), HasSubstr("JPEG"));
  EXPECT_THAT(add(".hidden.png", "x").at("error"), HasSubstr(".hidden.png"));
}

TEST_F(StudioServer, PicturesAreJpegsNoLargerThanAskedFor) {
  const auto small = client_->Get("/api/picture?file=heap%20a.png&side=100");
  ASSERT_EQ(small->status, 200);
  EXPECT_EQ(small->get_header_value("Content-Type"), "image/jpeg");
  const auto file = folder_.write("small.jpg", small->body);
  EXPECT_EQ(vision::read_picture(file).width, 100);
  const auto turned = client_->Get("/api/picture?file=heap%20a.png&side=100&turns=1");
  EXPECT_EQ(vision::read_picture(folder_.write("turned.jpg", turned->body)).height, 100);
  for (const char* wrong : {"side=0", "side=1e9", "side=99999999999", "side=x", "turns=4"}) {
    EXPECT_EQ(client_->Get(std::string("/api/picture?file=heap%20a.png&") + wrong)->status, 400)
        << wrong;
  }
  EXPECT_GT(client_->Get("/api/overlay?file=heap%20a.png")->body.size(), 10000U);
}

TEST_F(StudioServer, TheSetIsWhatTheCommandLineSays) {
  EXPECT_EQ(get("/api/set").at("pictures"), 1);
  const auto table = client_->Get("/files/angles.csv");
  EXPECT_THAT(table->body, StartsWith("file,status,angle_deg"));
  EXPECT_THAT(table->body, HasSubstr("heap a.png"));
  EXPECT_THAT(client_->Get("/files/photos.html")->body, HasSubstr("heap a.png"));
}

TEST_F(StudioServer, SetsAreComparedAsTheLibraryComparesThem) {
  const std::filesystem::path dense = folder_.path() / "dense";
  std::filesystem::create_directory(dense);
  std::filesystem::create_directory(folder_.path() / "empty");
  for (const int power : {1, 3}) {
    vision::write_picture(dense / fmt::format("{}.png", power),
                          testing::draw_heap(testing::hollow_power(power)).picture);
  }
  const Json sets = get("/api/sets");
  ASSERT_EQ(sets.at("folders").size(), 1U);
  EXPECT_EQ(sets.at("folders").at(0),
            Json({{"folder", "dense"}, {"kind", "pictures"}, {"heaps", 2}}));
  const auto compare = [&](const Json& first, const Json& second) {
    const Json asked{{"first", first}, {"second", second}, {"margin_deg", 3}};
    return client_->Post("/api/comparison", asked.dump(), "application/json");
  };
  const auto answered = compare({{"files", {"heap a.png"}}}, {{"folder", "dense"}});
  ASSERT_EQ(answered->status, 200) << answered->body;
  const Json answer = Json::parse(answered->body);
  calibrate::SetsPlan plan;
  plan.sources[0] = {.name = "first", .files = {folder_.path() / "heap a.png"}, .is_file = false};
  plan.sources[1] = {
      .name = dense.string(), .files = {dense / "1.png", dense / "3.png"}, .is_file = false};
  plan.comparing.margin_rad = 3 * kDegree;
  const calibrate::ComparedSets compared = calibrate::compare_sets_of(plan, {});
  EXPECT_EQ(answer.at("comparison"), Json::parse(calibrate::sets_json(compared)));
  EXPECT_THAT(answer.at("command"), HasSubstr("--margin-deg 3"));
  const std::string number = "number=" + answer.at("number").dump();
  const auto png = vision::png_of(calibrate::figure_of(compared, 2100));
  EXPECT_EQ(client_->Get("/files/comparison.png?width=2100&" + number)->body,
            std::string(png.begin(), png.end()));
  for (const Json& wrong : {Json(), Json({{"files", Json::array()}}), Json({{"files", {"no.png"}}}),
                            Json({{"folder", ".."}}), Json({{"folder", "empty"}})}) {
    EXPECT_EQ(compare(wrong, {{"folder", "dense"}})->status, 400) << wrong;
  }
  EXPECT_EQ(client_->Get("/files/comparison.png?number=99")->status, 400);
}

TEST_F(StudioServer, StrangersAreNotAnswered) {
  httplib::Client stranger("127.0.0.1", port_);
  for (const char* path : {"/", "/studio.js", "/api/folder", "/api/picture?file=heap%20a.png"}) {
    EXPECT_EQ(stranger.Get(path)->status, 403) << path;
    EXPECT_EQ(stranger.Get(path, {{"Host", "evil.example"}})->status, 403) << path;
  }
  EXPECT_EQ(client_->Get("/api/folder", {{"Origin", "http://evil.example"}})->status, 403);
  EXPECT_EQ(
      client_->Get("/api/folder", {{"Host", "evil.example:" + std::to_string(port_)}})->status,
      403);
  const auto page = stranger.Get("/?token=" + token_);
  EXPECT_EQ(page->status, 200);
  EXPECT_THAT(page->get_header_value("Set-Cookie"), HasSubstr("SameSite=Strict"));
  EXPECT_THAT(page->get_header_value("Content-Security-Policy"), HasSubstr("default-src 'none'"));
  EXPECT_THAT(page->get_header_value("Access-Control-Allow-Origin"), ::testing::IsEmpty());
}

TEST_F(StudioServer, TooLargeAFileIsRefused) {
  const std::string large(std::size_t{200} << 20, 'x');
  const auto answer = client_->Post("/api/file?file=large.png", large, "image/png");
  // It may hang up before everything was sent.
  if (answer) {
    EXPECT_EQ(answer->status, 413);
  }
  EXPECT_THAT(folder_.names(), Not(Contains("large.png")));
}

TEST(Studio, SaysWhatIsWrongBeforeItStarts) {
  EXPECT_THROW(Server({.folder = "/nowhere/at all"}), base::InputError);
  const testing::TemporaryFolder folder;
  Server first({.folder = folder.path()});
  const int port = std::stoi(first.address().substr(std::string("http://127.0.0.1:").size()));
  EXPECT_THROW(Server({.folder = folder.path(), .port = port}), base::InputError);
}

/// As by Ctrl-C at once after the address is printed.
TEST(Studio, StopsAlsoWhereItDoesNotListenYet) {
  const testing::TemporaryFolder folder;
  constexpr int kTries = 30;
  for (int k = 0; k < kTries; ++k) {
    Server server({.folder = folder.path()});
    std::thread serving([&] { server.run(); });
    server.stop();
    serving.join();
  }
  Server never({.folder = folder.path()});
  never.stop();
  never.run();
}

}  // namespace
}  // namespace repose::studio
