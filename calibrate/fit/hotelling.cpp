#include "calibrate/fit/hotelling.h"

#include <algorithm>

#include <Eigen/Cholesky>

#include "base/distributions.h"

namespace repose::calibrate {

double chance_of(const Eigen::VectorXd& difference, const MeanCovariance& one,
                 const MeanCovariance& other) {
  const auto count = static_cast<double>(difference.size());
  const Eigen::LLT<Eigen::MatrixXd> both(one.matrix + other.matrix);
  double spread = 0;
  for (const MeanCovariance* each : {&one, &other}) {
    const Eigen::MatrixXd fraction = both.solve(each->matrix);
    const double trace = fraction.trace();
    spread += ((fraction * fraction).trace() + trace * trace) / each->df;
  }
  const double df = std::min(count * (count + 1) / std::max(spread, 1e-300), base::kManyDf);
  const double t2 = difference.dot(both.solve(difference));
  const double left = std::max(df - count + 1, 1.);
  return base::fisher_f_above(t2 * left / (std::max(df, count) * count), count, left);
}

}  // namespace repose::calibrate
