#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/verification.h"
#include "calibrate/study/study_context.h"
#include "calibrate/study/study_problem.h"

namespace repose::calibrate {

/// A study that came to its end.
struct StudyOutcome {
  JointFit fit;
  Verification best;                 ///< the fitted parameters, simulated with fresh seeds
  std::vector<Verification> family;  ///< equally good parameter sets, simulated
  std::vector<Run> runs;             ///< those that the fit was made from
  std::vector<Run> checks;           ///< those of the fitted parameters with fresh seeds
  std::vector<std::string> notes;    ///< what a reader of the fit must know of its runs
  int simulated = 0;                 ///< runs made by this call
  int reused = 0;                    ///< runs found in the folder
};

/// Runs a study to its end, going on from what the folder holds. The outcome does not depend on how
/// often it was interrupted, nor on the executor. None when it was interrupted.
/// @throws std::invalid_argument  a protocol that cannot be run, a folder that cannot be written,
/// or too few runs with a reading for a fit.
std::optional<StudyOutcome> run_study(const Problem& problem, const Budget& budget,
                                      const StudyContext& context);

}  // namespace repose::calibrate
