#pragma once

#include <ceres/iteration_callback.h>

#include "calibrate/fit/fit_watch.h"

namespace repose::calibrate {

/// Makes a search by Ceres give up where the fit is interrupted.
class SearchCallback : public ceres::IterationCallback {
 public:
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& /*summary*/) override {
    return is_fit_interrupted() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }
};

}  // namespace repose::calibrate
