#include <algorithm>
#include <exception>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "tests/bench/liggghts_race.h"
#include "tests/peers/liggghts.h"

namespace {

using repose::bench::Packing;
using repose::bench::Race;
using repose::bench::settled_clumps;
using repose::bench::settled_spheres;
using repose::bench::Timing;

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Grain steps a second, of each run: by the clock and by CPU time.
struct Rates {
  std::vector<double> elapsed;
  std::vector<double> cpu;

  void add(double grain_steps, const Timing& timing) {
    elapsed.push_back(grain_steps / timing.elapsed_s);
    cpu.push_back(grain_steps / timing.cpu_s);
  }
};

void print_row(const std::string& name, const repose::testing::TemporaryFolder& folder,
               Packing packing, double skin_m, int rounds) {
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

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Speed of LIGGGHTS and of repose on the same packings, one core each, turn about. Boxes of\n"
      "more than 10,000 spheres are mirrored from a ninth of them, wide and as deep as that.");
  std::vector<int> spheres = {500, 5000};
  std::vector<int> clumps = {500};
  int rounds = 3;
  double skin_mm = .3;
  app.add_option("--spheres", spheres, "Spheres in each box (50000 takes minutes); 0: none")
      ->delimiter(',');
  app.add_option("--clumps", clumps, "Clumps of 11 spheres in each tube; 0: none")->delimiter(',');
  app.add_option("--rounds", rounds, "Runs of each engine")->check(CLI::Range(1, 1000));
  app.add_option("--skin-mm", skin_mm,
                 "How far LIGGGHTS lists neighbours; for clumps at rest .3 is faster than more");
  CLI11_PARSE(app, argc, argv);
  if (!repose::testing::has_liggghts()) {
    fmt::print("{}\n", repose::testing::kNoLiggghts);
    return 0;
  }
  try {
    fmt::print(
        "{0:28}contacts a grain  million grain-steps/s     per CPU second\n"
        "{1:<10}{2:>8}     ours   theirs     ours   theirs  ratio     ours   theirs  ratio\n",
        "", "packing", "grains");
    const double skin_m = skin_mm / 1000;
    for (const int count : clumps) {
      const repose::testing::TemporaryFolder folder;
      if (count > 0) print_row("clumps", folder, settled_clumps(folder, count), skin_m, rounds);
    }
    for (const int count : spheres) {
      const repose::testing::TemporaryFolder folder;
      if (count > 0) print_row("spheres", folder, settled_spheres(folder, count), skin_m, rounds);
    }
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "against_liggghts: {}\n", error.what());
    return 2;
  }
}
