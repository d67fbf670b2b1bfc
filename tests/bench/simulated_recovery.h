#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace repose::bench {

struct SimulatedRecovery {
  std::filesystem::path study;           ///< its measurements are replaced
  std::filesystem::path folder;          ///< keeps the runs: started again, it goes on
  std::vector<std::string> experiments;  ///< the only ones that are made; empty: all
  std::vector<std::string> settings;     ///< "key.path=value" of the study, at bench and in the fit
  /// The same of the bench alone: what the real grains have and the study does not know of, as
  /// another law of rolling friction, more spheres, grains of several sizes.
  std::vector<std::string> bench_settings;
  std::optional<int> readings;  ///< of each experiment; none: 8, or 30 single grains
  int materials = 20;
  double budget_s = 150;  ///< of one core, for each material
  std::uint64_t seed = 1;
  std::optional<double> coarse_size = {};  ///< of grains in cheaper heaps; none: all are full
  std::optional<double> heap_s = {};       ///< that a made-up heap of the study's grains takes
  bool verbose = false;
};

/// Makes up materials, simulates what a bench would measure of each, and calibrates it, all with
/// the engine. A bench's readings scatter by chance in the grains' poses, and by reading them: half
/// a degree, or three of a hundred of a length. Each is of a single grain where a simulated one is
/// the mean of many. Widths are held against those that a plan foresees where `readings` are set.
void recover_simulated(const SimulatedRecovery& plan);

}  // namespace repose::bench
