#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/fit/assumed_scatter.h"
#include "calibrate/fit/input_effects.h"
#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/prediction.h"
#include "calibrate/fit/sensitivity_check.h"
#include "calibrate/fit/verification.h"
#include "calibrate/study/job_runner.h"
#include "calibrate/study/study_problem.h"

namespace repose::calibrate {

inline constexpr int kFamilyRepeats = 2;  ///< of an equally good set

/// An equally good set of parameters that was simulated.
struct CheckedSet {
  Verification check;
  double chi2 = 0;  ///< above that of the best fit
};

/// What another value of an assumed input changes.
struct Sensitivity {
  std::vector<SensitivityCheck> readings;      ///< of experiments that the budget allows for
  std::vector<MovedCoefficient> coefficients;  ///< that these changes ask for; none without any
  std::vector<std::string> over_budget;        ///< experiments that it does not allow for
};

/// What more spheres change.
struct ShapeCheck : Sensitivity {
  int spheres = 1;                           ///< the study's
  std::optional<int> finer_spheres;          ///< of the grain it was compared with; none: of none
  std::optional<double> finer_volume_error;  ///< of that grain, as dem::ClumpErrors::volume_error
  std::string not_made;                      ///< why there is no such grain; else empty
};

/// A study that came to its end.
struct StudyOutcome {
  JointFit fit;       ///< the last one: of all runs, those of the checks included
  Verification best;  ///< the last check: `fit`'s parameters, or those nearest to it
  int check_rounds = 0;
  std::vector<SurrogateCheck> surrogates;  ///< what was expected of that check before
  std::vector<CheckedSet> family;          ///< those simulated that still fit
  std::vector<Prediction> predictions;     ///< of what was held out
  AssumedScatters assumed_scatters;        ///< of readings whose scatter nobody measured
  Sensitivity stiffness;                   ///< stiffer grains, in softened experiments
  ShapeCheck shape;                        ///< grains of more spheres
  std::vector<InputEffect> inputs;         ///< held fixed, and what they move
  std::vector<CombinedEffect> combined;    ///< all of these
  std::vector<Run> runs;                   ///< those that the fit was made from
  std::vector<Run> checks;                 ///< those of the last check
  NamedAngles heap_angles_deg;             ///< of these (job_runner.h)
  std::vector<std::string> notes;          ///< what a reader of the fit must know of its runs
  int simulated = 0;                       ///< runs made by this call
  int reused = 0;                          ///< runs found in the folder
};

/// Runs a study to its end, going on from what the folder holds. The outcome does not depend on how
/// often it was interrupted, nor on the executor. None when it was interrupted, which leaves what
/// is known to StudyContext::leave.
/// @throws base::InputError  a protocol that cannot be run, a folder that cannot be written,
/// or too few runs with a reading for a fit.
std::optional<StudyOutcome> run_study(const Problem& problem, const Budget& asked,
                                      const StudyContext& context);

}  // namespace repose::calibrate
