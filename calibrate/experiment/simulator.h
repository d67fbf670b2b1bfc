#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_table.h"

namespace repose::calibrate {

struct RunSpec;

/// A run to be made.
struct RunCall {
  const RunSpec& spec;
  std::uint64_t seed = 0;
  /// The run's own folder, for files that another program reads and writes; empty: a temporary one.
  std::filesystem::path folder = {};
  std::function<bool(double fraction)> goes_on;  ///< false interrupts it
  /// Only if the simulator can_resume(): receives its intermediate results, and where it resumes
  /// from.
  const dem::RunRecord& record;
  const dem::Restart* from = nullptr;
};

/// Makes runs of experiments: our own engine, or another program (calibrate/simulators). Stores,
/// pictures and the fit are the same for all simulators.
class Simulator {
 public:
  Simulator() = default;
  virtual ~Simulator() = default;
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;
  Simulator(Simulator&&) = delete;
  Simulator& operator=(Simulator&&) = delete;

  /// For display: "LIGGGHTS-PUBLIC 3.8.0, 2 processes". Empty: our own engine.
  virtual std::string title() const { return {}; }
  /// What its runs depend on besides spec and seed, as JSON; runs of other simulators never count
  /// as its own. Empty: our own engine, whose version is in every run.
  virtual std::string identity(const RunSpec& /*spec*/) const { return {}; }
  /// Cores that a run occupies.
  virtual int processes(const dem::ExperimentEntry& /*entry*/) const { return 1; }
  /// Whether it can resume interrupted runs, and records films.
  virtual bool can_resume() const { return true; }
  /// Whether a run ends with a state that can be viewed.
  virtual bool has_state(const dem::ExperimentEntry& /*entry*/) const { return true; }
  /// Whether a run has this reading, besides its value.
  virtual bool has_reading(const dem::ExperimentEntry& /*entry*/,
                           const std::string& /*name*/) const {
    return true;
  }
  /// The parts of a spec that it cannot simulate.
  virtual std::vector<base::Fault> refusals(const RunSpec& /*spec*/) const { return {}; }
  /// How its runs differ from ours, a sentence each.
  virtual std::vector<std::string> differences(const RunSpec& /*spec*/) const { return {}; }

  /// @throws dem::NoMeasurement, dem::UnstableRun, dem::Interrupted, base::InputError  as
  ///   experiments in dem/experiment.
  virtual dem::Repeat run(const RunCall& call) const = 0;
};

std::shared_ptr<const Simulator> own_simulator();

}  // namespace repose::calibrate
