#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "tests/cli/command_test.h"

namespace repose::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const Words kNut = {"--size-mm", "22.48,18.23,17.46", "--tip", ".5"};

struct ShapeCommand : CommandTest {
  ShapeCommand() : CommandTest({"shape"}) {}
};

TEST_F(ShapeCommand, CalliperSizesGiveAClumpWithTheContractsKeys) {
  const Finished done =
      run(with(kNut, {"--spheres", "4", "--density-kg-m3", "851", "--json", "-"}));
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const json shape = json::parse(done.out);
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

TEST_F(ShapeCommand, SpheresThatMissTheShapeAreWarnedOf) {
  const Words stick = {"--size-mm", "20,6,6", "--json", "-", "--spheres"};
  const Finished one = run(with(stick, {"1"}));
  EXPECT_EQ(one.exit_code, 0);
  EXPECT_THAT(one.err,
              AllOf(HasSubstr("1 sphere is not its shape"), HasSubstr("Fix: more spheres")));
  const json warnings = json::parse(one.out)["warnings"];
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0]["code"], "shape");
  const Finished many = run(with(stick, {"11"}));
  EXPECT_THAT(many.err, IsEmpty());
  EXPECT_TRUE(json::parse(many.out)["warnings"].empty());
}

TEST_F(ShapeCommand, AMassNeedsADensity) {
  const Finished done = run(with(kNut, {"--spheres", "1", "--json", "-"}));
  EXPECT_TRUE(json::parse(done.out)["mass_g"].is_null());
}

TEST_F(ShapeCommand, WritesTheClumpAndAMeshToLookAt) {
  const Finished done =
      run(with(kNut, {"--spheres", "3", "--out", "nut.json", "--mesh", "nut.glb"}));
  ASSERT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("sphere"));
  EXPECT_TRUE(json::accept(text("nut.json")));
  EXPECT_EQ(text("nut.glb").substr(0, 4), "glTF");
}

TEST_F(ShapeCommand, AllErrorsAreNamedAtOnce) {
  const Finished done = run({"--size-mm", "22,18", "--spheres", "0", "--density-kg-m3", "-3"});
  EXPECT_EQ(done.exit_code, 2);
  EXPECT_THAT(done.err,
              AllOf(HasSubstr("--size-mm"), HasSubstr("--spheres"), HasSubstr("--density-kg-m3")));
  EXPECT_THAT(done.out, IsEmpty());
}

TEST_F(ShapeCommand, AFileThatIsNoMeshIsRefused) {
  folder_.write("notes.stl", std::string("a nut, about two centimetres"));
  for (const char* name : {"notes.stl", "missing.stl"}) {
    const Finished done = run({name});
    EXPECT_EQ(done.exit_code, 2) << name;
    EXPECT_THAT(done.err, AllOf(HasSubstr(name), HasSubstr("Fix: ")));
  }
}

}  // namespace
}  // namespace repose::testing
