#include "calibrate/fit/best_places.h"

#include <Eigen/Core>

namespace repose::calibrate {
namespace {

/// What is left unknown of one surrogate at the candidates.
struct Unknown {
  Eigen::MatrixXd covariance;
  double noise2 = 0;
  double weight = 1;

  /// How much variance a run at each candidate would take from all of them together.
  Eigen::VectorXd gains() const {
    return weight * covariance.colwise().squaredNorm().transpose().array() /
           (covariance.diagonal().array() + noise2 + 1e-300);
  }

  void learn(Eigen::Index place) {
    const Eigen::VectorXd column = covariance.col(place);
    covariance -= column * column.transpose() / (column(place) + noise2 + 1e-300);
  }
};

}  // namespace

std::vector<std::size_t> best_places(const std::vector<Surrogate>& surrogates,
                                     const std::vector<double>& weights,
                                     const std::vector<Point>& candidates, std::size_t count) {
  const auto size = static_cast<Eigen::Index>(candidates.size());
  std::vector<Unknown> unknowns;
  for (std::size_t i = 0; i < surrogates.size(); ++i) {
    const std::vector<double> flat = surrogates[i].covariance(candidates);
    const double noise = surrogates[i].run_sd();
    unknowns.push_back(
        {Eigen::Map<const Eigen::MatrixXd>(flat.data(), size, size), noise * noise, weights[i]});
  }
  std::vector<std::size_t> chosen;
  while (chosen.size() < count) {
    Eigen::VectorXd gains = Eigen::VectorXd::Zero(size);
    for (const Unknown& unknown : unknowns) gains += unknown.gains();
    Eigen::Index best = 0;
    if (!(gains.maxCoeff(&best) > 0)) break;
    for (Unknown& unknown : unknowns) unknown.learn(best);
    chosen.push_back(static_cast<std::size_t>(best));
  }
  return chosen;
}

}  // namespace repose::calibrate
