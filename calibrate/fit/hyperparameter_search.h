#pragma once

#include <optional>

#include <Eigen/Core>

#include "calibrate/fit/gaussian_process.h"

// Internal to the Gaussian process: included by its .cpp files only.
namespace repose::calibrate {

struct SearchResult {
  Hyperparameters hyper;
  double log_posterior = 0;
};

/// The most probable hyperparameters of standardised values `y` at the rows of `x`.
///
/// Marginal likelihood (Rasmussen and Williams 2006, eq. 2.30, gradient 5.9) times log-normal
/// priors, of median 1 and 95 % between .14 and 7 for lengths, signal and trend; the noise has
/// median .1 (.005 ... 2), without chance .001 (.0001 ... .007). Minimised by L-BFGS from fixed
/// starts.
SearchResult search_hyperparameters(const Eigen::MatrixXd& x, const Eigen::VectorXd& y,
                                    bool is_stochastic, const std::optional<Hyperparameters>& start,
                                    int starts);

}  // namespace repose::calibrate
