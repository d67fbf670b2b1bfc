#pragma once

#include <map>
#include <string>
#include <vector>

#include "calibrate/fit/agreement.h"
#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/points.h"
#include "calibrate/fit/problem.h"
#include "calibrate/study/study_run.h"

namespace repose::bench {

/// Anywhere but in the outer tenths of the bounds; for restitution, the first parameter, not below
/// .2 of them: grains that hardly rebound would give readings without scatter.
std::vector<double> made_up_material(const std::vector<calibrate::Parameter>& parameters,
                                     calibrate::Random& random);

/// How well the parameters were recovered over all materials.
class RecoveryTally {
 public:
  explicit RecoveryTally(std::vector<calibrate::Parameter> parameters);

  /// Sets the predicted widths, as fractions of the bounds' distance.
  void foresee(std::vector<double> widths) { foreseen_ = std::move(widths); }
  /// `verbose`: prints every parameter.
  void add(const calibrate::JointFit& fit, const std::vector<double>& truth, bool verbose);
  /// The same, with the verdicts on agreement with the bench, and the held-out readings.
  void add(const calibrate::StudyOutcome& outcome, const std::vector<double>& truth, bool verbose);
  void print() const;

 private:
  struct Row {
    std::map<calibrate::Verdict, int> verdicts;
    int held = 0;             ///< truths inside the interval
    int held_determined = 0;  ///< those of determined parameters
    std::vector<double> widths;
  };
  struct HeldOut {
    std::map<calibrate::AgreementVerdict, int> verdicts;
    int held = 0;  ///< differences not significant at the 5 % level
    int predictions = 0;
  };

  void print_verdicts() const;

  std::vector<calibrate::Parameter> parameters_;
  std::vector<Row> rows_;
  std::vector<double> foreseen_;
  std::map<calibrate::AgreementVerdict, int> agreements_;
  std::map<std::string, HeldOut> held_out_;
  int materials_ = 0;
};

}  // namespace repose::bench
