#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

#include "dem/experiment/experiment.h"

namespace repose::dem {

/// Time step of a bulk, chosen by how fast its grains are now, not by the fastest they ever become.
///
/// The duration of an impact scales as speed^(-1/5) (Johnson 1985, eq. 11.24): at a tenth of the
/// speed, steps 1.6 times as long are as accurate; that is the longest used. Nor is the step
/// lengthened beyond what the present contacts allow: grains pressed together, in mid-impact or by
/// the weight they carry, store energy that can become speed. A time step set in the model is kept.
/// Proved by AdaptiveTimestep.* in tests/dem/pace_test.cpp.
class AdaptiveTimestep {
 public:
  /// @param usual_speed_m_s  impact speed that bulk_setup()'s time step is for
  AdaptiveTimestep(const Model& model, double usual_speed_m_s);

  /// The step, s, for the next `ahead_s`, during which grains may fall. It is the current step
  /// unless a notably longer one is possible or a shorter one is needed.
  double timestep_s(const Simulation& simulation, double ahead_s);

 private:
  double step_of(int rung);

  bool is_fixed_;
  double fraction_;  ///< of the stable step
  double usual_speed_m_s_;
  SimulationSetup setup_;         ///< without walls
  double usual_step_s_;           ///< accurate_timestep_s() at that speed
  std::map<int, double> step_s_;  ///< for the rungs needed so far
};

/// Number of grains still in the simulation.
int count_present(const Simulation& simulation);

/// Standard deviation of `count` readings whose squared differences from their mean add up to
/// `squares`; std::nullopt for fewer than two.
std::optional<double> scatter_of(double squares, std::size_t count);

/// Receivers of a run's reports and records.
struct Observers {
  const ProgressReport& report;
  const RunRecord& record;
};

/// A simulation going through an experiment: counts its steps, reports and records them.
class ExperimentRun {
 public:
  /// `pace` is for bulks.
  ExperimentRun(Simulation simulation, const Observers& observers,
                std::optional<AdaptiveTimestep> pace = {}, RunProgress progress = {});

  Simulation& simulation() { return simulation_; }
  const Simulation& simulation() const { return simulation_; }
  RunProgress& progress() { return progress_; }
  const RunProgress& progress() const { return progress_; }
  const Observers& observers() const { return observers_; }
  const ClumpShape& shape() const { return simulation_.setup().kinds.front().shape; }

  /// Number of steps for this duration, at least one.
  std::int64_t steps_of(double duration_s) const;
  /// Reports progress when the steps take long. Results do not depend on the observers.
  void advance(std::int64_t steps);
  /// Likewise for a duration, with the time step of the pace, if any.
  void advance_for(double duration_s);
  /// Throws Interrupted if the report cancels the run, after saving a restart point.
  void report_progress(double fraction);

  /// Ends the run: its simulation goes into the result.
  Repeat finish(std::optional<double> value, std::uint64_t seed, Readings readings);

 private:
  std::int64_t next_frame_step() const;
  void look() const;

  Simulation simulation_;
  Observers observers_;
  std::optional<AdaptiveTimestep> pace_;
  RunProgress progress_;
  double fraction_ = 0;  ///< last reported
};

}  // namespace repose::dem
