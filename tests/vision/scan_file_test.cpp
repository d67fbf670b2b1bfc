#include "vision/scan/scan_file.h"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "tests/support/drawn_scan.h"
#include "tests/support/error_of.h"
#include "tests/support/temporary_folder.h"

namespace repose::vision {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

template <typename Number>
void append_bytes(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

class ScanFile : public ::testing::Test {
 protected:
  std::filesystem::path written(const std::string& name, const std::string& bytes) const {
    return folder_.write(name, bytes);
  }
  std::string error(const std::string& name, const std::string& bytes) const {
    const std::filesystem::path file = written(name, bytes);
    return error_of([&] { read_scan(file); });
  }

 private:
  testing::TemporaryFolder folder_;
};

/// One triangle with the corners (0, 0, 0), (2, 0, 0) and (0, 2, 0).
std::string binary_stl() {
  std::string bytes(80, ' ');
  append_bytes(bytes, std::uint32_t{1});
  for (const float number : {0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 2.F, 0.F, 0.F, 0.F, 2.F, 0.F}) {
    append_bytes(bytes, number);
  }
  append_bytes(bytes, std::uint16_t{0});
  return bytes;
}

std::string text_stl() {
  return "solid heap\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 2e0 0\n"
         "endloop\nendfacet\nendsolid heap\n";
}

/// The same triangle in a node that moves it by (10, 20, 30).
std::string small_glb(const std::string& position = R"("bufferView":0,"componentType":5126)") {
  std::string numbers;
  for (const float number : {0.F, 0.F, 0.F, 2.F, 0.F, 0.F, 0.F, 2.F, 0.F})
    append_bytes(numbers, number);
  for (const std::uint16_t corner : {0, 1, 2, 0}) append_bytes(numbers, corner);
  std::string json = fmt::format(
      R"({{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0,)"
      R"("translation":[10,20,30]}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},)"
      R"("indices":1}}]}}],"accessors":[{{{},"count":3,"type":"VEC3"}},{{"bufferView":1,)"
      R"("componentType":5123,"count":3,"type":"SCALAR"}}],"bufferViews":[{{"buffer":0,)"
      R"("byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":6}}],)"
      R"("buffers":[{{"byteLength":44}}]}})",
      position);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string bytes = "glTF";
  append_bytes(bytes, std::uint32_t{2});
  append_bytes(bytes, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + numbers.size()));
  append_bytes(bytes, static_cast<std::uint32_t>(json.size()));
  append_bytes(bytes, std::uint32_t{0x4E4F534A});
  bytes += json;
  append_bytes(bytes, static_cast<std::uint32_t>(numbers.size()));
  append_bytes(bytes, std::uint32_t{0x004E4942});
  return bytes + numbers;
}

TEST_F(ScanFile, ACloudIsTakenAsItIs) {
  const std::vector<base::Corner> places = {{0, 0, 0}, {1, -2, 3}, {.5, 4, 8}};
  const Scan ply = read_scan(written("a.ply", testing::ply_of(places)));
  EXPECT_FALSE(ply.is_surface);
  EXPECT_EQ(ply.points, places);
  EXPECT_FALSE(ply.unit_mm.has_value());
  EXPECT_EQ(read_scan(written("a.obj", "v 0 0 0\nv 1 -2 3\nv .5 4 8\n")).points, places);
}

TEST_F(ScanFile, SurfacesGivePointsAllOverThem) {
  const std::vector<base::Corner> corners = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  const std::string obj = "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n";
  for (const auto& [name, bytes] :
       {std::pair<std::string, std::string>("a.ply", testing::ply_of(corners, {{0, 1, 2}})),
        {"a.obj", obj},
        {"b.stl", binary_stl()},
        {"c.STL", text_stl()}}) {
    const Scan scan = read_scan(written(name, bytes));
    EXPECT_TRUE(scan.is_surface) << name;
    double x = 0, y = 0;
    for (const base::Corner& point : scan.points) {
      ASSERT_TRUE(point[0] >= 0 && point[1] >= 0 && point[0] + point[1] <= 2 + 1e-9) << name;
      x += point[0];
      y += point[1];
    }
    const auto count = static_cast<double>(scan.points.size());
    EXPECT_GT(count, 1e6);
    EXPECT_NEAR(x / count, 2.0 / 3, 1e-3) << name;
    EXPECT_NEAR(y / count, 2.0 / 3, 1e-3) << name;
  }
}

TEST_F(ScanFile, GlbIsInMetresAndWhereItsNodesAre) {
  const Scan scan = read_scan(written("a.glb", small_glb()));
  EXPECT_EQ(scan.unit_mm, 1000);
  EXPECT_TRUE(scan.is_surface);
  for (std::size_t k = 0; k < scan.points.size(); k += 1000) {
    EXPECT_GE(scan.points[k][0], 10);
    EXPECT_GE(scan.points[k][1], 20);
    EXPECT_EQ(scan.points[k][2], 30);
  }
}

TEST_F(ScanFile, PointsWithoutAPlaceAreCounted) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Scan scan = read_scan(
      written("a.ply", testing::ply_of({{0, 0, 0}, {kNan, 1, 1}, {1, 1, 1}, {1, 1e30, 1}})));
  EXPECT_THAT(scan.points, SizeIs(2));
  EXPECT_EQ(scan.not_finite, 2u);
}

TEST_F(ScanFile, DamagedFilesAreRefusedWithTheReason) {
  EXPECT_THAT(error("a.ply", ""), HasSubstr("is empty"));
  EXPECT_THAT(error("a.ply", "no scan"), HasSubstr("does not begin as a .ply file"));
  EXPECT_THAT(error("a.obj", "# nothing\n"), HasSubstr("holds no points"));
  EXPECT_THAT(error("a.stl", "solid heap\nfacet\nvertex 0 0 x\n"), HasSubstr("\"x\" stands where"));
  EXPECT_THAT(error("a.glb", small_glb(R"("componentType":5126)")), HasSubstr("compressed"));
  EXPECT_THAT(error("a.glb", small_glb(R"("bufferView":0,"componentType":5126,"byteOffset":8)")),
              HasSubstr("more than its buffer holds"));
  EXPECT_THAT(error("a.glb", small_glb(R"("bufferView":0,"componentType":-1)")),
              HasSubstr("not whole"));
}

TEST_F(ScanFile, FilesThatEndTooSoonAreRefusedWhereverTheyEnd) {
  const std::string ply = testing::ply_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  for (const auto& [name, bytes] : {std::pair<std::string, std::string>("a.ply", ply),
                                    {"a.stl", binary_stl()},
                                    {"b.stl", text_stl().substr(0, text_stl().find("endsolid"))},
                                    {"a.glb", small_glb()}}) {
    const std::string whole = name == "b.stl" ? bytes + "x" : bytes;
    for (std::size_t length = 4; length < whole.size(); length += 7) {
      EXPECT_THAT(error(name, whole.substr(0, length)), HasSubstr("Fix: ")) << name << length;
    }
  }
}

TEST_F(ScanFile, IsToldByItsName) {
  EXPECT_TRUE(has_scan_ending("heap.PLY"));
  EXPECT_TRUE(has_scan_ending("a/heap.glb"));
  EXPECT_FALSE(has_scan_ending("heap.png"));
  EXPECT_FALSE(has_scan_ending("ply"));
}

}  // namespace
}  // namespace repose::vision
