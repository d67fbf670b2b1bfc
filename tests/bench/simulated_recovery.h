#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace repose::bench {

struct SimulatedRecovery {
  std::filesystem::path study;           ///< its measurements are replaced
  std::filesystem::path folder;          ///< keeps the runs: started again, it goes on
  std::vector<std::string> experiments;  ///< the only ones that are made; empty: all
  int materials = 20;
  double budget_s = 150;  ///< of one core, for each material
  std::uint64_t seed = 1;
  bool verbose = false;
};

/// Makes up materials, simulates what a bench would measure of each, and calibrates it, all with
/// the engine. A bench's readings scatter by chance in the grains' poses, and by reading them: half
/// a degree, or three of a hundred of a length. Each is of a single grain where a simulated one is
/// the mean of many.
void recover_simulated(const SimulatedRecovery& plan);

}  // namespace repose::bench
