#include "calibrate/experiment/run_result.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "dem/experiment/experiment_table.h"
#include "tests/calibrate/stored_runs.h"

namespace repose::calibrate {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Key;
using ::testing::Not;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;
using vision::MeasureStatus;

HeapView seen(MeasureStatus status, double angle_deg) {
  HeapView view;
  view.picture.status = status;
  if (status != MeasureStatus::refused) {
    view.picture.angle_rad = angle_deg * std::numbers::pi / 180;
  }
  return view;
}

RunResult heap_of(std::vector<HeapView> views) {
  RunResult run;
  run.value = 20;
  run.readings = {{"height_mm", 55}, {"angle_xz_deg", std::nullopt}};
  run.views = std::move(views);
  return run;
}

TEST(RunResult, AHeapThatHalfOfItsViewsShowHasTheAngleOfItsPictures) {
  const RunResult half = heap_of({seen(MeasureStatus::ok, 24), seen(MeasureStatus::refused, 0)});
  EXPECT_NEAR(value_of(half).value(), 24, 1e-12);
  EXPECT_EQ(readings_of(half).at("from_pictures"), 1);
  EXPECT_EQ(readings_of(half).at("angle_from_positions_deg"), 20);
  const RunResult less = heap_of({seen(MeasureStatus::ok, 24), seen(MeasureStatus::refused, 0),
                                  seen(MeasureStatus::refused, 0)});
  EXPECT_EQ(value_of(less), 20);
  EXPECT_EQ(readings_of(less).at("from_pictures"), 0);
  EXPECT_NEAR(readings_of(less).at("angle_from_pictures_deg"), 24, 1e-12);
  EXPECT_EQ(value_of(heap_of({})), 20) << "no pictures were asked for";
}

TEST(RunResult, FlaggedViewsCount) {
  const RunResult run = heap_of({seen(MeasureStatus::ok, 24), seen(MeasureStatus::flagged, 27)});
  EXPECT_NEAR(value_of(run).value(), 25.5, 1e-12);
  EXPECT_EQ(readings_of(run).at("views_flagged"), 1);
  EXPECT_EQ(readings_of(run).at("views_measured"), 2);
}

TEST(RunResult, OneViewScattersMoreThanTheMeanOfAll) {
  const RunResult run = heap_of({seen(MeasureStatus::ok, 24), seen(MeasureStatus::ok, 27),
                                 seen(MeasureStatus::refused, 0), seen(MeasureStatus::ok, 24)});
  EXPECT_NEAR(readings_of(run).at("sd_between_views_deg"), std::sqrt(3), 1e-9);
  EXPECT_NEAR(readings_of(run).at(kOneViewScatter), std::sqrt(2), 1e-9);
  EXPECT_THAT(readings_of(heap_of({seen(MeasureStatus::ok, 24)})),
              Not(Contains(Key(kOneViewScatter))))
      << "of a single view nothing is known";
}

TEST(RunResult, NumbersThatDoNotExistAreNoReadings) {
  EXPECT_THAT(readings_of(heap_of({})), Not(Contains(Key("angle_xz_deg"))));
  RunResult failed = heap_of({});
  failed.failure = "the grains stay in the tube";
  EXPECT_THAT(readings_of(failed), IsEmpty());
}

RunResult simulated_heap(std::optional<double> value, double no_heap) {
  RunResult run;
  run.value = value;
  run.timestep_s = 1e-6;
  run.readings = {{"no_heap", no_heap},
                  {"height_mm", 64},
                  {"angle_xz_deg", 20},
                  {"inner_window_deg", 21},
                  {"base_radius_mm", 90}};
  return run;
}

TEST(RunResult, SaysWhyGrainsMakeNoHeap) {
  EXPECT_EQ(no_heap_reason(simulated_heap(20, 0)), "");
  EXPECT_THAT(no_heap_reason(simulated_heap({}, 1)),
              AllOf(HasSubstr("spread to a layer 64 mm high"), HasSubstr("Fix: ")));
  EXPECT_THAT(no_heap_reason(simulated_heap({}, 0)),
              AllOf(HasSubstr("stand 64 mm high"), HasSubstr("Fix: ")));
  EXPECT_EQ(no_heap_reason(heap_of({})), "") << "of another experiment";
}

TEST(RunResult, ZerosThatEarlierVersionsWroteForNoAngleAreNone) {
  // For a column, earlier versions wrote 0 for each angle.
  RunResult column = simulated_heap(0, 0);
  for (const char* name : {"angle_xz_deg", "inner_window_deg", "base_radius_mm"}) {
    column.readings[name] = 0;
  }
  const RunResult read = run_in(text_of(column));
  EXPECT_FALSE(read.value);
  EXPECT_THAT(read.failure, HasSubstr("stand 64 mm high"));
  EXPECT_THAT(read.readings, Contains(Pair("angle_xz_deg", std::nullopt)));
  EXPECT_THAT(readings_of(read), IsEmpty());
  // For a layer, they wrote the angle of its edge.
  const RunResult layer = run_in(text_of(simulated_heap(23.8, 1)));
  EXPECT_THAT(layer.failure, HasSubstr("spread to a layer"));
  EXPECT_FALSE(value_of(layer));
  // A heap with an angle keeps it, and a drop without rebound keeps its 0.
  EXPECT_EQ(value_of(run_in(text_of(simulated_heap(20, 0)))), 20);
  RunResult drop;
  drop.value = 0;
  drop.timestep_s = 1e-6;
  drop.readings = {{"never_rose", 2}};
  EXPECT_EQ(value_of(run_in(text_of(drop))), 0);
}

/// 24 degrees in both views, or 21 by a line along the whole flank.
RunResult defined_heap() {
  RunResult run = simulated_heap(20, 0);
  run.views = {seen(MeasureStatus::ok, 24), seen(MeasureStatus::ok, 24)};
  for (HeapView& view : run.views) {
    view.picture.other_rad = {{"whole_flank", 21 * std::numbers::pi / 180}};
  }
  run.other_deg = {{"whole_flank", 17}, {"outer_window", 19}};
  return run;
}

TEST(RunResult, IsReadByTheDefinitionThatIsAskedFor) {
  RunResult run = defined_heap();
  EXPECT_NEAR(value_of(run).value(), 24, 1e-12);
  run.definition = "flank_20_80";
  EXPECT_NEAR(value_of(run).value(), 24, 1e-12) << "named, and the same";
  run.definition = "whole_flank";
  EXPECT_NEAR(value_of(run).value(), 21, 1e-12);
  EXPECT_NEAR(readings_of(run).at("value"), 21, 1e-12);
  EXPECT_EQ(readings_of(run).at("angle_from_positions_deg"), 17);
  EXPECT_NEAR(readings_of(run).at("angle_from_pictures_deg"), 21, 1e-12);
  run.definition = "outer_window";
  EXPECT_EQ(value_of(run), 19) << "no view has it, the positions do";
  run.definition = "inner_window";
  EXPECT_FALSE(value_of(run));
  EXPECT_THAT(readings_of(run), Not(Contains(Key("value"))));
  const auto all = values_by_definition(run);
  ASSERT_EQ(all.size(), 3U);
  EXPECT_EQ(all[0].first, "flank_20_80");
  EXPECT_EQ(all[1], (std::pair<std::string, double>("outer_window", 19)));
  EXPECT_EQ(all[2].first, "whole_flank");
  EXPECT_NEAR(all[2].second, 21, 1e-12);
  EXPECT_THAT(values_by_definition(heap_of({})), IsEmpty()) << "of another experiment";
}

TEST(RunResult, DefinitionsComeBackFromItsText) {
  const RunResult run = run_in(text_of(defined_heap()));
  EXPECT_EQ(run.other_deg, defined_heap().other_deg);
  EXPECT_EQ(run.views[1].picture.other_rad, defined_heap().views[1].picture.other_rad);
  EXPECT_TRUE(has_definition(run, "whole_flank"));
  RunResult earlier = run;
  earlier.views[0].picture.other_rad.clear();
  EXPECT_FALSE(has_definition(earlier, "whole_flank")) << "to be measured again";
  EXPECT_TRUE(has_definition(earlier, "flank_20_80"));
  EXPECT_TRUE(has_definition(earlier, ""));
  RunResult unseen = run;
  unseen.views = {seen(MeasureStatus::refused, 0)};
  EXPECT_TRUE(has_definition(unseen, "whole_flank")) << "it was looked for";
}

TEST(RunResult, ComesBackFromItsText) {
  RunResult run = heap_of({seen(MeasureStatus::flagged, 1. / 3), seen(MeasureStatus::refused, 0)});
  run.simulated = R"({"experiment":"heap","seed":18446744073709551615})";
  run.seed = ~0ULL;
  run.value = 23.4000000000000021;
  run.readings["denormal"] = 5e-324;
  run.clump_steps = 1e15 / 7;
  run.trajectory_s = .05;
  run.timestep_s = 1e-5 / 3;
  run.picture_error = "no \"picture\"\nat all";
  const RunResult back = run_in(text_of(run));
  EXPECT_EQ(text_of(back), text_of(run));
  EXPECT_EQ(back.simulated, run.simulated);
  EXPECT_EQ(back.seed, run.seed);
  EXPECT_EQ(back.value, run.value);
  EXPECT_EQ(back.readings, run.readings);
  EXPECT_EQ(back.clump_steps, run.clump_steps);
  EXPECT_EQ(back.timestep_s, run.timestep_s);
  EXPECT_EQ(back.trajectory_s, run.trajectory_s);
  EXPECT_EQ(back.picture_error, run.picture_error);
  EXPECT_EQ(back.views[0].picture.status, MeasureStatus::flagged);
  EXPECT_EQ(back.views[0].picture.angle_rad, run.views[0].picture.angle_rad);
  EXPECT_FALSE(back.views[1].picture.angle_rad);
  EXPECT_FALSE(back.camera);
  run.camera = {.distance_m = 1.5, .height_m = 1. / 3};
  EXPECT_EQ(run_in(text_of(run)).camera, run.camera);
}

TEST(RunResult, UnknownNumbersStayUnknown) {
  RunResult run = heap_of({});
  run.value.reset();
  run.readings = {{"height_mm", 55}, {"angle_xz_deg", std::nullopt}};
  run.timestep_s = 1e-6;
  EXPECT_THAT(text_of(run), HasSubstr("\"angle_xz_deg\": null"));
  const RunResult back = run_in(text_of(run));
  EXPECT_FALSE(back.value);
  EXPECT_THAT(back.readings, Contains(Pair("angle_xz_deg", std::nullopt)));
  EXPECT_FALSE(back.readings.number("angle_xz_deg"));
  EXPECT_THROW(static_cast<void>(back.readings.at("angle_xz_deg")), std::out_of_range);
  EXPECT_FALSE(back.readings.number("base_radius_mm")) << "there is none of that name";
  EXPECT_FALSE(value_of(back));
  EXPECT_THAT(readings_of(back), UnorderedElementsAre(Key("height_mm"), Key("timestep_s")));
}

TEST(RunResult, FilesOfEarlierVersionsAreReadAndWrittenAsTheyWere) {
  const RunResult heap = run_in(test::kStoredHeap);
  EXPECT_EQ(text_of(heap), test::kStoredHeap);
  EXPECT_THAT(heap.simulated, AllOf(HasSubstr(R"("experiment":"heap")"), HasSubstr("240.0")));
  EXPECT_EQ(heap.seed, 3U);
  EXPECT_EQ(heap.value, 27.75343942413844);
  EXPECT_EQ(heap.readings.at("height_mm"), 76.70417073342024);
  EXPECT_EQ(heap.steps, 17851);
  ASSERT_EQ(heap.views.size(), 2U);
  EXPECT_EQ(heap.views[0].picture.status, MeasureStatus::flagged);
  EXPECT_EQ(heap.views[1].picture.angle_rad, 0.43794488562412537);
  EXPECT_EQ(heap.views[1].picture.other_rad.at("whole_flank"), 0.43384507509194475);
  EXPECT_EQ(heap.camera, (dem::LevelCamera{.distance_m = .9, .height_m = .06}));
  EXPECT_EQ(heap.other_deg.size(), 5U);
  EXPECT_TRUE(is_from_pictures(heap));

  const RunResult layer = run_in(test::kStoredLayer);
  EXPECT_EQ(text_of(layer), test::kStoredLayer);
  EXPECT_FALSE(layer.value);
  EXPECT_THAT(layer.readings, Contains(Pair("base_radius_mm", std::nullopt)));
  EXPECT_THAT(layer.failure, HasSubstr("spread to a layer 28.3 mm high"));
}

std::string refusal(const std::string& text) {
  try {
    run_in(text);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return {};
}

TEST(RunResult, WhatNoRunGivesIsRefused) {
  RunResult run = heap_of({});
  run.timestep_s = 1e-6;
  EXPECT_EQ(refusal(text_of(run)), "");
  RunResult huge = run, none = run, backwards = run, still = run;
  huge.value = 1e200;
  none.readings.clear();
  backwards.steps = -1;
  still.timestep_s = 0;
  for (const RunResult& wrong : {huge, none, backwards, still}) {
    EXPECT_THAT(refusal(text_of(wrong)), HasSubstr("was changed")) << text_of(wrong);
  }
  none.failure = "the grains stay in the tube";
  EXPECT_EQ(refusal(text_of(none)), "");
}

TEST(RunResult, ChangedTextIsRefused) {
  EXPECT_THAT(refusal("[1"), HasSubstr("cut short"));
  EXPECT_THAT(refusal("{}"), HasSubstr("no fingerprint"));
  std::string changed = test::kStoredHeap;
  changed.replace(changed.find("17851"), 5, "17852");
  EXPECT_THAT(refusal(changed), HasSubstr("was changed"));
}

}  // namespace
}  // namespace repose::calibrate
