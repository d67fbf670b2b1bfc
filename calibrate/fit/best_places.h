#pragma once

#include <cstddef>
#include <vector>

#include "calibrate/fit/points.h"
#include "calibrate/fit/surrogate.h"

namespace repose::calibrate {

/// Which of the `candidates` to run next, `count` of them, some perhaps twice.
///
/// One by one, each time the place whose run would lower the surrogates' variances over all
/// candidates most, each surrogate's in units of `weights`: Cohn (1996), Neural Networks 9, 1071;
/// for Gaussian processes Seo, Wallat, Graepel, Obermayer (2000). A run without chance is never
/// repeated. Proved by BestPlaces.* in tests/calibrate.
std::vector<std::size_t> best_places(const std::vector<Surrogate>& surrogates,
                                     const std::vector<double>& weights,
                                     const std::vector<Point>& candidates, std::size_t count);

}  // namespace repose::calibrate
