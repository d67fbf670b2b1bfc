#include <cmath>
#include <numbers>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "dem/experiment/heap.h"
#include "tests/dem/experiment_model.h"

namespace repose::dem {
namespace {

HeapProtocol small_tube() {
  HeapProtocol protocol;
  protocol.tube_diameter_m = .07;
  protocol.tube_height_m = .1;
  protocol.lift_speed_m_s = .1;
  protocol.plate_m = .3;
  return protocol;
}

TEST(Heap, FillsTheTubeAndLiftsItOff) {
  const Repeat repeat = run_heap(test::soft_bench(), small_tube(), 1);
  const auto& readings = repeat.readings;
  // Spheres of 19.3 mm in a tube of 70 mm have a solid fraction of .40 to .60.
  const double fraction = readings.at("grains") * 3.746e-6 / (std::numbers::pi * .035 * .035 * .1);
  EXPECT_GT(fraction, .4);
  EXPECT_LT(fraction, .6);
  EXPECT_EQ(readings.at("grains"),
            readings.at("grains_on_plate") + readings.at("grains_off_plate"));
  EXPECT_EQ(readings.at("at_rest"), 1);
  EXPECT_GT(readings.at("height_mm"), 19);
  EXPECT_FALSE(repeat.value);
  EXPECT_EQ(repeat.envelopes.size(), 18U);
  EXPECT_EQ(readings.at("height_mm"), 1e3 * height_m(repeat.envelopes));
  EXPECT_GT(repeat.clump_steps, 0);
  for (int k = 0; k < repeat.state->grain_count(); ++k) {
    if (!repeat.state->is_present(k)) continue;
    EXPECT_GT(repeat.state->grain(k).position.z(), .009);
  }
}

TEST(HeapThreads, GiveTheSameBytes) {
  Model model = test::soft_bench();
  HeapProtocol protocol = small_tube();
  protocol.tube_diameter_m = .08;
  protocol.tube_height_m = .06;
  const Repeat one = run_heap(model, protocol, 3);
  model.threads = 2;
  const Repeat two = run_heap(model, protocol, 3);
  EXPECT_TRUE(test::same_state(*one.state, *two.state));
  EXPECT_EQ(one.envelopes.back().height_m, two.envelopes.back().height_m);
  EXPECT_FALSE(test::same_state(*one.state, *run_heap(model, protocol, 4).state));
}

TEST(Heap, TakesAsManyGrainsAsAskedFor) {
  HeapProtocol protocol = small_tube();
  protocol.grains = 12;
  const Repeat repeat = run_heap(test::soft_bench(), protocol, 1);
  EXPECT_EQ(repeat.readings.at("grains"), 12);
  EXPECT_EQ(repeat.readings.at("no_heap"), 1);
}

TEST(Heap, RefusesMoreGrainsThanFitAndSaysHowManyDo) {
  HeapProtocol protocol = small_tube();
  protocol.tube_height_m = .05;
  protocol.grains = 100000;
  const std::string message = error_of([&] { run_heap(test::soft_bench(), protocol, 1); });
  EXPECT_NE(message.find("heap.grains is 100000"), std::string::npos) << message;
  EXPECT_NE(message.find("at most what fits into the tube, 2"), std::string::npos) << message;
}

TEST(Heap, RefusesMoreGrainsThanAMachineHolds) {
  HeapProtocol protocol = small_tube();
  protocol.grains = 10'000'000;
  const std::string many = error_of([&] { run_heap(test::soft_bench(), protocol, 1); });
  EXPECT_NE(many.find("heap.grains is 10000000. Rule: 1 to 100000"), std::string::npos) << many;
  protocol.grains.reset();
  protocol.tube_diameter_m = protocol.plate_m / 2;
  protocol.tube_height_m = 100;
  protocol.lift_speed_m_s = 1;
  Model dust = test::soft_bench();
  dust.grain = sphere_shape(1e-4);
  const std::string full = error_of([&] { run_heap(dust, protocol, 1); });
  EXPECT_NE(full.find("the tube holds about"), std::string::npos) << full;
}

TEST(Heap, TakesThoseThatFitWhereFewerWillDo) {
  HeapProtocol protocol = small_tube();
  protocol.tube_height_m = .05;
  protocol.grains = 100000;
  protocol.allow_partial_fill = true;
  const double grains = run_heap(test::soft_bench(), protocol, 1).readings.at("grains");
  EXPECT_GT(grains, 2);
  EXPECT_LT(grains, 1000);
}

TEST(Heap, GrainsThatFallOffTheEdgeAreCounted) {
  Model model = test::soft_bench();
  model.grain_wall = {.31, .2, .05};
  model.grain_grain = {.11, .1, .05};
  HeapProtocol protocol = small_tube();
  protocol.plate_m = .08;
  const Repeat repeat = run_heap(model, protocol, 1);
  EXPECT_GT(repeat.readings.at("grains_off_plate"), 0);
  EXPECT_EQ(repeat.readings.at("grains"),
            repeat.readings.at("grains_on_plate") + repeat.readings.at("grains_off_plate"));
}

TEST(Heap, GrainsThatHangInTheTubeAreNoReading) {
  HeapProtocol protocol = small_tube();
  protocol.tube_height_m = .06;
  // With this seed three spheres form an arch and rise with the tube.
  const std::string message =
      error_of<NoMeasurement>([&] { run_heap(test::soft_bench(), protocol, 3); });
  EXPECT_NE(message.find("hang in the tube"), std::string::npos) << message;
}

TEST(Heap, RougherGrainsHeapHigher) {
  Model model = test::soft_bench();
  const Repeat rough = run_heap(model, small_tube(), 1);
  model.grain_wall = {.31, .2, .02};
  model.grain_grain = {.11, .1, .01};
  const Repeat smooth = run_heap(model, small_tube(), 1);
  EXPECT_GT(rough.readings.at("height_mm"), smooth.readings.at("height_mm"));
}

TEST(Heap, MayBeBrokenOff) {
  int reports = 0;
  EXPECT_THROW(run_heap(test::soft_bench(), small_tube(), 1,
                        [&](double fraction, const Simulation&) {
                          EXPECT_GE(fraction, 0);
                          EXPECT_LE(fraction, 1);
                          return ++reports < 5;
                        }),
               Interrupted);
  EXPECT_EQ(reports, 5);
}

TEST(Heap, TellsEveryErrorAtOnce) {
  HeapProtocol protocol;
  protocol.tube_diameter_m = .015;
  protocol.tube_height_m = .01;
  protocol.tube_thickness_m = std::nan("");
  protocol.lift_speed_m_s = 0;
  protocol.plate_m = -1;
  protocol.grains = 0;
  const std::string message = error_of([&] { run_heap(test::soft_bench(), protocol, 1); });
  for (const char* name :
       {"heap.tube_diameter_m is 0.015. Rule: wider than a grain", "heap.tube_height_m",
        "heap.tube_thickness_m", "heap.lift_speed_m_s", "heap.plate_m", "heap.grains"}) {
    EXPECT_NE(message.find(name), std::string::npos) << name << " in:\n" << message;
  }
}

TEST(Heap, RefusesATubeWiderThanThePlate) {
  HeapProtocol protocol;
  protocol.plate_m = .1;
  const std::string message = error_of([&] { run_heap(test::soft_bench(), protocol, 1); });
  EXPECT_NE(message.find("stands on the plate"), std::string::npos) << message;
}

TEST(Heap, RefusesACameraHigherThanItIsFarAway) {
  HeapProtocol protocol;
  protocol.camera_distance_m = 1.2;
  protocol.camera_height_m = 9;
  EXPECT_THAT(error_of([&] { run_heap(test::soft_bench(), protocol, 1); }),
              ::testing::AllOf(::testing::HasSubstr("heap.camera_height_m is 9"),
                               ::testing::HasSubstr("Fix: ")));
}

TEST(Heap, RefusesALiftThatNeverEnds) {
  HeapProtocol protocol;
  protocol.lift_speed_m_s = 1e-6;
  EXPECT_THROW(run_heap(test::soft_bench(), protocol, 1), base::InputError);
}

}  // namespace
}  // namespace repose::dem
