#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "dem/engine/simulation.h"
#include "tests/support/temporary_folder.h"

namespace repose::bench {

/// One packing at rest for both engines: the same grains at the same places, the same materials,
/// walls, contact model, rolling friction (LIGGGHTS's) and time step.
struct Packing {
  dem::SimulationSetup setup;
  std::vector<dem::Grain> grains;
  std::string start;       ///< command that makes LIGGGHTS read it
  std::string integrator;  ///< LIGGGHTS's
  std::int64_t steps = 0;  ///< of a timed run, which takes a few seconds
};

/// Spheres poured by repose. Writes LIGGGHTS's file into `folder`.
Packing settled_spheres(const testing::TemporaryFolder& folder, int grains);

/// Clumps poured by LIGGGHTS, because it cannot read clumps in given poses. Throws
/// std::runtime_error if it does not insert all of them.
Packing settled_clumps(const testing::TemporaryFolder& folder, int grains);

/// Time taken by a run.
struct Timing {
  double elapsed_s = 0;
  double cpu_s = 0;
};

/// Runs the same steps repeatedly, in either engine, on one core.
///
/// Tangential springs are not transferred: each engine first builds up its own, and every timed run
/// starts from the resulting state.
class Race {
 public:
  /// `skin_m` is the gap up to which LIGGGHTS lists neighbours.
  Race(const testing::TemporaryFolder& folder, Packing packing, double skin_m);

  Timing time_ours();
  Timing time_theirs();
  /// Contacts per grain at the end of the last run.
  double our_contacts() const { return our_contacts_; }
  double their_contacts() const { return their_contacts_; }

 private:
  std::string their_deck(const std::string& start) const;
  /// The CPU time is that of the whole process.
  Timing run_theirs(std::int64_t steps);

  const testing::TemporaryFolder& folder_;
  Packing packing_;
  double skin_m_;
  dem::Checkpoint start_;
  double their_overhead_s_ = 0;  ///< CPU time of a process without timed steps
  double our_contacts_ = 0;
  double their_contacts_ = 0;
};

}  // namespace repose::bench
