#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "calibrate/fit/problem.h"
#include "dem/shape/clump/clump_file.h"
#include "dem/study/study.h"

namespace repose::calibrate {

/// The name of an experiment in a study file and in a Job: "drop", "tilt", "roll", "heap".
std::string name_of(dem::Experiment experiment);
/// Throws std::invalid_argument for any other name.
dem::Experiment experiment_named(const std::string& name);

/// A job that was simulated.
struct SimulatedJob {
  Run run;
  double wall_s = 0;
};

/// Turns jobs into readings: the study's bench with a job's coefficients.
///
/// A heap has, beside the readings of dem::HeapProtocol and add_position_angle(),
/// "angle_from_positions_deg", "angle_from_pictures_deg" (where a view could be measured),
/// "sd_between_views_deg" and "views_measured"; its value is the angle from pictures where at least
/// half of the views could be measured ("from_pictures" 1), else that from positions. Where not all
/// of the study's grains fit into the tube with a job's friction, the heap is of those that do
/// ("grains").
class StudySimulator {
 public:
  /// @param names  of Problem::parameters, in their order
  /// @param heap_views  pictures of each heap; 0: none are taken
  StudySimulator(dem::Study study, dem::ClumpFile grain, std::vector<std::string> names,
                 int heap_views);

  /// Names what a job gives: two jobs with the same key have the same readings, in any study. It is
  /// a fingerprint of the grain, the materials, the coefficients, the protocol, the seed and the
  /// sources of the simulator.
  std::string key(const Job& job) const;

  /// What the fingerprint is made from, as JSON: it is kept with the reading.
  std::string description(const Job& job) const;

  /// Where a heap's final state is to be kept; empty: nowhere.
  void save_states_in(const std::filesystem::path& folder) { state_folder_ = folder; }

  /// Runs it on one thread; may be called from several. An experiment in which nothing can be read,
  /// or that becomes unstable, is a failed run.
  /// @throws dem::Interrupted  `is_interrupted` became true.
  /// @throws std::invalid_argument  the protocol cannot be run.
  SimulatedJob simulate(const Job& job, const std::atomic<bool>& is_interrupted) const;

 private:
  dem::Model model_for(const Job& job) const;
  void take_pictures(const dem::Repeat& repeat, Run& run) const;

  dem::Study study_;
  std::string grain_fingerprint_;
  std::vector<std::string> names_;
  int heap_views_;
  std::filesystem::path state_folder_;
};

}  // namespace repose::calibrate
