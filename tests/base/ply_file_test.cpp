#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>

#include "base/polygon_file.h"
#include "tests/support/error_of.h"

namespace repose::base {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kCorners =
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
constexpr const char* kFaces = "element face 1\nproperty list uchar int vertex_indices\n";

std::string ascii(const std::string& elements, const std::string& body) {
  return "ply\nformat ascii 1.0\n" + elements + "end_header\n" + body;
}

std::string triangle(const std::string& face = "3 0 1 2") {
  return ascii(std::string(kCorners) + kFaces, "0 0 0\n1 0 0\n0 2.5 0\n" + face + '\n');
}

std::string error(const std::string& bytes) {
  return error_of([&] { parse_ply(bytes); });
}

template <typename Number>
std::string bytes_of(Number number, bool is_big_endian) {
  std::string bytes(reinterpret_cast<const char*>(&number), sizeof number);
  return is_big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

std::string binary_triangle(bool is_big_endian) {
  std::string bytes = std::string("ply\nformat ") +
                      (is_big_endian ? "binary_big_endian" : "binary_little_endian") + " 1.0\n" +
                      kCorners + kFaces + "end_header\n";
  for (const float x : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 2.5F, 0.F}) {
    bytes += bytes_of(x, is_big_endian);
  }
  bytes += '\3';
  for (const std::int32_t corner : {0, 1, 2}) bytes += bytes_of(corner, is_big_endian);
  return bytes;
}

TEST(PlyFile, IsReadInAllItsFormats) {
  for (const std::string& bytes : {triangle(), binary_triangle(false), binary_triangle(true)}) {
    const PolygonSurface surface = parse_ply(bytes);
    EXPECT_THAT(surface.corners.at(2), ElementsAre(0.F, 2.5F, 0.F));
    EXPECT_THAT(surface.faces, ElementsAre(ElementsAre(0, 1, 2)));
  }
}

TEST(PlyFile, WhatIsNoSurfaceIsPassedOver) {
  const PolygonSurface surface = parse_ply(
      ascii("comment scanned\nobj_info x\nelement camera 1\nproperty list uchar float rows\n" +
                std::string(kCorners) + "property uchar red\n" + kFaces,
            "2 0.5 0.25\r\n0 0 0 9\r\n1 0 0 9\r\n0 1 0 9\r\n2 0 1\r\n"));
  EXPECT_EQ(surface.corners.size(), 3U);
  EXPECT_TRUE(surface.faces.empty());  // a line
}

TEST(PlyFile, CornersThatAreNotThereAreRefused) {
  EXPECT_THAT(error(triangle("3 0 1 3")), HasSubstr("face 0: it names corner 3, and there are 3"));
  EXPECT_THAT(error(triangle("3 0 1 -1")), HasSubstr("-1 stands where a whole number"));
  EXPECT_THAT(error(triangle("3 0 1 0.5")), HasSubstr("0.5 stands where a whole number"));
}

TEST(PlyFile, EveryBeginningOfAFileIsRefused) {
  const std::string text = triangle(), binary = binary_triangle(false);
  for (std::size_t size = 0; size < binary.size(); ++size) {
    EXPECT_NE(error(binary.substr(0, size)), "") << size;
  }
  for (std::size_t size = 0; size + 2 < text.size(); ++size) {  // the last digit may go unnoticed
    EXPECT_NE(error(text.substr(0, size)), "") << size;
  }
}

TEST(PlyFile, PromisesAreNotBelieved) {
  const std::string endless = ascii(
      "element vertex 4000000000000000000\nproperty float x\n"
      "property float y\nproperty float z\n",
      "0 0 0\n");
  EXPECT_THAT(error(endless), HasSubstr("vertex 1 of 4000000000000000000: the file ends here"));
  EXPECT_THAT(error(ascii("element nothing 4000000000000000000\n", "")),
              HasSubstr("element nothing: it has no properties"));
  EXPECT_THAT(error(triangle("2000000000 0 1 2")), HasSubstr("the file ends here, too soon"));
}

TEST(PlyFile, HeadersThatAreNoneAreRefusedByLine) {
  EXPECT_THAT(error("solid"), HasSubstr("line 1 of the header"));
  EXPECT_THAT(error("ply\nformat ascii 1.0\nproperty float x\n"),
              HasSubstr("line 3 of the header: a property stands before any element"));
  EXPECT_THAT(error("ply\nelement vertex -1\n"), HasSubstr("line 2"));
  EXPECT_THAT(error("ply\nelement vertex 1\nproperty half x\n"), HasSubstr("no known type"));
  EXPECT_THAT(error("ply\nend_header\n"), HasSubstr("without a format"));
  EXPECT_THAT(error(ascii("element vertex 0\nproperty float x\n", "")),
              HasSubstr("not x, y and z"));
}

}  // namespace
}  // namespace repose::base
