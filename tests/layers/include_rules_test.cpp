#include "tests/layers/include_rules.h"

#include <fstream>
#include <map>
#include <sstream>

#include <gmock/gmock.h>
#include <unistd.h>

namespace repose::layers {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

/// A made-up repository in a folder of its own, gone at the end of the test.
class IncludeRules : public testing::Test {
 protected:
  IncludeRules() {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    root_ =
        fs::path(testing::TempDir()) / ("repose_" + std::to_string(getpid()) + '_' + test->name());
  }
  ~IncludeRules() override { fs::remove_all(root_); }

  void write(const std::string& name, const std::string& text) {
    fs::create_directories((root_ / name).parent_path());
    std::ofstream(root_ / name) << text;
  }
  std::vector<std::string> faults(const std::set<std::string>& public_headers = {}) {
    return broken_include_rules(root_, public_headers);
  }

 private:
  fs::path root_;
};

TEST_F(IncludeRules, AllowedArrowsGiveNoFault) {
  write("vision/a.cpp",
        "#include \"vision/a.h\"\n#include <vector>\n#include <opencv2/core.hpp>\n");
  write("dem/a.cpp", "#include \"dem/a.h\"\n#include \"io/a.h\"\n");
  write("render/a.cpp", "#include \"dem/state.h\"\n#include \"vision/picture.h\"\n");
  write("calibrate/a.cpp",
        "#include \"vision/a.h\"\n#include \"dem/a.h\"\n#include \"render/a.h\"\n");
  write("cli/main.cpp", "#include \"calibrate/a.h\"\n#include \"cli/a.h\"\n");
  write("tests/vision/a_test.cpp", "#include \"vision/a.h\"\n#include \"tests/support/b.h\"\n");
  EXPECT_THAT(faults(), IsEmpty());
}

TEST_F(IncludeRules, AFaultNamesFileLineIncludeRuleAndFix) {
  write("vision/a.cpp", "// first line\n#include \"dem/state.h\"\n");
  EXPECT_THAT(faults(),
              ElementsAre(AllOf(StartsWith("vision/a.cpp:2: includes dem/state.h. Rule: "),
                                HasSubstr("vision may use io"), HasSubstr("Fix: "))));
}

TEST_F(IncludeRules, EveryWrongArrowIsFound) {
  const std::map<std::string, std::vector<std::string>> wrong = {
      {"io", {"vision/a.h", "dem/a.h", "render/a.h", "calibrate/a.h", "cli/a.h"}},
      {"vision", {"dem/a.h", "render/a.h", "calibrate/a.h", "cli/a.h", "tests/support/a.h"}},
      {"dem", {"vision/a.h", "render/a.h", "calibrate/a.h", "cli/a.h", "tests/support/a.h"}},
      {"render", {"vision/repose_angle.h", "calibrate/a.h", "cli/a.h", "tests/support/a.h"}},
      {"calibrate", {"cli/a.h", "tests/support/a.h"}},
      {"cli", {"tests/support/a.h"}},
  };
  std::size_t arrows = 0;
  for (const auto& [module, headers] : wrong) {
    std::ostringstream text;
    for (const std::string& header : headers) text << "#include \"" << header << "\"\n";
    write(module + "/inner/a.cpp", text.str());
    arrows += headers.size();
  }
  EXPECT_EQ(faults().size(), arrows);
}

TEST_F(IncludeRules, AngleBracketsAndBlanksHideNothing) {
  write("dem/a.h", "  #  include <vision/a.h>\n");
  EXPECT_THAT(faults(), ElementsAre(StartsWith("dem/a.h:1: includes vision/a.h")));
}

TEST_F(IncludeRules, QuotedIncludesStartAtTheTop) {
  write("vision/a.cpp", "#include \"a.h\"\n#include \"../dem/a.h\"\n");
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("Fix: \"vision/a.h\""), HasSubstr("../dem/a.h")));
}

TEST_F(IncludeRules, TheWholeOfOpenCvIsNeverIncluded) {
  write("vision/a.cpp", "#include <opencv2/opencv.hpp>\n");
  EXPECT_THAT(faults(), ElementsAre(HasSubstr("name the parts of OpenCV")));
}

TEST_F(IncludeRules, PublicHeadersShowNoHiddenLibraryAndNoPrivateHeader) {
  const std::string text =
      "#include <opencv2/core.hpp>\n#include <ceres/ceres.h>\n"
      "#include \"vision/private.h\"\n#include \"vision/public.h\"\n";
  write("vision/public.h", text);
  write("vision/private.h", text);
  EXPECT_THAT(faults({"vision/public.h"}),
              ElementsAre(StartsWith("vision/public.h:1: includes opencv2/core.hpp"),
                          StartsWith("vision/public.h:2: includes ceres/ceres.h"),
                          StartsWith("vision/public.h:3: includes vision/private.h")));
}

TEST(Repository, KeepsTheIncludeRules) {
  const fs::path root = REPOSE_SOURCE_FOLDER;
  std::set<std::string> public_headers;
  std::istringstream list(REPOSE_PUBLIC_HEADERS);
  for (std::string file; std::getline(list, file, '|');) {
    public_headers.insert((root / "vision" / file).lexically_normal().lexically_relative(root));
  }
  ASSERT_THAT(public_headers, testing::Contains("vision/repose_angle.h"));
  EXPECT_THAT(broken_include_rules(root, public_headers), IsEmpty());
}

}  // namespace
}  // namespace repose::layers
