
#include <benchmark/benchmark.h>

#include "tests/bench/clock.h"
#include "tests/bench/packing.h"

// Counter `clump_steps_per_s`: grains times steps, of packings at rest. `--benchmark_filter=clumps`
// leaves out the large boxes of spheres, which take minutes to pour.

namespace repose::bench {
namespace {

void run_settled(benchmark::State& state, dem::Simulation simulation) {
  const int grains = simulation.grain_count();
  const auto steps = std::max<std::int64_t>(5, 400000 / grains);
  while (state.KeepRunning()) simulation.advance(steps);
  state.counters["clump_steps_per_s"] =
      benchmark::Counter(static_cast<double>(grains) * static_cast<double>(steps),
                         benchmark::Counter::kIsIterationInvariantRate);
  state.counters["contacts_a_grain"] =
      static_cast<double>(simulation.contacts().size()) / static_cast<double>(grains);
}

void clumps(benchmark::State& state) {
  run_settled(state, testing::tube_of_clumps(static_cast<int>(state.range(0)),
                                             static_cast<int>(state.range(1))));
}

void spheres(benchmark::State& state) {
  run_settled(state, testing::box_of_spheres(static_cast<int>(state.range(0)),
                                             static_cast<int>(state.range(1))));
}

/// Counter `speed_up`: one thread's time / two threads' time on the same packing, run alternately.
void two_threads(benchmark::State& state) {
  const auto grains = static_cast<int>(state.range(0));
  auto one = testing::box_of_spheres(grains, 1);
  auto two = testing::box_of_spheres(grains, 2);
  const auto steps = std::max<std::int64_t>(5, 400000 / grains);
  double one_s = 0;
  double two_s = 0;
  while (state.KeepRunning()) {
    auto start = Clock::now();
    one.advance(steps);
    one_s += seconds_since(start);
    start = Clock::now();
    two.advance(steps);
    const double now_s = seconds_since(start);
    two_s += now_s;
    state.SetIterationTime(now_s);
  }
  state.counters["speed_up"] = one_s / two_s;
}

BENCHMARK(clumps)->Args({500, 1})->Args({500, 2})->ArgNames({"grains", "threads"})->UseRealTime();
BENCHMARK(spheres)
    ->Args({500, 1})
    ->Args({5000, 1})
    ->Args({50000, 1})
    ->ArgNames({"grains", "threads"})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(two_threads)
    ->Arg(5000)
    ->ArgNames({"grains"})
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace repose::bench
