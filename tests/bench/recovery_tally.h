#pragma once

#include <string>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"
#include "calibrate/fit/random.h"

namespace repose::bench {

/// Anywhere but the outer tenths of the bounds; grains that do not rebound at all, below .2 of
/// restitution's, would give readings without scatter.
std::vector<double> made_up_material(const std::vector<calibrate::Parameter>& parameters,
                                     calibrate::Random& random);

/// How the parameters came back over all materials.
class RecoveryTally {
 public:
  explicit RecoveryTally(std::vector<calibrate::Parameter> parameters);

  /// `verbose`: says every parameter.
  void add(const calibrate::JointFit& fit, const std::vector<double>& truth, bool verbose);
  void print() const;

 private:
  struct Row {
    int determined = 0;
    int one_sided = 0;
    int undetermined = 0;
    int held = 0;             ///< truths inside the interval
    int held_determined = 0;  ///< of the determined ones
    std::vector<double> widths;
  };

  std::vector<calibrate::Parameter> parameters_;
  std::vector<Row> rows_;
  int materials_ = 0;
};

}  // namespace repose::bench
