#pragma once

#include <atomic>
#include <stdexcept>

#include <ceres/iteration_callback.h>

namespace repose::calibrate {

/// Thrown by a fit that was interrupted.
class FitInterrupted : public std::runtime_error {
 public:
  FitInterrupted() : std::runtime_error("the fit was interrupted") {}
};

/// While it exists, fits and plans on this thread throw FitInterrupted soon after `is_interrupted`
/// becomes true: between two steps of a search, which take milliseconds.
class FitWatch {
 public:
  explicit FitWatch(const std::atomic<bool>& is_interrupted);
  ~FitWatch();
  FitWatch(const FitWatch&) = delete;
  FitWatch& operator=(const FitWatch&) = delete;
  FitWatch(FitWatch&&) = delete;
  FitWatch& operator=(FitWatch&&) = delete;

 private:
  const std::atomic<bool>* before_;
};

/// For the searches.
bool is_fit_interrupted();
/// @throws FitInterrupted
void stop_if_interrupted();

/// Makes a Ceres search abort when the fit is interrupted.
class SearchCallback : public ceres::IterationCallback {
 public:
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& /*summary*/) override {
    return is_fit_interrupted() ? ceres::SOLVER_ABORT : ceres::SOLVER_CONTINUE;
  }
};

}  // namespace repose::calibrate
