#pragma once

#include <optional>
#include <vector>

namespace repose::calibrate {

/// Whether a value is of the function itself, or of a cheaper likeness of it.
enum class RunKind { full, coarse };

/// Error of a run's prediction by all other runs, and the sd that was expected of it.
struct LeaveOneOut {
  double error = 0;
  double sd = 0;
};

/// Of what coarse values have beside the function itself: see GaussianProcess.
struct CoarseHyperparameters {
  double shift = .3;  ///< alike everywhere, in sd's of the data
  double drift = .3;  ///< what differs from place to place, likewise
  double noise = 1;   ///< as a multiple of that of full ones
};

/// Of a Gaussian process: smooth part, straight trend and noise, in sd's of the data.
struct Hyperparameters {
  std::vector<double> length;  ///< per coordinate of the unit box
  double signal = 1;
  double trend = 1;  ///< slope per length scale
  double noise = .1;
  std::optional<CoarseHyperparameters> coarse = {};  ///< none: all values are full ones
};

}  // namespace repose::calibrate
