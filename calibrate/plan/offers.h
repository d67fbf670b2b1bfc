#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "calibrate/experiment/run_store.h"
#include "calibrate/fit/problem.h"
#include "calibrate/study/study_problem.h"
#include "dem/shape/clump/clump_file.h"
#include "dem/study/study.h"

/// What a calibration's advice can be made from.

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

/// Every experiment that the study does not have, done in the usual way, with the runs that
/// plan_jobs() of any budget have left in the folder: nothing is simulated.
/// @param study  as measured (as_measured), sound for a fit
std::vector<Offer> offers_in(const RunStore& folder, const dem::Study& study,
                             const dem::ClumpFile& grain);

}  // namespace repose::calibrate
