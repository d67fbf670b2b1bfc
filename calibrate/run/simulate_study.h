#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "calibrate/experiment/run_result.h"
#include "dem/study/study.h"

/// One run of an experiment as a study describes it: the work of `repose simulate` for one seed.
namespace repose::calibrate {

struct SimulatedRun {
  RunResult result;
  std::filesystem::path state;  ///< file with its final state; empty: not saved
};

/// Runs it with the study's grains and coefficients.
/// @param folder  stores the run, which is not repeated, and its final state; empty: nothing is
///   saved
/// @throws base::InputError  the study does not describe the experiment, or leaves coefficients to
///   be found that it needs: all of them; or as simulate_experiment().
SimulatedRun simulate_study(const dem::Study& study, std::string_view experiment,
                            std::uint64_t seed, const std::filesystem::path& folder = {});

}  // namespace repose::calibrate
