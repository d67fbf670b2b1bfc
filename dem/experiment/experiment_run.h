#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "dem/experiment/experiment.h"
#include "dem/experiment/pace.h"

namespace repose::dem {

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
  ExperimentRun(Simulation simulation, const Observers& observers, std::optional<Pace> pace = {},
                HeapProgress progress = {});

  Simulation& simulation() { return simulation_; }
  const Simulation& simulation() const { return simulation_; }
  HeapProgress& progress() { return progress_; }
  const HeapProgress& progress() const { return progress_; }
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
  std::optional<Pace> pace_;
  HeapProgress progress_;
  double fraction_ = 0;  ///< as last told
};

}  // namespace repose::dem
