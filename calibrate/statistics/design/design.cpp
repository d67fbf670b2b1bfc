#include "calibrate/statistics/design/design.h"

#include <cmath>
#include <set>
#include <utility>

#include "base/input_error.h"
#include "base/random.h"
#include "calibrate/statistics/factor_rules.h"

namespace repose::calibrate {
namespace {

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
    // One coded unit is one step; a factor that stays has any range.
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
  // Fisher and Yates' shuffle; 53 random bits over so few runs are even to 1e-12.
  base::Random random(seed);
  for (std::size_t left = design.runs.size(); left > 1; --left) {
    const auto pick = static_cast<std::size_t>(random.uniform() * static_cast<double>(left));
    std::swap(design.runs[left - 1], design.runs[pick]);
  }
}

}  // namespace repose::calibrate
