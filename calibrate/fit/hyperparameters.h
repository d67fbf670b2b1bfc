#pragma once

#include <optional>
#include <vector>

namespace repose::calibrate {

/// Whether a value is of the function itself, or of a cheaper approximation of it.
enum class RunKind { full, coarse };

/// Error of a run's prediction from all other runs, and the sd expected of it.
struct LeaveOneOut {
  double error = 0;
  double sd = 0;
};

/// How coarse values differ from the function itself: see GaussianProcess.
struct CoarseHyperparameters {
  double shift = .3;  ///< the same everywhere, in sd's of the data
  double drift = .3;  ///< varies from place to place, likewise
  double noise = 1;   ///< as a multiple of that of full ones
};

/// Of a Gaussian process: smooth part, straight trend and noise, in sd's of the data.
struct Hyperparameters {
  std::vector<double> length;  ///< per coordinate of the unit box
  double signal = 1;
  double trend = 1;  ///< slope per length scale
  double noise = .1;
  std::optional<CoarseHyperparameters> coarse = {};  ///< std::nullopt: all values are full ones
};

}  // namespace repose::calibrate
