#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/run_program.h"

namespace repose::testing {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::vector<std::string> kNut = {"shape", "--size-mm", "22.48,18.23,17.46", "--tip", ".5"};

std::vector<std::string> with(std::vector<std::string> words,
                              const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(ShapeCommand, CalliperSizesGiveAClumpWithTheContractsKeys) {
  const TemporaryFolder folder;
  const Finished run =
      run_repose(folder, with(kNut, {"--spheres", "4", "--density-kg-m3", "851", "--json", "-"}));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const json shape = json::parse(run.out);
  ASSERT_EQ(shape["spheres"].size(), 4U);
  for (const char* key : {"x_mm", "y_mm", "z_mm", "r_mm"}) {
    EXPECT_TRUE(shape["spheres"][0][key].is_number()) << key;
  }
  for (const char* key : {"volume_error", "inertia_error", "surface_error_mean_mm",
                          "surface_error_p95_mm", "mass_g"}) {
    EXPECT_TRUE(shape[key].is_number()) << key;
  }
  EXPECT_TRUE(shape["repairs"].is_array());
  EXPECT_NEAR(shape["mass_g"].get<double>(), 3.0, .2);
}

TEST(ShapeCommand, AMassNeedsADensity) {
  const TemporaryFolder folder;
  const Finished run = run_repose(folder, with(kNut, {"--spheres", "1", "--json", "-"}));
  EXPECT_TRUE(json::parse(run.out)["mass_g"].is_null());
}

TEST(ShapeCommand, WritesTheClumpAndAMeshToLookAt) {
  const TemporaryFolder folder;
  const Finished run =
      run_repose(folder, with(kNut, {"--spheres", "3", "--out", "nut.json", "--mesh", "nut.glb"}));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("sphere"));
  EXPECT_TRUE(json::accept(text_of(folder.path() / "nut.json")));
  EXPECT_EQ(text_of(folder.path() / "nut.glb").substr(0, 4), "glTF");
}

TEST(ShapeCommand, AllErrorsAreNamedAtOnce) {
  const TemporaryFolder folder;
  const Finished run = run_repose(
      folder, {"shape", "--size-mm", "22,18", "--spheres", "0", "--density-kg-m3", "-3"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_THAT(run.err,
              AllOf(HasSubstr("--size-mm"), HasSubstr("--spheres"), HasSubstr("--density-kg-m3")));
  EXPECT_THAT(run.out, IsEmpty());
}

TEST(ShapeCommand, AFileThatIsNoMeshIsRefused) {
  const TemporaryFolder folder;
  folder.write("notes.stl", std::string("a nut, about two centimetres"));
  for (const char* name : {"notes.stl", "missing.stl"}) {
    const Finished run = run_repose(folder, {"shape", name});
    EXPECT_EQ(run.exit_code, 2) << name;
    EXPECT_THAT(run.err, AllOf(HasSubstr(name), HasSubstr("Fix: ")));
  }
}

}  // namespace
}  // namespace repose::testing
