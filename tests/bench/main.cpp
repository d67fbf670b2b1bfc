// Measures repose's accuracy and speed, and draws heaps: see `bench --help`.

#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <benchmark/benchmark.h>
#include <fmt/core.h>

#include "base/freed_memory.h"
#include "tests/bench/benches.h"

namespace repose::bench {
namespace {

/// The Google Benchmark timings: *_speed.cpp.
void add_speed(CLI::App& bench) {
  CLI::App& app = *bench.add_subcommand(
      "speed", "Of single parts, by Google Benchmark: its options, as --benchmark_filter=clumps");
  app.prefix_command();
  app.callback([&app] {
    // One core, as in the target numbers; the OpenGL driver reads this at start-up.
    ::setenv("LP_NUM_THREADS", "0", 0);
    std::vector<std::string> words = app.remaining();
    words.insert(words.begin(), app.get_name());
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    auto count = static_cast<int>(pointers.size());
    benchmark::Initialize(&count, pointers.data());
    if (benchmark::ReportUnrecognizedArguments(count, pointers.data())) {
      throw CLI::ValidationError("speed",
                                 "unknown options. Fix: bench speed --benchmark_list_tests");
    }
    benchmark::RunSpecifiedBenchmarks();
  });
}

}  // namespace
}  // namespace repose::bench

int main(int argc, char** argv) {
  using namespace repose::bench;
  repose::base::disable_heap_trimming();  // as the program does
  CLI::App bench("How near repose comes, and how fast");
  bench.require_subcommand(1);
  add_draw_heap(bench);
  add_photo_accuracy(bench);
  add_film_accuracy(bench);
  add_board_accuracy(bench);
  add_track_accuracy(bench);
  add_recovery(bench);
  add_scan_accuracy(bench);
  add_soak(bench);
  add_speed(bench);
  add_against_liggghts(bench);
  add_heap_agreement(bench);
  add_heap_fidelity(bench);
  try {
    bench.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& error) {
    return bench.exit(error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "bench: {}\n", error.what());
    return 2;
  }
}
