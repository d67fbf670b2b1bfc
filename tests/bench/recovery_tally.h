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

/// Anywhere but the outer tenths of the bounds; grains that do not rebound at all, below .2 of
/// restitution's, would give readings without scatter.
std::vector<double> made_up_material(const std::vector<calibrate::Parameter>& parameters,
                                     calibrate::Random& random);

/// How the parameters came back over all materials.
class RecoveryTally {
 public:
  explicit RecoveryTally(std::vector<calibrate::Parameter> parameters);

  /// Widths that were foreseen, as parts of the bounds' distance.
  void foresee(std::vector<double> widths) { foreseen_ = std::move(widths); }
  /// `verbose`: says every parameter.
  void add(const calibrate::JointFit& fit, const std::vector<double>& truth, bool verbose);
  /// The same, with the verdicts on bench and simulation, and what was held out.
  void add(const calibrate::StudyOutcome& outcome, const std::vector<double>& truth, bool verbose);
  void print() const;

 private:
  struct Row {
    std::map<calibrate::Verdict, int> verdicts;
    int held = 0;             ///< truths inside the interval
    int held_determined = 0;  ///< of the determined ones
    std::vector<double> widths;
  };
  struct HeldOut {
    std::map<calibrate::AgreementVerdict, int> verdicts;
    int held = 0;  ///< differences that are no more than chance makes in 5 % of cases
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
