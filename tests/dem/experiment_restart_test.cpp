#include <map>
#include <vector>

#include <gmock/gmock.h>

#include "dem/experiment/heap.h"
#include "dem/experiment/roll.h"
#include "dem/state/state_file.h"
#include "tests/dem/experiment_model.h"

namespace repose::dem {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;

/// With soft spheres, makes a heap within a second.
HeapProtocol tube_on_small_plate() {
  HeapProtocol protocol;
  protocol.tube_diameter_m = .07;
  protocol.tube_height_m = .1;
  protocol.lift_speed_m_s = .1;
  protocol.plate_m = .1;  // some fall off
  return protocol;
}

std::string bits_of_end(const Repeat& repeat) { return state_text(*repeat.state, "{}"); }

/// Some restart points of each stage, as a file would store them.
std::map<int, std::vector<Restart>> restart_points(Repeat& whole) {
  std::map<int, std::vector<Restart>> points;
  int looks = 0;
  RunRecord record;
  record.is_restart_due = [&] { return ++looks % 7 == 0; };
  record.save_restart = [&](const Simulation& simulation, const RunProgress& progress) {
    points[progress.stage].push_back({simulation.setup(), simulation.checkpoint(), progress});
  };
  whole = run_heap(test::soft_bench(), tube_on_small_plate(), 1, {}, record);
  return points;
}

TEST(HeapRestart, GoesOnToTheSameBytesFromEveryStage) {
  Repeat whole;
  const auto points = restart_points(whole);
  for (const int stage :
       {HeapStage::rain, HeapStage::settle_in_tube, HeapStage::lift, HeapStage::settle}) {
    ASSERT_TRUE(points.contains(stage)) << "stage " << static_cast<int>(stage);
    const std::vector<Restart>& of_stage = points.at(stage);
    Model model = test::soft_bench();
    model.threads = stage == HeapStage::lift ? 2 : 1;
    const Repeat resumed =
        resume_heap(model, tube_on_small_plate(), 1, of_stage.at(of_stage.size() / 2));
    EXPECT_EQ(bits_of_end(resumed), bits_of_end(whole)) << "stage " << static_cast<int>(stage);
    EXPECT_EQ(resumed.envelopes.back().height_m, whole.envelopes.back().height_m);
    EXPECT_EQ(resumed.readings, whole.readings);
    EXPECT_EQ(resumed.steps, whole.steps);
    EXPECT_EQ(resumed.clump_steps, whole.clump_steps);
  }
}

TEST(HeapRestart, GoesOnFromWithinALongStretch) {
  // So many grain steps lie between two checks that some restart points fall within a stretch.
  Model model = test::soft_bench();
  model.stiffness_factor = .05;
  Repeat whole;
  RunRecord record;
  std::vector<Restart> within;
  record.is_restart_due = [] { return true; };
  record.save_restart = [&](const Simulation& simulation, const RunProgress& progress) {
    if (progress.steps_left > 0) {
      within.push_back({simulation.setup(), simulation.checkpoint(), progress});
    }
  };
  whole = run_heap(model, tube_on_small_plate(), 1, {}, record);
  ASSERT_THAT(within, Not(IsEmpty()));
  EXPECT_EQ(bits_of_end(resume_heap(model, tube_on_small_plate(), 1, within.front())),
            bits_of_end(whole));
}

TEST(HeapRestart, IsKeptWhenTheRunIsBrokenOff) {
  int saved = 0;
  RunRecord record;
  record.save_restart = [&](const Simulation&, const RunProgress&) { ++saved; };
  EXPECT_THROW(run_heap(
                   test::soft_bench(), tube_on_small_plate(), 1,
                   [](double, const Simulation&) { return false; }, record),
               Interrupted);
  EXPECT_EQ(saved, 1);
}

/// Frame times of a run, separately for each of its simulations.
struct Frames {
  std::vector<std::vector<double>> times_s;

  RunRecord record(double interval_s) {
    RunRecord record;
    record.frame_interval_s = interval_s;
    record.frame = [this](const Simulation& simulation) {
      if (simulation.step() == 0) times_s.emplace_back();
      times_s.back().push_back(simulation.time_s());
    };
    return record;
  }
};

TEST(Frames, AreTakenAtTheFirstStepAtTheirTimes) {
  Frames frames;
  // Shorter than the time between two reports, and not a multiple of the time step.
  const double interval_s = 1.2345e-3;
  const Repeat repeat =
      run_heap(test::soft_bench(), tube_on_small_plate(), 1, {}, frames.record(interval_s));
  ASSERT_EQ(frames.times_s.size(), 2U) << "filling, then lift and settling";
  for (const auto& times_s : frames.times_s) {
    ASSERT_GT(times_s.size(), 100U);
    for (std::size_t k = 0; k < times_s.size(); ++k) {
      // Time steps of grains at rest are up to 1.6 times as long as the shortest.
      const double late_s = times_s[k] - static_cast<double>(k) * interval_s;
      EXPECT_GE(late_s, -1e-6 * repeat.timestep_s);
      EXPECT_LE(late_s, 1.7 * repeat.timestep_s);
    }
  }
  EXPECT_NEAR(repeat.readings.at("time_s"), frames.times_s[1].back(), interval_s);
}

TEST(Frames, DoNotShowInTheResult) {
  Frames frames;
  const RollProtocol roll{.release_m = .02};
  const Repeat watched = run_roll(test::soft_bench(), roll, 1, {}, frames.record(1e-9));
  const Repeat alone = run_roll(test::soft_bench(), roll, 1);
  EXPECT_EQ(bits_of_end(watched), bits_of_end(alone));
  EXPECT_EQ(watched.steps, alone.steps);
  ASSERT_EQ(frames.times_s.size(), 1U);
  EXPECT_EQ(frames.times_s[0].size(), static_cast<std::size_t>(alone.steps) + 1)
      << "shorter than a step: every step, once";
}

}  // namespace
}  // namespace repose::dem
