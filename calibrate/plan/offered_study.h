#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "calibrate/fit/problem.h"
#include "calibrate/study/study_problem.h"
#include "dem/shape/clump/clump_file.h"
#include "dem/study/study.h"

namespace repose::calibrate {

/// A study in which every experiment that there is can be done.
struct OfferedStudy {
  dem::Study study;  ///< as simulated
  /// Those that the study does not have, as they would stand in it.
  std::map<dem::Experiment, dem::StudyExperiment> added;
  /// All experiments that depend on a coefficient that is sought; what was measured of them.
  Problem problem;
  /// Experiments left out because they take too long, or whose readings differ from the simulation
  /// for a reason that is known.
  std::vector<std::string> notes;
};

/// Adds the experiments that a study lacks, done in the usual way with its grains; but not those,
/// the dearest first, of which the fewest runs would take longer than the budget has.
/// @param possible  those that could be done beside the study's
/// @param study  as measured (as_measured), what was measured included
/// @param budget  of the runs
/// @throws base::InputError  nothing is sought, or the problem is not sound: every error.
OfferedStudy offered_study(const dem::Study& study, const dem::ClumpFile& grain,
                           const Budget& budget, const std::set<dem::Experiment>& possible);

/// All that there are.
std::set<dem::Experiment> every_experiment();

}  // namespace repose::calibrate
