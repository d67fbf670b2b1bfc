#include "calibrate/experiment/simulated_run.h"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

namespace repose::calibrate {
namespace {

using ::testing::Contains;
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
  EXPECT_NEAR(value_of(half), 24, 1e-12);
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
  EXPECT_NEAR(value_of(run), 25.5, 1e-12);
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
