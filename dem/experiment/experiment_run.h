#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

#include "dem/experiment/experiment.h"

namespace repose::dem {

/// How long the steps of a bulk may be: by how fast its grains are now, not by the fastest that
/// they ever become.
///
/// An impact lasts as speed^(-1/5) (Johnson 1985, eq. 11.24): grains at a tenth of the speed are as
/// accurate in steps 1.6 times as long, and none is longer. Nor is it made longer than the contacts
/// there are allow: where grains press on each other they have speed in store, in the middle of an
/// impact or by the weight of what they carry. A time step that the model asks for stays. Proved by
/// AdaptiveTimestep.* in tests/dem/pace_test.cpp.
class AdaptiveTimestep {
 public:
  /// @param usual_speed_m_s  of the impacts that bulk_setup()'s time step is for
  AdaptiveTimestep(const Model& model, double usual_speed_m_s);

  /// The step, s, of the next `ahead_s`, in which grains may fall. It is the step there is, unless
  /// another one is a good deal longer or must be shorter.
  double timestep_s(const Simulation& simulation, double ahead_s);

 private:
  double step_of(int rung);

  bool is_fixed_;
  double fraction_;  ///< of what is stable
  double usual_speed_m_s_;
  SimulationSetup setup_;         ///< without walls
  double usual_step_s_;           ///< the longest accurate one at that speed
  std::map<int, double> step_s_;  ///< of the rungs that were needed so far
};

/// Grains that are still in the simulation.
int count_present(const Simulation& simulation);

/// Standard deviation of `count` readings whose squared differences from their mean add up to
/// `squares`; none of a single one.
std::optional<double> scatter_of(double squares, std::size_t count);

/// Who is told what on the way.
struct Observers {
  const ProgressReport& report;
  const RunRecord& record;
};

/// A simulation on its way through an experiment: counts its steps, reports and records them.
class ExperimentRun {
 public:
  /// `pace`: of bulks.
  ExperimentRun(Simulation simulation, const Observers& observers,
                std::optional<AdaptiveTimestep> pace = {}, RunProgress progress = {});

  Simulation& simulation() { return simulation_; }
  const Simulation& simulation() const { return simulation_; }
  RunProgress& progress() { return progress_; }
  const RunProgress& progress() const { return progress_; }
  const Observers& observers() const { return observers_; }
  const ClumpShape& shape() const { return simulation_.setup().kinds.front().shape; }

  /// Steps that take this long, at least one.
  std::int64_t steps_of(double duration_s) const;
  /// Reports by itself when the steps take long. The bytes do not depend on who watches.
  void advance(std::int64_t steps);
  /// Likewise for so long, in steps of the pace.
  void advance_for(double duration_s);
  /// Throws Interrupted when the report asks for it, with a restart point kept.
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
  double fraction_ = 0;  ///< as last told
};

}  // namespace repose::dem
