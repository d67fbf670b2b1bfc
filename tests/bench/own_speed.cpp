#include "tests/bench/own_speed.h"

#include <algorithm>

#include "dem/experiment/drop.h"
#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt.h"
#include "dem/study/grain_source.h"
#include "dem/study/study.h"
#include "tests/bench/clock.h"
#include "tests/bench/packing.h"
#include "tests/support/places.h"

namespace repose::bench {
namespace {

constexpr int kFew = 500;
constexpr double kOwnStepsARun = 2e6;

std::int64_t steps_for(int clumps) {
  return std::max<std::int64_t>(5, static_cast<std::int64_t>(kOwnStepsARun) / clumps);
}

double clump_step_ns(dem::Simulation& simulation) {
  const std::int64_t steps = steps_for(simulation.grain_count());
  const double start = cpu_s();
  simulation.advance(steps);
  return 1e9 * (cpu_s() - start) / static_cast<double>(steps * simulation.grain_count());
}

/// Each contact is between two clumps, or between a clump and a wall.
double contacts_a_clump(const dem::Simulation& simulation) {
  return static_cast<double>(simulation.contacts().size()) /
         static_cast<double>(simulation.grain_count());
}

double elapsed_s(dem::Simulation& simulation) {
  const auto start = Clock::now();
  simulation.advance(steps_for(simulation.grain_count()));
  return seconds_since(start);
}

}  // namespace

std::vector<double> single_grain_times(const std::string& experiment, int rounds) {
  const dem::Study study =
      dem::read_study(testing::source_folder() / "samples/hazelnut/study.toml", {});
  const dem::ClumpShape grain = dem::build_grain(study.grain).shape;
  const auto model = [&](dem::Experiment of) {
    dem::Model all = dem::model_for(study, of);
    all.grain = grain;
    return all;
  };
  std::vector<double> times;
  for (int round = 0; round < rounds; ++round) {
    const auto seed = static_cast<std::uint64_t>(round) + 1;
    const double start = cpu_s();
    if (experiment == "drop") {
      dem::run_drop(model(dem::experiment_of<dem::DropProtocol>()),
                    study.protocol<dem::DropProtocol>(), seed);
    } else if (experiment == "tilt") {
      dem::run_tilt(model(dem::experiment_of<dem::TiltProtocol>()),
                    study.protocol<dem::TiltProtocol>(), seed);
    } else {
      dem::run_roll(model(dem::experiment_of<dem::RollProtocol>()),
                    study.protocol<dem::RollProtocol>(), seed);
    }
    times.push_back(cpu_s() - start);
  }
  return times;
}

Growth clump_step_growth(int many, int rounds) {
  dem::Simulation few = testing::box_of_clumps(kFew, 1);
  dem::Simulation wide = testing::wide_box_of_clumps(many, 1);
  few.advance(kFew);
  wide.advance(kFew);
  Growth growth = {.few = {{}, contacts_a_clump(few)}, .many = {{}, contacts_a_clump(wide)}};
  for (int round = 0; round < rounds; ++round) {
    growth.few.times_ns.push_back(clump_step_ns(few));
    growth.many.times_ns.push_back(clump_step_ns(wide));
  }
  return growth;
}

std::vector<double> two_thread_gains(int clumps, int rounds) {
  dem::Simulation one = testing::wide_box_of_clumps(clumps, 1);
  dem::SimulationSetup setup = one.setup();
  setup.threads = 2;
  one.advance(kFew);
  dem::Simulation two(setup, one.checkpoint());
  std::vector<double> gains;
  for (int round = 0; round < rounds; ++round) {
    const double alone = elapsed_s(one);
    gains.push_back(alone / elapsed_s(two));
  }
  return gains;
}

}  // namespace repose::bench
