#include <string>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "base/polygon_file.h"

namespace repose::base {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;

const std::string kFourCorners = "v 0 0 0\nv 20 0 0\nv 0 30 0\nv 0 0 40\n";

auto refuses(const std::string& what) { return ThrowsMessage<base::InputError>(HasSubstr(what)); }

TEST(ObjFile, CornersAreNamedFromTheFirstOrBackFromHere) {
  const PolygonSurface surface = parse_obj(kFourCorners + "f 1 2 3\nf -4 -3 -1\n");
  EXPECT_THAT(surface.faces, ElementsAre(ElementsAre(0, 1, 2), ElementsAre(0, 1, 3)));
  EXPECT_THAT(surface.corners[3], ElementsAre(0.0, 0.0, 40.0));
}

TEST(ObjFile, AllButCornersAndFacesIsPassedOver) {
  const PolygonSurface surface =
      parse_obj("# scan\r\nmtllib ../x\r\nusemtl\nvn 0 0 1\nvt 1\no nut\ns off\n" + kFourCorners +
                "f 1//1 2/7/1 3/9\r\nl 1 2\nf 1 2\nf\ncurv 0 1 2\nv +1e0 -.5 7 1 0 0 0");
  EXPECT_THAT(surface.faces, ElementsAre(ElementsAre(0, 1, 2)));
  EXPECT_THAT(surface.corners, SizeIs(5));
}

TEST(ObjFile, ALineGoesOnBehindABackslash) {
  const PolygonSurface surface = parse_obj("v 0 0 \\\n0\nv 1 0 0\nv 0 1 0\nf 1 \\\r\n 2 \\\n3\n");
  EXPECT_THAT(surface.faces, ElementsAre(ElementsAre(0, 1, 2)));
  EXPECT_THAT(parse_obj("v 1 2 3\\").corners, SizeIs(1));
}

TEST(ObjFile, AFaceMayStandBeforeItsCorners) {
  EXPECT_THAT(parse_obj("f 1 2 3\n" + kFourCorners).faces, SizeIs(1));
}

TEST(ObjFile, WhatIsWrongIsNamedWithItsLine) {
  EXPECT_THAT([] { parse_obj(kFourCorners + "f 1 2 5\n"); },
              refuses("line 5: a face names corner 5 of 4"));
  for (const char* face : {"f 0 1 2", "f -5 1 2", "f 1 2 x", "f 1 2 /3", "f 1 2 3000000000",
                           "f 1 2 99999999999999999999"}) {
    EXPECT_THAT([&] { parse_obj(kFourCorners + face); }, refuses("line 5: a face must name"));
  }
  for (const char* corner : {"v 1 2", "v 1 2 x", "v 1,5 2 3", "v"}) {
    EXPECT_THAT([&] { parse_obj(std::string("\n") + corner); }, refuses("line 2: a corner must"));
  }
}

TEST(ObjFile, NothingIsNoSurface) {
  EXPECT_THAT(parse_obj("").faces, IsEmpty());
  EXPECT_THAT(parse_obj("\n\n# nothing").corners, IsEmpty());
}

}  // namespace
}  // namespace repose::base
