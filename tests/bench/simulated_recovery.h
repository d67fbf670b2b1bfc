#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace repose::bench {

struct SimulatedRecovery {
  std::filesystem::path study;           ///< its measurements are replaced
  std::filesystem::path folder;          ///< keeps the runs: a restart resumes from them
  std::vector<std::string> experiments;  ///< run only these; empty: all
  std::vector<std::string> settings;     ///< "key.path=value" of the study, at bench and in the fit
  /// The same for the bench alone: properties of the real grains that the study does not know, e.g.
  /// another rolling friction model, more spheres, grains of several sizes.
  std::vector<std::string> bench_settings;
  std::optional<int> readings;  ///< of each experiment; std::nullopt: 8, or 30 of single grains
  int materials = 20;
  double budget_s = 150;  ///< of one core, for each material
  std::uint64_t seed = 1;
  std::optional<double> coarse_size = {};  ///< of grains in cheaper heaps; std::nullopt: none
  std::optional<double> heap_s = {};       ///< assumed time of a heap of the study's own grains
  bool verbose = false;
};

/// Makes up materials, simulates what a bench would measure for each, and calibrates it, all with
/// the engine. The bench readings scatter by the grains' random poses and by reading errors: half a
/// degree, or 3 % of a length. Each is of a single grain, whereas a simulated one is the mean of
/// many. If `readings` is set, widths are compared with those predicted by a plan.
void recover_simulated(const SimulatedRecovery& plan);

}  // namespace repose::bench
