#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/input_error.h"
#include "base/random.h"
#include "calibrate/statistics/design/design.h"
#include "calibrate/statistics/factor_rules.h"

namespace repose::calibrate {
namespace {

constexpr int kMaxLatinRuns = 2000;
constexpr std::size_t kMaxFactors = 20;

/// A Latin hypercube of whole levels 0 ... runs - 1, and how crowded it is.
///
/// phi = sum over pairs of d^-2p, p = 8, d in levels (Morris and Mitchell 1995, J. Stat. Planning
/// and Inference 43, eq. 1, without the root): large p makes the closest pairs decide. Only sums
/// and products of exact squares, so that every machine takes the same decisions.
class Hypercube {
 public:
  Hypercube(std::size_t runs, std::size_t factors, base::Random& random)
      : runs_(runs), levels_(factors, std::vector<int>(runs)), squares_(runs * runs) {
    for (std::vector<int>& column : levels_) {
      for (std::size_t i = 0; i < runs; ++i) column[i] = static_cast<int>(i);
      for (std::size_t left = runs; left > 1; --left) {
        std::swap(column[left - 1], column[pick(left, random)]);
      }
    }
    for (std::size_t i = 0; i < runs; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        std::int64_t square = 0;
        for (const std::vector<int>& column : levels_) square += squared(column[i] - column[j]);
        square_of(i, j) = square_of(j, i) = square;
      }
    }
  }

  static std::size_t pick(std::size_t count, base::Random& random) {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(count));
  }

  /// Exchanges a level between two runs if that spreads the points.
  void try_exchange(base::Random& random) {
    std::vector<int>& column = levels_[pick(levels_.size(), random)];
    const std::size_t a = pick(runs_, random);
    const std::size_t b = pick(runs_, random);
    if (a == b) return;
    double change = 0;
    for (std::size_t j = 0; j < runs_; ++j) {
      if (j == a || j == b) continue;
      const std::int64_t shift = squared(column[b] - column[j]) - squared(column[a] - column[j]);
      change += crowding(square_of(a, j) + shift) - crowding(square_of(a, j));
      change += crowding(square_of(b, j) - shift) - crowding(square_of(b, j));
    }
    if (!(change < 0)) return;
    for (std::size_t j = 0; j < runs_; ++j) {
      if (j == a || j == b) continue;
      const std::int64_t shift = squared(column[b] - column[j]) - squared(column[a] - column[j]);
      square_of(j, a) = square_of(a, j) += shift;
      square_of(j, b) = square_of(b, j) -= shift;
    }
    std::swap(column[a], column[b]);
  }

  std::int64_t closest() const {
    std::int64_t least = squares_[1];
    for (std::size_t i = 0; i < runs_; ++i) {
      for (std::size_t j = 0; j < i; ++j) least = std::min(least, squares_[i * runs_ + j]);
    }
    return least;
  }

  int level(std::size_t run, std::size_t factor) const { return levels_[factor][run]; }

 private:
  static std::int64_t squared(std::int64_t x) { return x * x; }
  std::int64_t& square_of(std::size_t i, std::size_t j) { return squares_[i * runs_ + j]; }
  static double crowding(std::int64_t square) {
    const double inverse = 1 / static_cast<double>(square);
    const double fourth = inverse * inverse * inverse * inverse;
    return fourth * fourth;
  }

  std::size_t runs_;
  std::vector<std::vector<int>> levels_;  // [factor][run]
  std::vector<std::int64_t> squares_;     // of distances between runs
};

Hypercube best_hypercube(std::size_t runs, std::size_t factors, std::uint64_t seed) {
  // Some seconds at most, for 2000 runs; small designs get all that helps.
  constexpr std::size_t kStarts = 5, kUseful = 100, kMaxPairUpdates = 50'000'000;
  const std::size_t exchanges =
      factors == 1 ? 0 : std::min(kUseful * runs * factors, kMaxPairUpdates / runs);
  base::Random random(seed);
  std::optional<Hypercube> best;
  for (std::size_t start = 0; start < kStarts; ++start) {
    Hypercube trial(runs, factors, random);
    for (std::size_t k = 0; k < exchanges; ++k) trial.try_exchange(random);
    if (!best || trial.closest() > best->closest()) best = std::move(trial);
  }
  return *best;
}

}  // namespace

Design latin_hypercube(const std::vector<Factor>& factors, int runs, std::uint64_t seed) {
  base::Faults errors;
  check_factors(factors, 1, kMaxFactors, errors);
  check_count("runs", runs, 2, kMaxLatinRuns, errors);
  errors.throw_if_any();
  const auto count = static_cast<std::size_t>(runs);
  const Hypercube hypercube = best_hypercube(count, factors.size(), seed);
  Design design{.factors = factors, .runs = {}};
  for (std::size_t run = 0; run < count; ++run) {
    DesignRun point{.coded = {}, .kind = PointKind::spread, .standard = static_cast<int>(run) + 1};
    for (std::size_t factor = 0; factor < factors.size(); ++factor) {
      point.coded.push_back((2.0 * hypercube.level(run, factor) + 1) / runs - 1);
    }
    design.runs.push_back(std::move(point));
  }
  return design;
}

}  // namespace repose::calibrate
