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

inline constexpr int kFamilyRepeats = 2;  ///< for each equally good set

/// An equally good parameter set that was simulated.
struct CheckedSet {
  Verification check;
  double chi2 = 0;  ///< above that of the best fit
};

/// Changes due to another value of an assumed input.
struct Sensitivity {
  std::vector<SensitivityCheck> readings;      ///< of experiments within the budget
  std::vector<MovedCoefficient> coefficients;  ///< implied by these changes; empty without any
  std::vector<std::string> over_budget;        ///< experiments beyond the budget
};

/// Changes due to more spheres.
struct ShapeCheck : Sensitivity {
  int spheres = 1;                           ///< the study's
  std::optional<int> finer_spheres;          ///< of the grain compared; std::nullopt: no comparison
  std::optional<double> finer_volume_error;  ///< of that grain, as dem::ClumpErrors::volume_error
  std::string not_made;                      ///< why there is no such grain; otherwise empty
};

/// Outcome of a completed study.
struct StudyOutcome {
  JointFit fit;       ///< the last one: of all runs, including those of the checks
  Verification best;  ///< the last check: `fit`'s parameters, or those nearest to it
  int check_rounds = 0;
  std::vector<SurrogateCheck> surrogates;  ///< predictions made before that check
  std::vector<CheckedSet> family;          ///< those simulated that still fit
  std::vector<Prediction> predictions;     ///< of held-out readings
  AssumedScatters assumed_scatters;        ///< of readings whose scatter was not measured
  Sensitivity stiffness;                   ///< stiffer grains, in softened experiments
  ShapeCheck shape;                        ///< grains of more spheres
  std::vector<InputEffect> inputs;         ///< held fixed, and their effects
  std::vector<CombinedEffect> combined;    ///< all of these
  std::vector<Run> runs;                   ///< used for the fit
  std::vector<Run> checks;                 ///< those of the last check
  NamedAngles heap_angles_deg;             ///< of these (job_runner.h)
  std::vector<std::string> notes;          ///< what a reader of the fit must know about its runs
  int simulated = 0;                       ///< runs made by this call
  int reused = 0;                          ///< runs found in the folder
};

/// Runs a study to its end, continuing from the contents of the folder. The outcome does not depend
/// on how often it was interrupted, nor on the executor. std::nullopt if interrupted; what is known
/// is then passed to StudyContext::leave.
/// @throws base::InputError  a protocol that cannot be run, a folder that cannot be written, or too
/// few runs with a reading for a fit.
std::optional<StudyOutcome> run_study(const Problem& problem, const Budget& asked,
                                      const StudyContext& context);

}  // namespace repose::calibrate
