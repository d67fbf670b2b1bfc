#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "tests/bench/benches.h"
#include "tests/bench/heap_race.h"
#include "tests/bench/liggghts_race.h"
#include "tests/bench/median.h"
#include "tests/bench/own_speed.h"
#include "tests/peers/liggghts.h"

namespace repose::bench {
namespace {

/// Grain steps per second of each run, by wall clock and by CPU time.
struct Rates {
  std::vector<double> elapsed;
  std::vector<double> cpu;

  void add(double grain_steps, const Timing& timing) {
    elapsed.push_back(grain_steps / timing.elapsed_s);
    cpu.push_back(grain_steps / timing.cpu_s);
  }
};

void print_row(const std::string& name, const testing::TemporaryFolder& folder, Packing packing,
               double skin_m, int rounds) {
  const std::size_t grains = packing.grains.size();
  const double grain_steps = static_cast<double>(grains) * static_cast<double>(packing.steps);
  Race race(folder, std::move(packing), skin_m);
  Rates ours;
  Rates theirs;
  for (int round = 0; round < rounds; ++round) {
    ours.add(grain_steps, race.time_ours());
    theirs.add(grain_steps, race.time_theirs());
  }
  constexpr double kMillion = 1e6;
  fmt::print("{:<10}{:>8}{:>9.2f}{:>9.2f}", name, grains, race.our_contacts(),
             race.their_contacts());
  for (const auto& [our, their] :
       {std::pair(ours.elapsed, theirs.elapsed), std::pair(ours.cpu, theirs.cpu)}) {
    fmt::print("{:>9.3f}{:>9.3f}{:>7.2f}", median(our) / kMillion, median(their) / kMillion,
               median(our) / median(their));
  }
  fmt::print("\n");
  std::fflush(stdout);
}

void print_single_grains(int rounds) {
  for (const char* experiment : {"drop", "tilt", "roll"}) {
    fmt::print("the sample's {} at full stiffness: {:.3f} CPU s\n", experiment,
               median(single_grain_times(experiment, rounds)));
    std::fflush(stdout);
  }
}

void print_many_clumps(int many, int rounds) {
  const Growth growth = clump_step_growth(many, rounds);
  const double few_ns = median(growth.few.times_ns);
  const double many_ns = median(growth.many.times_ns);
  fmt::print(
      "a clump-step: {:.0f} CPU ns of 500 clumps ({:.2f} contacts each), {:.0f} of {} ({:.2f}), "
      "{:.2f} times as long\n",
      few_ns, growth.few.contacts, many_ns, many, growth.many.contacts, many_ns / few_ns);
  fmt::print("two threads against one, {} clumps: {:.2f} times as fast by the clock\n", many,
             median(two_thread_gains(many, rounds)));
  std::fflush(stdout);
}

void print_heap(const std::vector<std::string>& settings, int rounds) {
  const HeapTimes times = race_heaps(settings, rounds);
  const double ours_s = median(times.ours_s);
  fmt::print("the sample's heap, {} clumps, fill to angle: {:.1f} CPU s", times.grains, ours_s);
  if (!times.theirs_s.empty()) {
    const double theirs_s = median(times.theirs_s);
    fmt::print("; LIGGGHTS {:.1f}, {:.2f} times as long", theirs_s, theirs_s / ours_s);
  }
  fmt::print("\nits silhouettes and angles of 18 views: {:.1f} CPU s, {:.1f} % of its simulation\n",
             median(times.views_s), 100 * median(times.views_s) / ours_s);
}

struct RaceSettings {
  std::vector<int> spheres = {500, 5000};
  std::vector<int> clumps = {500};
  int rounds = 3;
  double skin_mm = .3;
  int many_clumps = 0;
  int heaps = 0;
  std::vector<std::string> settings;
};

void race_packings(const RaceSettings& race) {
  fmt::print(
      "{0:28}contacts a grain  million grain-steps/s     per CPU second\n"
      "{1:<10}{2:>8}     ours   theirs     ours   theirs  ratio     ours   theirs  ratio\n",
      "", "packing", "grains");
  const double skin_m = race.skin_mm / 1000;
  for (const int count : race.clumps) {
    const testing::TemporaryFolder folder;
    if (count > 0) print_row("clumps", folder, settled_clumps(folder, count), skin_m, race.rounds);
  }
  for (const int count : race.spheres) {
    const testing::TemporaryFolder folder;
    if (count > 0)
      print_row("spheres", folder, settled_spheres(folder, count), skin_m, race.rounds);
  }
}

void race_all(const RaceSettings& race) {
  print_single_grains(race.rounds);
  if (race.many_clumps > 0) print_many_clumps(race.many_clumps, race.rounds);
  if (race.heaps > 0) print_heap(race.settings, race.heaps);
  if (testing::has_liggghts()) {
    race_packings(race);
  } else {
    fmt::print("{}\n", testing::kNoLiggghts);
  }
}

}  // namespace

void add_against_liggghts(CLI::App& bench) {
  CLI::App& app = *bench.add_subcommand(
      "against_liggghts",
      "Speed of LIGGGHTS and of repose on the same packings, one core each, turn about; and of\n"
      "repose alone. Boxes of more than 10,000 spheres, and of many clumps, are mirrored from a\n"
      "ninth of them, wide and as deep as that. Everything takes an hour or more:\n"
      "  bench against_liggghts --spheres 500,5000,50000 --many-clumps 50000 --heaps 5 --rounds 5");
  const auto race = std::make_shared<RaceSettings>();
  app.add_option("--spheres", race->spheres, "Spheres in each box (50000 takes minutes); 0: none")
      ->delimiter(',');
  app.add_option("--clumps", race->clumps, "Clumps of 11 spheres in each tube; 0: none")
      ->delimiter(',');
  app.add_option("--rounds", race->rounds, "Runs of each engine")->check(CLI::Range(1, 1000));
  app.add_option("--skin-mm", race->skin_mm,
                 "How far LIGGGHTS lists neighbours; for clumps at rest .3 is faster than more");
  app.add_option("--many-clumps", race->many_clumps,
                 "Clumps in a box: what a step costs against 500 of them, and two threads against "
                 "one; 0: none");
  app.add_option("--heaps", race->heaps, "Heaps of the sample in each engine; 0: none");
  app.add_option("--set", race->settings, "Of the heap's study, as experiment.heap.grains=100");
  app.callback([race] { race_all(*race); });
}

}  // namespace repose::bench
