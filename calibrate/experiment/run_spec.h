#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "calibrate/experiment/heap_angle.h"
#include "calibrate/experiment/simulator.h"
#include "dem/experiment/experiment_table.h"
#include "dem/shape/clump/clump_file.h"
#include "dem/study/study.h"

namespace repose::calibrate {

/// A grain, and the fingerprint that says which one it is.
struct NamedGrain {
  explicit NamedGrain(dem::ClumpFile file);

  dem::ClumpShape shape;
  std::string fingerprint;
  double size = 1;  ///< as a multiple of the grain that it was scaled from
};

/// All that decides over a run but its seed.
struct RunSpec {
  dem::Protocol protocol;
  dem::Model model;  ///< with the grain, and all coefficients that the experiment needs
  std::string grain_fingerprint;
  double grain_size = 1;               ///< NamedGrain::size
  HeapViewing viewing = {.views = 0};  ///< none of experiments that are not pictured
  std::string definition = {};         ///< as RunResult::definition: how it is read, not what it is
  std::shared_ptr<const Simulator> simulator = own_simulator();  ///< that makes it

  const dem::ExperimentEntry& entry() const { return dem::entry_of(protocol); }
};

/// A run of the study's experiment: its protocol, its materials and coefficients. Those that the
/// study leaves open are NaN, to be filled in. Of heaps whose grains do not all fit into the tube,
/// those that do are taken ("grains" among the readings).
/// @throws std::out_of_range  the study does not describe the experiment.
RunSpec spec_of(const dem::Study& study, dem::Experiment experiment, const NamedGrain& grain,
                int views);

/// What a run's key is made from, as JSON: what is simulated, and the version of the simulator, but
/// not for which study. Views are pictures of a run, and not part of it.
std::string description_of(const RunSpec& spec, std::uint64_t seed);

/// Names a run: two with the same key are the same to the last bit, in any study.
std::string key_of(const RunSpec& spec, std::uint64_t seed);

}  // namespace repose::calibrate
