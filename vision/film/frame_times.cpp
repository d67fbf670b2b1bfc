#include "vision/film/frame_times.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace repose::vision {
namespace {

constexpr std::size_t kFewestStamps = 8;

/// By frames that are many apart, so that rounding hardly counts; the few gaps do not either.
double typical_step_s(const std::vector<double>& stamps_s) {
  const std::size_t lag = std::clamp<std::size_t>(stamps_s.size() / 4, 1, 64);
  std::vector<double> spans;
  for (std::size_t k = lag; k < stamps_s.size(); ++k) {
    spans.push_back((stamps_s[k] - stamps_s[k - lag]) / static_cast<double>(lag));
  }
  const auto middle = spans.begin() + static_cast<std::ptrdiff_t>(spans.size() / 2);
  std::nth_element(spans.begin(), middle, spans.end());
  return *middle;
}

/// Least squares through the stamps; the grid's line, and how far they lie from it in time.
struct Line {
  double at_first_s = 0;
  double step_s = 0;
  double range_s = 0;  ///< from the earliest to the latest, against the line
  double rms_s = 0;
};

Line line_through(const std::vector<double>& steps, const std::vector<double>& stamps_s) {
  const auto count = static_cast<double>(steps.size());
  double mean_n = 0, mean_t = 0, nn = 0, nt = 0;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    mean_n += steps[k] / count;
    mean_t += stamps_s[k] / count;
  }
  for (std::size_t k = 0; k < steps.size(); ++k) {
    nn += (steps[k] - mean_n) * (steps[k] - mean_n);
    nt += (steps[k] - mean_n) * (stamps_s[k] - mean_t);
  }
  Line line{.step_s = nt / nn};
  line.at_first_s = mean_t - line.step_s * mean_n;
  double least = 0, most = 0, squares = 0;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const double off = stamps_s[k] - line.at_first_s - line.step_s * steps[k];
    least = std::min(least, off);
    most = std::max(most, off);
    squares += off * off / count;
  }
  line.range_s = most - least;
  line.rms_s = std::sqrt(squares);
  return line;
}

/// Counted from where even steps would be by now, which follows the stamps slowly: single ones may
/// come half a step early or late.
std::vector<double> whole_steps(const std::vector<double>& stamps_s, double step_s) {
  constexpr double kFollows = .2;
  std::vector<double> steps = {0};
  double even_s = stamps_s.front();
  for (std::size_t k = 1; k < stamps_s.size(); ++k) {
    const double gone = std::max(1.0, std::round((stamps_s[k] - even_s) / step_s));
    steps.push_back(steps.back() + gone);
    even_s += gone * step_s;
    even_s += kFollows * (stamps_s[k] - even_s);
  }
  return steps;
}

constexpr std::size_t kPartSteps = 8;

/// Some steps from one frame to the next: how long they are, and how many of them are as long.
struct EvenSteps {
  double step_s = 0;
  int alike = 0;
};

EvenSteps even_steps(const std::vector<double>& times_s, std::size_t from) {
  constexpr double kAlike = .02;
  std::array<double, kPartSteps> steps{};
  for (std::size_t k = 0; k < kPartSteps; ++k) steps[k] = times_s[from + k + 1] - times_s[from + k];
  const auto middle = steps.begin() + kPartSteps / 2;
  std::nth_element(steps.begin(), middle, steps.end());
  const double step_s = *middle;
  const auto is_alike = [=](double one) { return std::abs(one - step_s) <= kAlike * step_s; };
  return {step_s, static_cast<int>(std::count_if(steps.begin(), steps.end(), is_alike))};
}

}  // namespace

std::vector<RateChange> rate_changes(const std::vector<double>& times_s) {
  constexpr double kChange = .04;
  constexpr int kMostOdd = 2;
  std::vector<RateChange> changes;
  int best = 0;  // alike of the change that was found last; 0: it is behind
  for (std::size_t k = kPartSteps; k + kPartSteps < times_s.size(); ++k) {
    const EvenSteps before = even_steps(times_s, k - kPartSteps);
    const EvenSteps after = even_steps(times_s, k);
    const int odd = static_cast<int>(kPartSteps) - std::min(before.alike, after.alike);
    if (odd > kMostOdd || std::abs(std::log(after.step_s / before.step_s)) < kChange) {
      best = 0;
      continue;
    }
    const RateChange change = {k, before.step_s, after.step_s};
    if (best == 0) changes.push_back(change);
    if (before.alike + after.alike <= best) continue;
    best = before.alike + after.alike;
    changes.back() = change;
  }
  return changes;
}

std::optional<FrameGrid> grid_of(const std::vector<double>& stamps_s) {
  if (stamps_s.size() < kFewestStamps) return std::nullopt;
  const double typical_s = typical_step_s(stamps_s);
  if (typical_s <= 0) return std::nullopt;
  FrameGrid grid{.steps = whole_steps(stamps_s, typical_s)};
  const Line line = line_through(grid.steps, stamps_s);
  grid.step_s = line.step_s;
  grid.off = line.rms_s / line.step_s;
  return grid;
}

std::vector<double> unrounded_times(std::vector<double> stamps_s, double unit_s) {
  if (stamps_s.size() < kFewestStamps || unit_s <= 0) return stamps_s;
  const double typical_s = typical_step_s(stamps_s);
  constexpr double kFine = .02, kCoarse = .5, kRounding = 1.02;
  // Of a fine unit nothing is to be gained; of one as long as the step itself, as AVI has it, no
  // stamp is rounded.
  if (unit_s < kFine * typical_s || unit_s > kCoarse * typical_s) return stamps_s;
  const std::vector<double> steps = whole_steps(stamps_s, typical_s);
  const Line line = line_through(steps, stamps_s);
  if (line.range_s > kRounding * unit_s) return stamps_s;
  for (std::size_t k = 0; k < stamps_s.size(); ++k) stamps_s[k] = line.step_s * steps[k];
  return stamps_s;
}

}  // namespace repose::vision
