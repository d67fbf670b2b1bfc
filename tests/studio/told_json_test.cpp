// The page's hints about a picture, in both directions.
#include "studio/told_json.h"

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "base/units.h"

namespace repose::studio {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

vision::PictureSettings all_that_can_be_told() {
  vision::PictureSettings told;
  vision::MeasureOptions& measuring = told.measuring;
  measuring.hints.turn_deg = 270;
  measuring.hints.heap = vision::Box{.x = 10, .y = 20, .width = 300, .height = 200};
  measuring.hints.half = vision::Side::left;
  measuring.hints.ground = vision::Segment{{10, 220}, {310, 224.5}};
  measuring.hints.keep = {{50, 60}};
  measuring.hints.drop = {{5, 6}, {7, 8}};
  measuring.excluded = {{.x = 1, .y = 2, .width = 3, .height = 4}};
  measuring.camera_pitch_rad = 3 * kDegree;
  measuring.window_from = .1;
  measuring.window_to = .9;
  told.scale.scale = vision::ScaleBar{.line = {{0, 0}, {100, 0}}, .length_mm = 50};
  return told;
}

TEST(ToldJson, ComesBackAsItWasTold) {
  const Json json = told_json(all_that_can_be_told());
  EXPECT_EQ(told_json(with_told({}, json)), json);
  EXPECT_EQ(json.at("ground"), Json({10, 220, 310, 224.5}));
  EXPECT_EQ(json.at("pitch_deg"), 3);
  const Json nothing = told_json({});
  EXPECT_EQ(told_json(with_told({}, nothing)), nothing);
}

TEST(ToldJson, WhatIsNotToldIsNotKeptFromBefore) {
  const vision::PictureSettings settings = with_told(all_that_can_be_told(), Json::object());
  EXPECT_EQ(told_json(settings), told_json({}));
}

TEST(ToldJson, AMaskAndALensStay) {
  vision::PictureSettings settings;
  settings.measuring.hints.mask_file = "mask.png";
  settings.scale.lens_file = "camera.toml";
  settings = with_told(settings, told_json({}));
  EXPECT_EQ(settings.measuring.hints.mask_file, "mask.png");
  EXPECT_EQ(settings.scale.lens_file, "camera.toml");
}

TEST(ToldJson, EachFaultIsNamed) {
  const Json told = Json::parse(R"({"rotate_deg": 45, "heap": [1, 2, 3], "half": "middle",
    "ground": "level", "keep": [[1, 2], [3]], "pitch_deg": "steep", "board": 1, "colour": "red",
    "scale": {"length_mm": 3}, "window": [0.8, 0.2], "definition": "mine"})");
  EXPECT_THAT([&] { with_told({}, told); },
              ThrowsMessage<base::InputError>(
                  AllOf(HasSubstr("rotate_deg"), HasSubstr("heap"), HasSubstr("half"),
                        HasSubstr("ground"), HasSubstr("keep"), HasSubstr("pitch_deg"),
                        HasSubstr("board"), HasSubstr("colour"), HasSubstr("scale"))));
  EXPECT_THAT([&] { with_told({}, Json::array()); },
              ThrowsMessage<base::InputError>(HasSubstr("no object")));
}

TEST(ToldJson, StrokesAreReadAndWhatIsNoneIsRefused) {
  const auto strokes = painted_in(
      Json::parse(R"({"painted": [{"says": "no_heap", "width": 12, "path": [[1, 2], [3, 4]]}]})"));
  ASSERT_EQ(strokes.size(), 1U);
  EXPECT_EQ(strokes.front().says, vision::BrushStroke::Says::no_heap);
  EXPECT_EQ(strokes.front().width_px, 12);
  EXPECT_EQ(strokes.front().path.back().y, 4);
  EXPECT_TRUE(painted_in(told_json({})).empty());
  for (const char* text : {R"({"painted": 1})", R"({"painted": ["x"]})",
                           R"({"painted": [{"says": "all", "width": 1, "path": []}]})",
                           R"({"painted": [{"says": "heap", "width": 0, "path": []}]})",
                           R"({"painted": [{"says": "heap", "width": 1e9, "path": []}]})",
                           R"({"painted": [{"says": "heap", "width": 2, "path": [[1]]}]})"}) {
    EXPECT_THROW(painted_in(Json::parse(text)), base::InputError) << text;
  }
}

TEST(ToldJson, NumbersThatNoPictureHasAreRefused) {
  for (const char* text : {R"({"heap": [1e300, 0, 10, 10]})", R"({"keep": [[1e9, 2]]})",
                           R"({"ground": [null, 0, 1, 1]})", R"({"scale": {"line": [0,0,1,0],
                           "length_mm": -5}})",
                           R"({"board": true, "scale": {"line":
                           [0, 0, 100, 0], "length_mm": 5}})"}) {
    EXPECT_THROW(with_told({}, Json::parse(text)), base::InputError) << text;
  }
}

}  // namespace
}  // namespace repose::studio
