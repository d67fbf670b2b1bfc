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

/// A grain, and the fingerprint that identifies it.
struct NamedGrain {
  explicit NamedGrain(dem::ClumpFile file);

  dem::ClumpShape shape;
  std::string fingerprint;
  double size = 1;  ///< relative to the grain that it was scaled from
};

/// Everything that determines a run except its seed.
struct RunSpec {
  dem::Protocol protocol;
  dem::Model model;  ///< with the grain, and all coefficients that the experiment needs
  std::string grain_fingerprint;
  double grain_size = 1;               ///< NamedGrain::size
  HeapViewing viewing = {.views = 0};  ///< none for experiments that are not pictured
  std::string definition =
      {};  ///< as RunResult::definition: how the run is measured; not part of it
  std::shared_ptr<const Simulator> simulator = own_simulator();  ///< that makes the run

  const dem::ExperimentEntry& entry() const { return dem::entry_of(protocol); }
};

/// A run of the study's experiment: its protocol, its materials and coefficients. Coefficients that
/// the study leaves open are NaN, to be filled in. If a heap's grains do not all fit into the tube,
/// only those that do are used ("grains" among the readings).
/// @throws std::out_of_range  the study does not describe the experiment.
RunSpec spec_of(const dem::Study& study, dem::Experiment experiment, const NamedGrain& grain,
                int views);

/// What a run's key is computed from, as JSON: what is simulated, and the simulator's version, but
/// not the study. Views are pictures of a run, not part of it.
std::string description_of(const RunSpec& spec, std::uint64_t seed);

/// Identifies a run: two runs with the same key are identical to the last bit, in any study.
std::string key_of(const RunSpec& spec, std::uint64_t seed);

}  // namespace repose::calibrate
