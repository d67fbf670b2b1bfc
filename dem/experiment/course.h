#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "dem/experiment/experiment.h"

namespace repose::dem {

/// What a run has cost so far.
struct Work {
  std::int64_t steps = 0;
  double clump_steps = 0;
};

/// A simulation on its way through an experiment: counts its steps and reports them.
class Course {
 public:
  Course(Simulation simulation, const ProgressReport& report, Work before = {});

  Simulation& simulation() { return simulation_; }
  const Simulation& simulation() const { return simulation_; }
  const Work& work() const { return work_; }
  const ClumpShape& shape() const { return simulation_.setup().kinds.front().shape; }

  /// Steps that take this long, at least one.
  std::int64_t steps_of(double duration_s) const;
  void advance(std::int64_t steps);
  /// Throws Interrupted when the report asks for it.
  void tell(double share) const;

  /// Ends the course: its simulation goes into the result.
  Repeat finish(double value, std::uint64_t seed, std::map<std::string, double> readings);

 private:
  Simulation simulation_;
  const ProgressReport& report_;
  Work work_;
};

}  // namespace repose::dem
