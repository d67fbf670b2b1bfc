#include "calibrate/fit/best_places.h"

#include <algorithm>

#include <Eigen/Core>

namespace repose::calibrate {

namespace {

/// The remaining uncertainty of one surrogate at the candidates, and what each possible run would
/// reduce it by: a full one at each, followed by coarse ones if there are any.
struct Unknown {
  Eigen::MatrixXd covariance;  ///< of the runs' expected values
  Eigen::ArrayXd noise2;       ///< of each run
  Eigen::Index candidates = 0;
  double weight = 1;

  /// How much variance each run would remove from all candidates together.
  Eigen::VectorXd gains() const {
    return weight * covariance.topRows(candidates).colwise().squaredNorm().transpose().array() /
           (covariance.diagonal().array() + noise2 + 1e-300);
  }

  void learn(Eigen::Index run) {
    const Eigen::VectorXd column = covariance.col(run);
    covariance -= column * column.transpose() / (column(run) + noise2(run) + 1e-300);
  }

  double mean_variance() const { return weight * covariance.diagonal().head(candidates).mean(); }
};

/// `kinds`: of the possible runs at each candidate.
std::vector<Unknown> unknowns_of(const std::vector<Surrogate>& surrogates,
                                 const std::vector<double>& weights,
                                 const std::vector<Point>& candidates,
                                 const std::vector<RunKind>& kinds) {
  const auto count = static_cast<Eigen::Index>(candidates.size());
  std::vector<Point> places;
  std::vector<RunKind> of_places;
  for (const RunKind kind : kinds) {
    places.insert(places.end(), candidates.begin(), candidates.end());
    of_places.insert(of_places.end(), candidates.size(), kind);
  }
  const auto runs = static_cast<Eigen::Index>(places.size());
  std::vector<Unknown> unknowns;
  for (std::size_t i = 0; i < surrogates.size(); ++i) {
    const std::vector<double> flat = surrogates[i].covariance(places, of_places);
    Unknown& unknown = unknowns.emplace_back();
    unknown.covariance = Eigen::Map<const Eigen::MatrixXd>(flat.data(), runs, runs);
    unknown.noise2.resize(runs);
    for (Eigen::Index run = 0; run < runs; ++run) {
      const double noise = surrogates[i].run_sd(of_places[static_cast<std::size_t>(run)]);
      unknown.noise2(run) = noise * noise;
    }
    unknown.candidates = count;
    unknown.weight = weights[i];
  }
  return unknowns;
}

Eigen::VectorXd gains_of(const std::vector<Unknown>& unknowns) {
  Eigen::VectorXd gains = unknowns.front().gains();
  for (std::size_t i = 1; i < unknowns.size(); ++i) gains += unknowns[i].gains();
  return gains;
}

}  // namespace

std::vector<std::size_t> best_places(const std::vector<Surrogate>& surrogates,
                                     const std::vector<double>& weights,
                                     const std::vector<Point>& candidates, std::size_t count,
                                     double enough,
                                     const std::function<bool(std::size_t)>& accepts) {
  std::vector<Unknown> unknowns = unknowns_of(surrogates, weights, candidates, {RunKind::full});
  std::vector<std::size_t> chosen;
  if (unknowns.empty()) return chosen;
  Eigen::VectorXd open = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(candidates.size()));
  const auto is_known = [&](const Unknown& unknown) { return unknown.mean_variance() <= enough; };
  while (chosen.size() < count) {
    if (enough > 0 && std::ranges::all_of(unknowns, is_known)) break;
    Eigen::Index best = 0;
    if (!(gains_of(unknowns).cwiseProduct(open).maxCoeff(&best) > 0)) break;
    const auto place = static_cast<std::size_t>(best);
    if (accepts && !accepts(place)) {
      open(best) = 0;
      continue;
    }
    for (Unknown& unknown : unknowns) unknown.learn(best);
    chosen.push_back(place);
  }
  return chosen;
}

std::vector<ChosenRun> best_runs(const std::vector<Surrogate>& surrogates,
                                 const std::vector<double>& weights,
                                 const std::vector<Point>& candidates, const RunCosts& costs,
                                 double seconds, double most_seconds) {
  std::vector<Unknown> unknowns =
      unknowns_of(surrogates, weights, candidates, {RunKind::full, RunKind::coarse});
  const auto count = static_cast<Eigen::Index>(candidates.size());
  Eigen::VectorXd cost(2 * count);
  cost << Eigen::VectorXd::Constant(count, costs.full_s),
      Eigen::VectorXd::Constant(count, costs.coarse_s);
  std::vector<ChosenRun> chosen;
  double spent_s = 0;
  while (spent_s < seconds) {
    const Eigen::ArrayXd affordable = (spent_s + cost.array() <= most_seconds).cast<double>();
    Eigen::Index best = 0;
    const Eigen::ArrayXd worth = gains_of(unknowns).array() / cost.array() * affordable;
    if (!(worth.maxCoeff(&best) > 0)) break;
    for (Unknown& unknown : unknowns) unknown.learn(best);
    chosen.push_back(
        {static_cast<std::size_t>(best % count), best < count ? RunKind::full : RunKind::coarse});
    spent_s += cost(best);
  }
  return chosen;
}

double unknown_fraction(const Misfit& misfit, const PosteriorSamples& sets,
                        std::size_t observable) {
  double sum = 0;
  for (const Point& point : sets.points) {
    sum += misfit.surrogate_variance_fraction(observable, point);
  }
  return sum / static_cast<double>(sets.points.size());
}

std::vector<Point> candidate_places(const PosteriorSamples& sets) {
  constexpr std::size_t kCandidates = 150;
  std::vector<Point> chosen;
  for (std::size_t i = 0; i < kCandidates; ++i) {
    chosen.push_back(sets.wide[i * sets.wide.size() / kCandidates]);
  }
  return chosen;
}

}  // namespace repose::calibrate
