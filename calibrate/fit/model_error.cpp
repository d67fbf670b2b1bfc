#include "calibrate/fit/model_error.h"

#include <cmath>

namespace repose::calibrate {
namespace {

constexpr double kLeastDegrees = 1;
constexpr double kMostScale = 1024;  // a power of two: the search doubles
constexpr int kHalvings = 12;        // of the scale's logarithm: to a thousandth

}  // namespace

double model_error_scale(Misfit misfit, Minimum best) {
  // Chi-square less its mean, which is that of its degrees of freedom: Paule and Mandel (1982),
  // J. Res. Natl. Bur. Stand. 87, 377. It falls as the model is trusted less.
  const auto excess = [&](double scale) {
    misfit.scale_model_errors(scale);
    best = minimum_from(misfit, best.point);
    return best.chi2 - misfit.freedom(best.point).of_chi2;
  };
  if (!misfit.has_model_errors()) return 1;
  if (misfit.freedom(best.point).of_chi2 < kLeastDegrees || excess(1) <= 0) return 1;
  double high = 2;
  while (high < kMostScale && excess(high) > 0) high *= 2;
  double low = high / 2;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = std::sqrt(low * high);
    (excess(middle) > 0 ? low : high) = middle;
  }
  return high;
}

}  // namespace repose::calibrate
