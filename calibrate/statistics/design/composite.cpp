#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"
#include "calibrate/statistics/design/design.h"
#include "calibrate/statistics/factor_rules.h"

namespace repose::calibrate {
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

/// Every combination of -size and +size of the named factors, the first of them fastest.
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

/// Blocks of factors that move together; numbered from 0. Box and Behnken (1960), table 1.
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
  constexpr std::size_t kLeast = 2, kMost = 6;
  base::Faults errors;
  check_factors(factors, kLeast, kMost, errors);
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
  constexpr std::size_t kLeast = 3, kMost = 7, kSmall = 4;
  base::Faults errors;
  check_factors(factors, kLeast, kMost, errors);
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

}  // namespace repose::calibrate
