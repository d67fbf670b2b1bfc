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
  std::string start;       ///< command with which LIGGGHTS reads it
  std::string integrator;  ///< LIGGGHTS's
  std::int64_t steps = 0;  ///< of a timed run: some seconds
};

/// Spheres that we poured. Writes LIGGGHTS's file into `folder`.
Packing settled_spheres(const testing::TemporaryFolder& folder, int grains);

/// Clumps that LIGGGHTS poured, because it takes none in given poses. Throws std::runtime_error
/// when it does not get all of them in.
Packing settled_clumps(const testing::TemporaryFolder& folder, int grains);

/// What a run took.
struct Timing {
  double elapsed_s = 0;
  double cpu_s = 0;
};

/// Runs the same steps again and again, in either engine, on one core.
///
/// Tangential springs are not handed over: both engines first wind up their own, and each timed run
/// begins where that ended.
class Race {
 public:
  /// `skin_m` is how far beyond contact LIGGGHTS lists neighbours.
  Race(const testing::TemporaryFolder& folder, Packing packing, double skin_m);

  Timing time_ours();
  Timing time_theirs();
  /// Contacts a grain at the end of the last run.
  double our_contacts() const { return our_contacts_; }
  double their_contacts() const { return their_contacts_; }

 private:
  std::string their_deck(const std::string& start) const;
  /// CPU time is that of the whole process.
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
