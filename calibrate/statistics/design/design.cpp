#include "calibrate/statistics/design/design.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "base/random.h"
#include "calibrate/statistics/factor.h"

namespace repose::calibrate {

namespace {

/// Adds an error for too few or too many factors, ranges that are empty or not finite, and names
/// that are missing or duplicate.
void check_factors(const std::vector<Factor>& factors, std::size_t least, std::size_t most,
                   base::Faults& errors) {
  errors.require(
      factors.size() >= least && factors.size() <= most,
      {.value = fmt::format("{} factors: this design takes {} to {}", factors.size(), least, most),
       .fix = "name as many."});
  std::set<std::string> names;
  for (const Factor& factor : factors) {
    errors.require(!factor.name.empty(), {.value = "a factor has no name", .fix = "NAME=MIN:MAX."});
    errors.require(
        names.insert(factor.name).second,
        {.where = factor.name, .value = "is named twice", .fix = "give each factor once."});
    constexpr double kMax = 1e100;  // squares and differences of levels stay finite
    errors.require(!(std::abs(factor.low) > kMax || std::abs(factor.high) > kMax),
                   {.value = fmt::format("{} = {:g}:{:g}: a level is out of range", factor.name,
                                         factor.low, factor.high),
                    .rule = fmt::format("at most {:g} either way", kMax),
                    .fix = "choose another unit."});
    errors.require(factor.low < factor.high,
                   {.value = fmt::format("{} = {:g}:{:g}: the lower level", factor.name, factor.low,
                                         factor.high),
                    .rule = "must be below the higher",
                    .fix = fmt::format("{}=MIN:MAX.", factor.name)});
  }
}

/// Adds an error for a number that is not between `least` and `most`.
void check_count(const char* what, int count, int least, int most, base::Faults& errors) {
  errors.require(count >= least && count <= most,
                 {.value = fmt::format("{} = {}:", what, count),
                  .rule = fmt::format("must be from {} to {}", least, most),
                  .fix = "choose one of these."});
}

constexpr int kMaxRuns = 10'000;

}  // namespace

std::string name_of(PointKind kind) {
  switch (kind) {
    case PointKind::cube:
      return "cube";
    case PointKind::edge:
      return "edge";
    case PointKind::axial:
      return "axial";
    case PointKind::centre:
      return "centre";
    case PointKind::spread:
      return "spread";
    case PointKind::step:
      break;
  }
  return "step";
}

Design sweep(const std::vector<Factor>& factors, int levels) {
  constexpr std::size_t kMaxFactors = 20;
  base::Faults errors;
  check_factors(factors, 1, kMaxFactors, errors);
  check_count("levels", levels, 2, kMaxRuns, errors);
  errors.throw_if_any();
  Design design{.factors = factors, .runs = {}};
  for (std::size_t i = 0; i < factors.size(); ++i) {
    for (int level = 0; level < levels; ++level) {
      DesignRun run{.coded = std::vector<double>(factors.size(), 0.0),
                    .kind = PointKind::step,
                    .standard = static_cast<int>(design.runs.size()) + 1};
      run.coded[i] = 2.0 * level / (levels - 1) - 1;
      design.runs.push_back(std::move(run));
    }
  }
  return design;
}

Design line_of_runs(const std::vector<std::string>& names, const std::vector<double>& start,
                    const std::vector<double>& step, int runs) {
  base::Faults errors;
  check_count("runs", runs, 2, kMaxRuns, errors);
  errors.require(!names.empty(),
                 {.value = "no factor has a start and a step", .fix = "name at least one."});
  errors.require(start.size() == names.size() && step.size() == names.size(),
                 {.value = "each factor",
                  .rule = "must have one start and one step",
                  .fix = "give both for each."});
  errors.throw_if_any();
  Design design;
  bool moves = false;
  std::set<std::string> known;
  for (std::size_t i = 0; i < names.size(); ++i) {
    errors.require(known.insert(names[i]).second,
                   {.where = names[i], .value = "is named twice", .fix = "give each factor once."});
    errors.require(std::isfinite(start[i]) && std::isfinite(step[i]), {.where = names[i],
                                                                       .value = "start and step",
                                                                       .rule = "must be finite",
                                                                       .fix = "give numbers."});
    moves = moves || step[i] != 0;
    // One coded unit is one step; the range of a constant factor is arbitrary.
    const double half = step[i] != 0 ? step[i] : 1;
    design.factors.push_back({names[i], start[i] - half, start[i] + half});
  }
  errors.require(moves,
                 {.value = "all steps are 0: every run would be the same", .fix = "give a step."});
  errors.throw_if_any();
  for (int k = 0; k < runs; ++k) {
    DesignRun run{.coded = {}, .kind = PointKind::step, .standard = k + 1};
    for (const double length : step) run.coded.push_back(length != 0 ? k : 0);
    design.runs.push_back(std::move(run));
  }
  return design;
}

void randomise_order(Design& design, std::uint64_t seed) {
  // Fisher-Yates shuffle; 53 random bits over so few runs are uniform to 1e-12.
  base::Random random(seed);
  for (std::size_t left = design.runs.size(); left > 1; --left) {
    const auto pick = static_cast<std::size_t>(random.uniform() * static_cast<double>(left));
    std::swap(design.runs[left - 1], design.runs[pick]);
  }
}

namespace {

constexpr int kMaxLatinRuns = 2000;
constexpr std::size_t kMaxFactors = 20;

/// A Latin hypercube of whole levels 0 ... runs - 1, and its crowding.
///
/// phi = sum over pairs of d^-2p, p = 8, d in levels (Morris and Mitchell 1995, J. Stat. Planning
/// and Inference 43, eq. 1, without the root): large p makes the closest pairs decide. Uses only
/// sums and products of exact squares, so that every machine makes the same decisions.
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
  // A few seconds at most, for 2000 runs; small designs get as many exchanges as are useful.
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

namespace {

constexpr int kMaxCentreRuns = 1000;

void add_run(Design& design, std::vector<double> coded, PointKind kind) {
  design.runs.push_back({std::move(coded), kind, static_cast<int>(design.runs.size()) + 1});
}

void add_centre(Design& design, int runs) {
  for (int k = 0; k < runs; ++k) {
    add_run(design, std::vector<double>(design.factors.size(), 0.0), PointKind::centre);
  }
}

/// Every combination of -size and +size of the given factors, the first of them fastest.
void add_corners(Design& design, const std::vector<std::size_t>& which, double size,
                 PointKind kind) {
  for (std::size_t corner = 0; corner < (std::size_t{1} << which.size()); ++corner) {
    std::vector<double> coded(design.factors.size(), 0.0);
    for (std::size_t i = 0; i < which.size(); ++i) {
      coded[which[i]] = (corner >> i & 1U) != 0 ? size : -size;
    }
    add_run(design, std::move(coded), kind);
  }
}

double alpha_of(const CompositeOptions& options, std::size_t factors) {
  if (options.alpha) return *options.alpha;
  const auto corners = static_cast<double>(std::size_t{1} << factors);
  const double runs = corners + 2.0 * static_cast<double>(factors) + options.centre_runs;
  switch (options.rule) {
    case AxialRule::rotatable:
      return std::sqrt(std::sqrt(corners));
    case AxialRule::orthogonal:
      return std::sqrt((std::sqrt(corners * runs) - corners) / 2);
    case AxialRule::face:
      break;
  }
  return 1;
}

/// Groups of factors varied together; numbered from 0. Box and Behnken (1960), table 1.
std::vector<std::vector<std::size_t>> behnken_blocks(std::size_t factors) {
  if (factors == 6) {
    return {{0, 1, 3}, {1, 2, 4}, {2, 3, 5}, {0, 3, 4}, {1, 4, 5}, {0, 2, 5}};
  }
  if (factors == 7) {
    return {{3, 4, 5}, {0, 5, 6}, {1, 4, 6}, {0, 1, 3}, {2, 3, 6}, {0, 2, 4}, {1, 2, 5}};
  }
  std::vector<std::vector<std::size_t>> pairs;
  for (std::size_t i = 0; i < factors; ++i) {
    for (std::size_t j = i + 1; j < factors; ++j) pairs.push_back({i, j});
  }
  return pairs;
}

}  // namespace

Design central_composite(const std::vector<Factor>& factors, const CompositeOptions& options) {
  constexpr std::size_t kLeast = 2, kMax = 6;
  base::Faults errors;
  check_factors(factors, kLeast, kMax, errors);
  check_count("centre runs", options.centre_runs, 0, kMaxCentreRuns, errors);
  if (options.alpha) {
    constexpr double kFarthest = 10;
    errors.require(*options.alpha > 0 && *options.alpha <= kFarthest,
                   {.subject = "alpha",
                    .value = fmt::format("= {:g}:", *options.alpha),
                    .rule = fmt::format("must be more than 0 and at most {:g}", kFarthest),
                    .fix = "1 is on the faces of the cube."});
  }
  errors.throw_if_any();

  const double alpha = alpha_of(options, factors.size());
  const double scale = options.is_inscribed && alpha > 1 ? 1 / alpha : 1;
  Design design{.factors = factors, .runs = {}};
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < factors.size(); ++i) all.push_back(i);
  add_corners(design, all, scale, PointKind::cube);
  for (std::size_t i = 0; i < factors.size(); ++i) {
    add_corners(design, {i}, alpha * scale, PointKind::axial);
  }
  add_centre(design, options.centre_runs);
  return design;
}

Design box_behnken(const std::vector<Factor>& factors, std::optional<int> centre_runs) {
  constexpr std::size_t kLeast = 3, kMax = 7, kSmall = 4;
  base::Faults errors;
  check_factors(factors, kLeast, kMax, errors);
  const int in_the_paper = factors.size() <= kSmall ? 3 : 6;
  check_count("centre runs", centre_runs.value_or(in_the_paper), 0, kMaxCentreRuns, errors);
  errors.throw_if_any();

  Design design{.factors = factors, .runs = {}};
  for (const std::vector<std::size_t>& block : behnken_blocks(factors.size())) {
    add_corners(design, block, 1, PointKind::edge);
  }
  add_centre(design, centre_runs.value_or(in_the_paper));
  return design;
}

Design steepest_ascent(const Regression& regression, int runs, double stride, bool descends) {
  double steepest = 0;
  for (const Coefficient& coefficient : regression.coefficients) {
    if (!coefficient.term.empty()) steepest = std::max(steepest, std::abs(coefficient.value));
  }
  base::Faults errors;
  errors.require(regression.model == SurfaceModel::linear,
                 {.value = "steepest ascent follows a plane", .fix = "fit a linear model."});
  errors.require(std::isfinite(stride) && stride > 0,
                 {.subject = "stride",
                  .value = fmt::format("= {:g}:", stride),
                  .rule = "must be more than 0",
                  .fix = "0.5 is half of the range from the centre to a factor's high level."});
  errors.require(steepest > 0,
                 {.value = "the fitted surface is level: no direction leads up or down",
                  .fix = "name factors that matter."});
  errors.throw_if_any();

  std::vector<std::string> names;
  std::vector<double> start, step;
  for (std::size_t i = 0; i < regression.factors.size(); ++i) {
    const Factor& factor = regression.factors[i];
    const double slope = regression.coefficients[i + 1].value;  // after the constant
    names.push_back(factor.name);
    start.push_back(factor.centre());
    step.push_back((descends ? -1 : 1) * stride * slope / steepest * factor.half_range());
  }
  return line_of_runs(names, start, step, runs);
}

}  // namespace repose::calibrate
