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

/// Inputs for the advice of a calibration.

namespace repose::calibrate {

/// A study extended by every available experiment.
struct OfferedStudy {
  dem::Study study;  ///< as simulated
  /// Those that the study does not have, as they would be described in it.
  std::map<dem::Experiment, dem::StudyExperiment> added;
  /// All experiments that depend on an unknown coefficient; what was measured of them.
  Problem problem;
  /// Experiments left out because they take too long, or whose readings differ from the simulation
  /// for a known reason.
  std::vector<std::string> notes;
};

/// Adds the experiments that a study lacks, done in the usual way with its grains; leaves out the
/// most expensive ones until the fewest runs of all take no longer than kFirstFraction of the
/// budget.
/// @param possible  those that could be done besides the study's
/// @param study  as measured (as_measured), including the measurements
/// @param budget  of the runs
/// @throws base::InputError  nothing is sought, or the problem is not sound: every error.
OfferedStudy offered_study(const dem::Study& study, const dem::ClumpFile& grain,
                           const Budget& budget, const std::set<dem::Experiment>& possible);

/// All that exist.
std::set<dem::Experiment> every_experiment();

/// Every experiment that the study does not have, done in the usual way, with the runs that
/// plan_jobs() of any budget have left in the folder: nothing is simulated.
/// @param study  as measured (as_measured), sound for a fit
std::vector<Offer> offers_in(const RunStore& folder, const dem::Study& study,
                             const dem::ClumpFile& grain);

}  // namespace repose::calibrate
