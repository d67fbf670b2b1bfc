#include "tests/layers/include_rules.h"

#include <fstream>
#include <map>
#include <sstream>

#include <gmock/gmock.h>
#include <unistd.h>

#include "tests/support/places.h"

namespace repose::layers {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr const char* kRooms =
    "base: \n"
    "vision/picture: base\n"
    "vision/measure: vision/picture\n"
    "dem: base\n"
    "dem/shape/scan: dem\n"
    "dem/shape/clump: dem/shape/scan\n"
    "render/scene: dem vision/picture\n"
    "calibrate/study: vision dem render\n"
    "cli/common: base calibrate\n";

/// A made-up repository in a folder of its own, gone at the end of the test.
class IncludeRules : public ::testing::Test {
 protected:
  IncludeRules() {
    const ::testing::TestInfo* test = ::testing::UnitTest::GetInstance()->current_test_info();
    root_ = fs::path(::testing::TempDir()) /
            ("repose_" + std::to_string(getpid()) + '_' + test->name());
  }
  void TearDown() override { fs::remove_all(root_); }

  void write(const std::string& name, const std::string& text) {
    fs::create_directories((root_ / name).parent_path());
    std::ofstream(root_ / name) << text;
  }
  std::vector<std::string> errors(const std::set<std::string>& public_headers = {}) {
    return broken_include_rules(root_, rooms_in(kRooms), public_headers);
  }

 private:
  fs::path root_;
};

TEST_F(IncludeRules, AllowedArrowsGiveNoError) {
  write("vision/measure/a.cpp",
        "#include \"vision/measure/a.h\"\n#include <vector>\n#include <opencv2/core.hpp>\n"
        "#include \"vision/picture/a.h\"\n");
  write("dem/a.h", "#include \"base/a.h\"\n");
  write("dem/shape/clump/a.cpp", "#include \"dem/shape/scan/a.h\"\n");
  write("render/scene/a.cpp",
        "#include \"dem/shape/clump/a.h\"\n#include \"vision/picture/a.h\"\n");
  write("calibrate/study/a.cpp",
        "#include \"vision/measure/a.h\"\n#include \"dem/shape/clump/a.h\"\n");
  write("cli/main.cpp", "#include \"calibrate/study/a.h\"\n#include \"cli/common/a.h\"\n");
  write("tests/vision/a_test.cpp", "#include \"vision/a.h\"\n#include \"tests/support/b.h\"\n");
  EXPECT_THAT(errors(), IsEmpty());
}

TEST_F(IncludeRules, AnErrorNamesFileLineIncludeRuleAndFix) {
  write("vision/picture/a.cpp", "// first line\n#include \"vision/measure/a.h\"\n");
  EXPECT_THAT(errors(),
              ElementsAre(AllOf(
                  StartsWith("vision/picture/a.cpp:2: includes vision/measure/a.h. Rule: "),
                  HasSubstr("vision/picture may not use vision/measure"), HasSubstr("Fix: "))));
}

TEST_F(IncludeRules, EveryWrongArrowIsFound) {
  const std::map<std::string, std::vector<std::string>> wrong = {
      {"base", {"vision/picture/a.h", "dem/a.h", "cli/common/a.h"}},
      {"vision/measure", {"base/a.h", "dem/a.h", "cli/common/a.h", "tests/support/a.h"}},
      {"dem/shape/scan", {"vision/picture/a.h", "dem/shape/clump/a.h", "tests/support/a.h"}},
      {"render/scene", {"vision/measure/a.h", "calibrate/study/a.h"}},
      {"calibrate/study", {"base/a.h", "cli/common/a.h", "calibrate/unknown/a.h"}},
      {"cli", {"tests/support/a.h"}},
  };
  std::size_t arrows = 0;
  for (const auto& [room, headers] : wrong) {
    std::ostringstream text;
    for (const std::string& header : headers) text << "#include \"" << header << "\"\n";
    write(room + "/a.cpp", text.str());
    arrows += headers.size();
  }
  EXPECT_EQ(errors().size(), arrows);
}

TEST_F(IncludeRules, AngleBracketsAndBlanksHideNothing) {
  write("dem/a.h", "  #  include <vision/picture/a.h>\n");
  EXPECT_THAT(errors(), ElementsAre(StartsWith("dem/a.h:1: includes vision/picture/a.h")));
}

TEST_F(IncludeRules, QuotedIncludesStartAtTheTop) {
  write("vision/picture/a.cpp", "#include \"a.h\"\n#include \"../dem/a.h\"\n");
  EXPECT_THAT(errors(),
              ElementsAre(HasSubstr("Fix: \"vision/picture/a.h\""), HasSubstr("../dem/a.h")));
}

TEST(Rooms, StandOnEachOtherWithoutCircles) {
  EXPECT_THAT(broken_room_rules(rooms_in(kRooms)), IsEmpty());
  EXPECT_THAT(broken_room_rules(rooms_in("dem/a: dem/b\ndem/b: dem/c\ndem/c: dem/a\n")),
              ElementsAre(StartsWith("dem/a:"), StartsWith("dem/b:"), StartsWith("dem/c:")));
}

TEST(Rooms, UseModulesBelowTheirOwn) {
  EXPECT_THAT(broken_room_rules(rooms_in("dem/a: vision\nvision/b: dem/c\nbase: cli/a\n")),
              ElementsAre(StartsWith("base: uses cli/a"), StartsWith("dem/a: uses vision"),
                          StartsWith("vision/b: uses dem/c")));
}

TEST_F(IncludeRules, TheWholeOfOpenCvIsNeverIncluded) {
  write("vision/a.cpp", "#include <opencv2/opencv.hpp>\n");
  EXPECT_THAT(errors(), ElementsAre(HasSubstr("name the parts of OpenCV")));
}

TEST_F(IncludeRules, PublicHeadersShowNoHiddenLibraryAndNoPrivateHeader) {
  const std::string text =
      "#include <opencv2/core.hpp>\n#include <ceres/ceres.h>\n"
      "#include \"vision/picture/private.h\"\n#include \"vision/picture/public.h\"\n";
  write("vision/picture/public.h", text);
  write("vision/picture/private.h", text);
  EXPECT_THAT(
      errors({"vision/picture/public.h"}),
      ElementsAre(StartsWith("vision/picture/public.h:1: includes opencv2/core.hpp"),
                  StartsWith("vision/picture/public.h:2: includes ceres/ceres.h"),
                  StartsWith("vision/picture/public.h:3: includes vision/picture/private.h")));
}

class Repository : public ::testing::Test {
 protected:
  fs::path root_ = testing::source_folder();
  Rooms rooms_ = rooms_in(text_of(testing::rooms_file()));

 private:
  static std::string text_of(const fs::path& file) {
    std::ostringstream text;  // not byte by byte: tests are not optimised
    text << std::ifstream(file).rdbuf();
    return std::move(text).str();
  }
};

TEST_F(Repository, KeepsTheRulesOfRooms) {
  ASSERT_THAT(rooms_, ::testing::Contains(::testing::Key("vision/measure")));
  EXPECT_THAT(broken_room_rules(rooms_), IsEmpty());
}

TEST_F(Repository, KeepsTheIncludeRules) {
  std::set<std::string> public_headers;
  std::istringstream list(REPOSE_PUBLIC_HEADERS);
  for (std::string file; std::getline(list, file, '|');) {
    public_headers.insert(fs::path(file).lexically_normal().lexically_relative(root_));
  }
  ASSERT_THAT(public_headers, ::testing::Contains("vision/measure/repose_angle.h"));
  ASSERT_THAT(public_headers, ::testing::Contains("facade/calibrate.h"));
  EXPECT_THAT(broken_include_rules(root_, rooms_, public_headers), IsEmpty());
}

}  // namespace
}  // namespace repose::layers
