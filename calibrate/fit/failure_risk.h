#pragma once

#include "calibrate/fit/points.h"
#include "calibrate/fit/training_set.h"

namespace repose::calibrate {

struct Risk {
  double fraction = 0;  ///< of failures among the runs nearby, 0 ... 1
  Point gradient;
};

/// How likely an experiment is to have no reading at a point: the fraction of failed runs around
/// it.
///
/// Weights fall off as a normal density of sd .1 sqrt(dimensions) of the box: Nadaraya (1964),
/// Theory Probab. Appl. 9, 141. A point far from all runs has no risk. Proved by FailureRisk.*.
class FailureRisk {
 public:
  explicit FailureRisk(Attempts attempts) : attempts_(std::move(attempts)) {}

  bool any() const { return attempts_.failures() > 0; }
  Risk at(const Point& point) const;

 private:
  Attempts attempts_;
};

}  // namespace repose::calibrate
