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

/// A run that is to be made.
struct RunCall {
  const RunSpec& spec;
  std::uint64_t seed = 0;
  /// Its own, for what another program reads and writes meanwhile; empty: a temporary one.
  std::filesystem::path folder = {};
  std::function<bool(double fraction)> goes_on;  ///< false interrupts it
  /// Of one that can_resume() only: what it hands out on its way, and where it goes on from.
  const dem::RunRecord& record;
  const dem::Restart* from = nullptr;
};

/// What makes runs of experiments: our own engine, or another program (calibrate/simulators). All
/// else is the same for all of them: stores, pictures, the fit.
class Simulator {
 public:
  Simulator() = default;
  virtual ~Simulator() = default;
  Simulator(const Simulator&) = delete;
  Simulator& operator=(const Simulator&) = delete;
  Simulator(Simulator&&) = delete;
  Simulator& operator=(Simulator&&) = delete;

  /// For people: "LIGGGHTS-PUBLIC 3.8.0, 2 processes". Empty: our own engine.
  virtual std::string title() const { return {}; }
  /// What its runs depend on beside spec and seed, as JSON; runs of other simulators are never
  /// taken for its own. Empty: our own engine, whose version every run has.
  virtual std::string identity(const RunSpec& /*spec*/) const { return {}; }
  /// Cores that a run occupies.
  virtual int processes(const dem::ExperimentEntry& /*entry*/) const { return 1; }
  /// It can go on from where it was interrupted, and hands out films.
  virtual bool can_resume() const { return true; }
  /// What a run ends with is a state, to look at.
  virtual bool has_state(const dem::ExperimentEntry& /*entry*/) const { return true; }
  /// A run has this reading, beside its value.
  virtual bool has_reading(const dem::ExperimentEntry& /*entry*/,
                           const std::string& /*name*/) const {
    return true;
  }
  /// What it cannot simulate.
  virtual std::vector<base::Fault> refusals(const RunSpec& /*spec*/) const { return {}; }
  /// What its runs do otherwise than ours, a sentence each.
  virtual std::vector<std::string> differences(const RunSpec& /*spec*/) const { return {}; }

  /// @throws dem::NoMeasurement, dem::UnstableRun, dem::Interrupted, base::InputError  as the
  /// experiments of dem/experiment.
  virtual dem::Repeat run(const RunCall& call) const = 0;
};

std::shared_ptr<const Simulator> own_simulator();

}  // namespace repose::calibrate
