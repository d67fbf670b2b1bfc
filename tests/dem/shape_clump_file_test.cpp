#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "dem/shape/clump/clump_errors.h"
#include "dem/shape/clump/clump_file.h"
#include "dem/shape/clump/shape_export.h"
#include "dem/shape/scan/scan.h"
#include "tests/dem/shapes.h"
#include "tests/support/temporary_folder.h"

namespace repose::testing {
namespace {

using dem::ClumpFile;
using dem::ShapeFormat;
using dem::Vector;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// Numbers that survive only if written to the last bit.
ClumpFile small_clump() {
  ClumpFile clump;
  clump.source = "nut \"a\".stl";
  clump.repairs = {"holes filled: 1"};
  clump.shape.spheres = {
      {{0.1, -1.0 / 3, 1e-300}, 0.1 + 0.2}, {{-0.0, 5e-324, 2.0 / 3}, M_PI}, {{2e22, 0, 0}, 3e22}};
  clump.shape.volume_m3 = 1.0 / 7;
  clump.shape.gyration_m2 = {1.0 / 3, 0.4, 0.6};
  clump.shape.surface = corner_tetrahedron(0.1, 0.7, 1.0 / 9);
  clump.errors.volume_error = 0.01234567890123456;
  clump.errors.falls_short_m = 1e-4 / 3;
  return clump;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

auto refused(const auto& matcher) { return ThrowsMessage<base::InputError>(matcher); }

TEST(ClumpFile, ComesBackToTheLastBit) {
  const ClumpFile clump = small_clump();
  const std::string text = dem::clump_json(clump);
  const ClumpFile back = dem::parse_clump_json(text, "clump");
  EXPECT_EQ(back.source, clump.source);
  EXPECT_EQ(back.repairs, clump.repairs);
  ASSERT_EQ(back.shape.spheres.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(back.shape.spheres[i].centre, clump.shape.spheres[i].centre);
    EXPECT_EQ(back.shape.spheres[i].radius, clump.shape.spheres[i].radius);
  }
  EXPECT_EQ(back.shape.volume_m3, clump.shape.volume_m3);
  EXPECT_EQ(back.shape.gyration_m2, clump.shape.gyration_m2);
  EXPECT_EQ(back.shape.surface.vertices, clump.shape.surface.vertices);
  EXPECT_EQ(back.shape.surface.triangles, clump.shape.surface.triangles);
  EXPECT_EQ(back.errors.volume_error, clump.errors.volume_error);
  EXPECT_EQ(back.errors.falls_short_m, clump.errors.falls_short_m);
  EXPECT_EQ(dem::clump_json(back), text);
}

/// A sphere with its radius in m.
ClumpFile ball(double radius_m) {
  ClumpFile clump;
  clump.shape = dem::sphere_shape(radius_m);
  return clump;
}

TEST(ClumpFile, LengthsInMillimetresAreFoundOut) {
  const TemporaryFolder folder;
  const auto read = [&](const ClumpFile& clump) {
    return [&, file = folder.write("nut.json", dem::clump_json(clump))] {
      dem::read_clump_file(file);
    };
  };
  EXPECT_THAT(read(ball(10)), refused(AllOf(HasSubstr("nut.json: spheres: they reach 10 m"),
                                            HasSubstr("divide lengths in mm by 1000"))));
  ClumpFile half_converted = ball(5e-4);  // 1 mm; its spheres alone, in m, would be a grain
  half_converted.shape.spheres.front().radius = .5;
  EXPECT_THAT(read(half_converted), refused(HasSubstr("does not fit to volume_m3")));
  EXPECT_NO_THROW(read(ball(5e-4))());
}

TEST(ClumpFile, IsReadFromDisk) {
  const TemporaryFolder folder;
  const auto file = folder.write("clump.json", dem::clump_json(ball(.01)));
  EXPECT_EQ(dem::read_clump_file(file).shape.spheres.front().radius, .01);
  EXPECT_THAT([&] { dem::read_clump_file(folder.path() / "none.json"); },
              refused(HasSubstr("there is no such file")));
  EXPECT_THAT([&] { dem::read_clump_file(folder.path()); }, refused(HasSubstr("is a folder")));
}

TEST(ClumpFile, NamesAllThatIsWrongAtOnce) {
  std::string text = dem::clump_json(small_clump());
  text = replaced(text, "\"radius_m\":3.141592653589793", "\"radius_m\":-1");
  text = replaced(text, "\"gyration_m2\":[0.3333333333333333,", "\"gyration_m2\":[0.1,");
  text = replaced(text, "\"volume_m3\"", "\"volume\"");
  text = replaced(text, "[0,2,1]", "[0,2,4]");
  EXPECT_THAT([&] { dem::parse_clump_json(text, "nut.json"); },
              refused(AllOf(HasSubstr("nut.json: volume_m3: is missing"),
                            HasSubstr("spheres[1].radius_m: is -1"),
                            HasSubstr("no body has these principal moments"),
                            HasSubstr("surface.triangles[0]: names corner 4 of 4"))));
}

TEST(ClumpFile, RefusesSpheresThatDoNotHangTogether) {
  ClumpFile clump = small_clump();
  clump.shape.spheres = {{{0, 0, 0}, 1}, {{2, 0, 0}, 1}, {{3.5, 0, 0}, .5}};
  dem::parse_clump_json(dem::clump_json(clump), "touching is enough");
  clump.shape.spheres[1].centre.x() = 2.001;
  EXPECT_THAT(
      [&] { dem::parse_clump_json(dem::clump_json(clump), "nut.json"); },
      refused(AllOf(HasSubstr("nut.json: spheres: they fall into 2 groups"), HasSubstr("Fix: "))));
}

TEST(SphereGroups, AreCounted) {
  EXPECT_EQ(dem::sphere_groups({}), 0);
  EXPECT_EQ(dem::sphere_groups({{{0, 0, 0}, 1}}), 1);
  // A chain whose links are listed out of order, and two on their own.
  EXPECT_EQ(
      dem::sphere_groups(
          {{{0, 0, 0}, 1}, {{6, 0, 0}, 1.5}, {{0, 9, 0}, 1}, {{3, 0, 0}, 2}, {{0, 0, 20}, 1}}),
      3);
}

TEST(ClumpFile, RefusesOtherFilesAndOtherVersions) {
  const std::string text = dem::clump_json(small_clump());
  const auto parse = [](const std::string& content) {
    return [content] { dem::parse_clump_json(content, "file"); };
  };
  EXPECT_THAT(parse(""), refused(HasSubstr("is not JSON")));
  EXPECT_THAT(parse(text.substr(0, text.size() / 2)), refused(HasSubstr("is not JSON")));
  EXPECT_THAT(parse("[1, 2]"), refused(HasSubstr("is not a clump file")));
  EXPECT_THAT(parse("{}"), refused(HasSubstr("is not a clump file")));
  EXPECT_THAT(parse(replaced(text, "\"version\":1", "\"version\":2")),
              refused(HasSubstr("another version")));
  EXPECT_THAT(parse(R"({"format":"repose clump","version":1})"),
              refused(AllOf(HasSubstr("spheres"), HasSubstr("surface"), HasSubstr("errors"))));
  EXPECT_THAT(parse(replaced(text, "\"spheres\":[", "\"spheres\":3,\"x\":[")),
              refused(HasSubstr("spheres: is 3, and must be a list")));
}

TEST(ClumpFile, IsNotWrittenWithNumbersThatJsonDoesNotHave) {
  ClumpFile clump = small_clump();
  clump.shape.spheres[0].radius = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(dem::clump_json(clump), base::InputError);
}

TEST(ExportShape, WritesAnStlInMillimetresThatReadsBack) {
  dem::ClumpShape shape = dem::sphere_shape(0.01);
  const auto content = dem::export_shape(shape, ShapeFormat::stl);
  const TemporaryFolder folder;
  const auto file = folder.write(
      "ball.stl", std::string(reinterpret_cast<const char*>(content.data()), content.size()));
  const dem::Scan scan = dem::read_scan(file, dem::ScanUnit::millimetre);
  EXPECT_TRUE(scan.repairs.empty());
  double reach = 0;
  for (const Vector& vertex : scan.surface.vertices) reach = std::max(reach, vertex.norm());
  EXPECT_NEAR(reach, 0.01, 1e-8);
}

TEST(ExportShape, WritesAGlbWithSpheresAndSurface) {
  dem::ClumpShape shape = dem::sphere_shape(0.01);
  shape.surface = box_surface(0.02, 0.02, 0.02);
  const auto content = dem::export_shape(shape, ShapeFormat::glb);
  const std::string text(reinterpret_cast<const char*>(content.data()), content.size());
  EXPECT_EQ(text.substr(0, 4), "glTF");
  EXPECT_THAT(text, AllOf(HasSubstr("spheres"), HasSubstr("surface"), HasSubstr("BLEND")));
}

TEST(ExportShape, RefusesAClumpWithoutSpheres) {
  EXPECT_THROW(dem::export_shape({}, ShapeFormat::glb), base::InputError);
}

}  // namespace
}  // namespace repose::testing
