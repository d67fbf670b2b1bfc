#include "calibrate/experiment/simulated_run.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

namespace repose::calibrate {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Key;
using ::testing::Not;
using vision::MeasureStatus;

HeapView seen(MeasureStatus status, double angle_deg) {
  HeapView view;
  view.picture.status = status;
  if (status != MeasureStatus::refused) {
    view.picture.angle_rad = angle_deg * std::numbers::pi / 180;
  }
  return view;
}

SimulatedRun heap_of(std::vector<HeapView> views) {
  SimulatedRun run;
  run.value = 20;
  run.readings = {{"height_mm", 55}, {"angle_xz_deg", std::nan("")}};
  run.views = std::move(views);
  return run;
}

TEST(SimulatedRun, AHeapThatHalfOfItsViewsShowHasTheAngleOfItsPictures) {
  const SimulatedRun half = heap_of({seen(MeasureStatus::ok, 24), seen(MeasureStatus::refused, 0)});
  EXPECT_NEAR(value_of(half).value(), 24, 1e-12);
  EXPECT_EQ(readings_of(half).at("from_pictures"), 1);
  EXPECT_EQ(readings_of(half).at("angle_from_positions_deg"), 20);
  const SimulatedRun less = heap_of({seen(MeasureStatus::ok, 24), seen(MeasureStatus::refused, 0),
                                     seen(MeasureStatus::refused, 0)});
  EXPECT_EQ(value_of(less), 20);
  EXPECT_EQ(readings_of(less).at("from_pictures"), 0);
  EXPECT_NEAR(readings_of(less).at("angle_from_pictures_deg"), 24, 1e-12);
  EXPECT_EQ(value_of(heap_of({})), 20) << "no pictures were asked for";
}

TEST(SimulatedRun, FlaggedViewsCount) {
  const SimulatedRun run = heap_of({seen(MeasureStatus::ok, 24), seen(MeasureStatus::flagged, 27)});
  EXPECT_NEAR(value_of(run).value(), 25.5, 1e-12);
  EXPECT_EQ(readings_of(run).at("views_flagged"), 1);
  EXPECT_EQ(readings_of(run).at("views_measured"), 2);
}

TEST(SimulatedRun, OneViewScattersMoreThanTheMeanOfAll) {
  const SimulatedRun run = heap_of({seen(MeasureStatus::ok, 24), seen(MeasureStatus::ok, 27),
                                    seen(MeasureStatus::refused, 0), seen(MeasureStatus::ok, 24)});
  EXPECT_NEAR(readings_of(run).at("sd_between_views_deg"), std::sqrt(3), 1e-9);
  EXPECT_NEAR(readings_of(run).at(kOneViewScatter), std::sqrt(2), 1e-9);
  EXPECT_THAT(readings_of(heap_of({seen(MeasureStatus::ok, 24)})),
              Not(Contains(Key(kOneViewScatter))))
      << "of a single view nothing is known";
}

TEST(SimulatedRun, NumbersThatDoNotExistAreNoReadings) {
  EXPECT_THAT(readings_of(heap_of({})), Not(Contains(Key("angle_xz_deg"))));
  SimulatedRun failed = heap_of({});
  failed.failure = "the grains stay in the tube";
  EXPECT_THAT(readings_of(failed), IsEmpty());
}

SimulatedRun simulated_heap(std::optional<double> value, double no_heap) {
  SimulatedRun run;
  run.value = value;
  run.timestep_s = 1e-6;
  run.readings = {{"no_heap", no_heap},
                  {"height_mm", 64},
                  {"angle_xz_deg", 20},
                  {"inner_window_deg", 21},
                  {"base_radius_mm", 90}};
  return run;
}

TEST(SimulatedRun, SaysWhyGrainsMakeNoHeap) {
  EXPECT_EQ(no_heap_reason(simulated_heap(20, 0)), "");
  EXPECT_THAT(no_heap_reason(simulated_heap({}, 1)),
              ::testing::AllOf(HasSubstr("spread to a layer 64 mm high"), HasSubstr("Fix: ")));
  EXPECT_THAT(no_heap_reason(simulated_heap({}, 0)),
              ::testing::AllOf(HasSubstr("stand 64 mm high"), HasSubstr("Fix: ")));
  EXPECT_EQ(no_heap_reason(heap_of({})), "") << "of another experiment";
}

TEST(SimulatedRun, ZerosThatEarlierVersionsWroteForNoAngleAreNone) {
  // A column stood, and 0 was written for each of its angles.
  SimulatedRun column = simulated_heap(0, 0);
  for (const char* name : {"angle_xz_deg", "inner_window_deg", "base_radius_mm"}) {
    column.readings[name] = 0;
  }
  const SimulatedRun read = run_in(run_text(column)).value();
  EXPECT_FALSE(read.value);
  EXPECT_THAT(read.failure, HasSubstr("stand 64 mm high"));
  EXPECT_TRUE(std::isnan(read.readings.at("angle_xz_deg")));
  EXPECT_THAT(readings_of(read), IsEmpty());
  // A layer had the angle of its edge.
  const SimulatedRun layer = run_in(run_text(simulated_heap(23.8, 1))).value();
  EXPECT_THAT(layer.failure, HasSubstr("spread to a layer"));
  EXPECT_FALSE(value_of(layer));
  // A heap that has an angle keeps it, and a drop that does not rebound its 0.
  EXPECT_EQ(value_of(run_in(run_text(simulated_heap(20, 0))).value()), 20);
  SimulatedRun drop;
  drop.value = 0;
  drop.timestep_s = 1e-6;
  drop.readings = {{"never_rose", 2}};
  EXPECT_EQ(value_of(run_in(run_text(drop)).value()), 0);
}

/// Seen from two sides as 24 degrees, and by a line along the whole flank as 21.
SimulatedRun defined_heap() {
  SimulatedRun run = simulated_heap(20, 0);
  run.views = {seen(MeasureStatus::ok, 24), seen(MeasureStatus::ok, 24)};
  for (HeapView& view : run.views) {
    view.picture.other_rad = {{"whole_flank", 21 * std::numbers::pi / 180}};
  }
  run.other_deg = {{"whole_flank", 17}, {"outer_window", 19}};
  return run;
}

TEST(SimulatedRun, IsReadByTheDefinitionThatIsAskedFor) {
  SimulatedRun run = defined_heap();
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

TEST(SimulatedRun, DefinitionsComeBackFromItsText) {
  const SimulatedRun run = run_in(run_text(defined_heap())).value();
  EXPECT_EQ(run.other_deg, defined_heap().other_deg);
  EXPECT_EQ(run.views[1].picture.other_rad, defined_heap().views[1].picture.other_rad);
  EXPECT_TRUE(has_definition(run, "whole_flank"));
  SimulatedRun earlier = run;
  earlier.views[0].picture.other_rad.clear();
  EXPECT_FALSE(has_definition(earlier, "whole_flank")) << "to be measured again";
  EXPECT_TRUE(has_definition(earlier, "flank_20_80"));
  EXPECT_TRUE(has_definition(earlier, ""));
  SimulatedRun unseen = run;
  unseen.views = {seen(MeasureStatus::refused, 0)};
  EXPECT_TRUE(has_definition(unseen, "whole_flank")) << "it was looked for";
}

TEST(SimulatedRun, ComesBackFromItsText) {
  SimulatedRun run =
      heap_of({seen(MeasureStatus::flagged, 1. / 3), seen(MeasureStatus::refused, 0)});
  run.seed = ~0ULL;
  run.clump_steps = 1e15 / 7;
  run.trajectory_s = .05;
  run.timestep_s = 1e-6;
  const auto back = run_in(run_text(run));
  ASSERT_TRUE(back);
  EXPECT_EQ(run_text(*back), run_text(run));
  EXPECT_EQ(back->seed, run.seed);
  EXPECT_EQ(back->views[0].picture.angle_rad, run.views[0].picture.angle_rad);
  EXPECT_TRUE(std::isnan(back->readings.at("angle_xz_deg")));
  EXPECT_FALSE(back->camera);
  run.camera = {.distance_m = 1.5, .height_m = 1. / 3};
  EXPECT_EQ(run_in(run_text(run)).value().camera, run.camera);
  EXPECT_FALSE(run_in("{}"));
  EXPECT_FALSE(run_in("[1"));
}

TEST(SimulatedRun, WhatNoRunGivesIsNone) {
  SimulatedRun run = heap_of({});
  run.timestep_s = 1e-6;
  ASSERT_TRUE(run_in(run_text(run)));
  SimulatedRun huge = run, none = run, backwards = run, still = run;
  huge.value = 1e200;
  none.readings.clear();
  backwards.steps = -1;
  still.timestep_s = 0;
  for (const SimulatedRun& wrong : {huge, none, backwards, still}) {
    EXPECT_FALSE(run_in(run_text(wrong))) << run_text(wrong);
  }
  none.failure = "the grains stay in the tube";
  EXPECT_TRUE(run_in(run_text(none)));
}

}  // namespace
}  // namespace repose::calibrate
