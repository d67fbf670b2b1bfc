// Do heaps of the exported decks for LIGGGHTS or YADE have the same angle as our own? Same clump,
// contact law, coefficients, stiffness and time step; each engine fills the tube in its own way.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "base/distributions.h"
#include "calibrate/experiment/heap_angle.h"
#include "calibrate/export/export.h"
#include "calibrate/statistics/summary.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/heap.h"
#include "dem/study/grain_source.h"
#include "tests/bench/benches.h"
#include "tests/peers/exported.h"

namespace repose::bench {
namespace {

constexpr int kDirections = 18;

struct Heap {
  double angle_deg = 0;
  double height_mm = 0;
  double base_radius_mm = 0;
};

Heap heap_of(const std::vector<dem::Envelope>& envelopes) {
  constexpr double kMm = 1e3;
  const calibrate::PositionAngle angle = calibrate::position_angle(envelopes);
  return {angle.angle_deg.value(), kMm * dem::height_m(envelopes),
          kMm * angle.base_radius_m.value()};
}

/// LIGGGHTS requires prime seeds.
int prime_from(int number) {
  const auto is_prime = [](int n) {
    for (int k = 2; k * k <= n; ++k) {
      if (n % k == 0) return false;
    }
    return true;
  };
  while (!is_prime(number)) ++number;
  return number;
}

/// Rows of x, y, z and radius, after `head` lines and `before` other columns.
std::vector<dem::ClumpSphere> spheres_in(const std::filesystem::path& file, int head, int before) {
  std::ifstream in(file);
  std::string line;
  for (int k = 0; k < head; ++k) std::getline(in, line);
  std::vector<dem::ClumpSphere> spheres;
  while (std::getline(in, line)) {
    std::ranges::replace(line, ',', ' ');
    std::istringstream words(line);
    std::string skipped;
    for (int k = 0; k < before; ++k) words >> skipped;
    dem::ClumpSphere sphere;
    words >> sphere.centre.x() >> sphere.centre.y() >> sphere.centre.z() >> sphere.radius;
    if (sphere.centre.z() > 0) spheres.push_back(sphere);
  }
  return spheres;
}

Heap their_heap(const calibrate::StudyExport& decks, calibrate::ExportTarget target, int number) {
  const testing::TemporaryFolder folder;
  calibrate::write_export(folder.path(), decks.files);
  std::vector<dem::ClumpSphere> spheres;
  if (target == calibrate::yade_target()) {
    testing::run_deck(folder, target, "heap", {std::to_string(number + 1)});
    spheres = spheres_in(folder.path() / "heap.txt", 1, 0);
  } else {
    constexpr int kSmallestSeed = 20000, kApart = 1000, kHead = 9, kIdAndType = 2;
    const std::string seed = std::to_string(prime_from(kSmallestSeed + kApart * number));
    testing::run_deck(folder, target, "heap", {"-var", "seed", seed});
    spheres = spheres_in(folder.path() / "heap.dump", kHead, kIdAndType);
  }
  return heap_of(dem::heap_envelopes(spheres, kDirections));
}

Heap our_heap(const dem::Model& model, const dem::HeapProtocol& protocol, int number) {
  return heap_of(dem::run_heap(model, protocol, static_cast<std::uint64_t>(number) + 1).envelopes);
}

void print_row(const std::string& name, const Heap& heap) {
  fmt::print("{:<12}{:>9.2f}{:>11.1f}{:>13.1f}\n", name, heap.angle_deg, heap.height_mm,
             heap.base_radius_mm);
  std::fflush(stdout);
}

/// Welch's interval for the difference of two means.
void print_difference(const std::vector<double>& ours, const std::vector<double>& theirs,
                      const std::string& program) {
  const calibrate::Summary a = calibrate::summarise(ours), b = calibrate::summarise(theirs);
  const auto mean_variance = [](const calibrate::Summary& of) {
    return base::EstimatedVariance{of.sd.value_or(0) * of.sd.value_or(0) / of.n, of.n - 1.};
  };
  fmt::print("ours {:.2f}, sd {:.2f}; {} {:.2f}, sd {:.2f}, deg\n", a.mean, a.sd.value_or(0),
             program, b.mean, b.sd.value_or(0));
  if (!a.sd || !b.sd) return;
  constexpr double kUpper95 = .975;
  const double t =
      base::student_t_quantile(kUpper95, df_of_sum(mean_variance(a), mean_variance(b)));
  fmt::print("ours less theirs {:+.2f} ± {:.2f} deg (95 %)\n", a.mean - b.mean,
             t * std::sqrt(mean_variance(a).variance + mean_variance(b).variance));
}

struct HeapAgreement {
  std::string study;
  std::vector<std::string> settings = {"contact.rolling_model=\"relative_constant_torque\""};
  std::string program = "liggghts";
  int seeds = 10;
};

void compare_heaps(const HeapAgreement& wanted) {
  const std::string& program = wanted.program;
  const calibrate::ExportTarget target = calibrate::export_target_named(program);
  if (!testing::has_program_for(target)) {
    throw std::invalid_argument(
        fmt::format("{0} is not installed. Fix: apt-get install {0}", program));
  }
  const dem::Study study = dem::read_study(wanted.study, wanted.settings);
  const dem::ClumpShape grain = dem::build_grain(study.grain).shape;
  const calibrate::StudyExport decks =
      calibrate::export_study(study, grain, {}, {.target = target, .takes_approximate = true});
  dem::Model model = dem::model_for(study, dem::experiment_of<dem::HeapProtocol>());
  model.grain = grain;
  std::vector<double> ours, theirs;
  fmt::print("{:<12}{:>9}{:>11}{:>13}\n", "heap", "angle/deg", "height/mm", "base r/mm");
  for (int k = 0; k < wanted.seeds; ++k) {
    const Heap our = our_heap(model, study.protocol<dem::HeapProtocol>(), k);
    print_row("ours", our);
    ours.push_back(our.angle_deg);
    const Heap their = their_heap(decks, target, k);
    print_row(program, their);
    theirs.push_back(their.angle_deg);
  }
  print_difference(ours, theirs, program);
}

}  // namespace

void add_heap_agreement(CLI::App& bench) {
  CLI::App& app = *bench.add_subcommand("heap_agreement",
                                        "Angles of heaps of an exported deck against our own");
  const auto wanted = std::make_shared<HeapAgreement>();
  app.add_option("study", wanted->study, "a study with a heap, all coefficients with a value")
      ->required();
  app.add_option("--set", wanted->settings,
                 "of the study, in place of a rolling model that both have");
  app.add_option("--program", wanted->program)->check(CLI::IsMember({"liggghts", "yade"}));
  app.add_option("--seeds", wanted->seeds, "heaps of each engine")->check(CLI::PositiveNumber);
  app.callback([wanted] { compare_heaps(*wanted); });
}

}  // namespace repose::bench
