#include "vision/film/frame_times.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include <opencv2/imgproc.hpp>

namespace repose::vision {

namespace {

constexpr std::size_t kFewestStamps = 8;

/// From frames far apart, so that rounding hardly matters; the median ignores the few gaps.
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

/// Least-squares line through the stamps, and their deviations from it in time.
struct Line {
  double at_first_s = 0;
  double step_s = 0;
  double range_s = 0;  ///< from the earliest to the latest deviation
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

/// Counted against a running grid that follows the stamps slowly: single ones may be half a step
/// early or late.
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

/// Several consecutive steps: their median length, and how many are about as long.
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
  constexpr int kMaxOdd = 2;
  std::vector<RateChange> changes;
  int best = 0;  // even steps around the latest change; 0: it has been passed
  for (std::size_t k = kPartSteps; k + kPartSteps < times_s.size(); ++k) {
    const EvenSteps before = even_steps(times_s, k - kPartSteps);
    const EvenSteps after = even_steps(times_s, k);
    const int odd = static_cast<int>(kPartSteps) - std::min(before.alike, after.alike);
    if (odd > kMaxOdd || std::abs(std::log(after.step_s / before.step_s)) < kChange) {
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
  // A fine unit needs no correction; if it is as long as the step itself, as in AVI, stamps are not
  // rounded.
  if (unit_s < kFine * typical_s || unit_s > kCoarse * typical_s) return stamps_s;
  const std::vector<double> steps = whole_steps(stamps_s, typical_s);
  const Line line = line_through(steps, stamps_s);
  if (line.range_s > kRounding * unit_s) return stamps_s;
  for (std::size_t k = 0; k < stamps_s.size(); ++k) stamps_s[k] = line.step_s * steps[k];
  return stamps_s;
}

namespace {

constexpr int kNoise = 12;          ///< grey levels by which noise may change a pixel
constexpr double kMinMoved = 1000;  ///< a grain of 12 pixels moves by one
/// As fractions of the change to nearby frames: maximum for a repeat, minimum for a moving frame.
constexpr double kRepeat = .03, kMoves = .35;
constexpr std::size_t kAround = 6, kLongestRun = 5;
/// Fewer may be chance: the top of a flight, or an impact, half way between two frames. The second
/// is a fraction of the moving frames, used if there is no pattern.
constexpr double kFewestRepeats = 4, kFewestPart = .1;

enum class Kind { undecided, repeat, moving };

double most_around(const std::vector<double>& changes, std::size_t from, std::size_t to) {
  const std::size_t begin = from > kAround ? from - kAround : 1;
  const std::size_t end = std::min(changes.size(), to + kAround + 1);
  return *std::max_element(changes.begin() + static_cast<std::ptrdiff_t>(begin),
                           changes.begin() + static_cast<std::ptrdiff_t>(end));
}

std::vector<Kind> kinds_of(const std::vector<double>& changes) {
  std::vector<Kind> kinds(changes.size(), Kind::undecided);
  for (std::size_t k = 1; k < changes.size(); ++k) {
    const double around = most_around(changes, k, k);
    if (changes[k] >= std::max(kMinMoved, kMoves * around)) kinds[k] = Kind::moving;
  }
  for (std::size_t from = 2; from + 1 < changes.size(); ++from) {
    if (kinds[from] == Kind::moving || kinds[from - 1] != Kind::moving) continue;
    std::size_t to = from;
    while (to + 1 < changes.size() && kinds[to] != Kind::moving) ++to;
    if (kinds[to] != Kind::moving || to - from > kLongestRun) continue;
    const double most = kRepeat * std::min(changes[from - 1], changes[to]);
    const auto first = changes.begin() + static_cast<std::ptrdiff_t>(from);
    const auto last = changes.begin() + static_cast<std::ptrdiff_t>(to);
    if (std::any_of(first, last, [&](double change) { return change > most; })) continue;
    for (std::size_t k = from; k < to; ++k) kinds[k] = Kind::repeat;
  }
  return kinds;
}

/// `taken` frames fill `shown` steps; each step shows the newest one.
struct Pattern {
  int taken = 1;
  int shown = 1;
  int phase = 0;

  long newest_at(double step) const {
    return static_cast<long>(std::floor((taken * step + phase + .5) / static_cast<double>(shown)));
  }
  /// When the frame shown at a step was taken.
  double taken_at(double step) const {
    return (static_cast<double>(newest_at(step)) * shown - phase - .5) / taken;
  }
  bool repeats_at(double step) const { return newest_at(step) == newest_at(step - 1); }
};

/// The shortest pattern that agrees with nearly all clear repeats and moving frames.
std::optional<Pattern> pattern_of(const std::vector<Kind>& kinds,
                                  const std::vector<double>& steps) {
  constexpr int kLongest = 30;
  constexpr double kMaxWrong = .15;
  const auto repeats = static_cast<double>(std::count(kinds.begin(), kinds.end(), Kind::repeat));
  const auto moving = static_cast<double>(std::count(kinds.begin(), kinds.end(), Kind::moving));
  std::optional<Pattern> best;
  double least = kMaxWrong * std::min(repeats, moving);
  for (int shown = 2; shown <= kLongest; ++shown) {
    for (int taken = 1; taken < shown; ++taken) {
      if (std::gcd(shown, taken) != 1) continue;
      for (int phase = 0; phase < shown; ++phase) {
        const Pattern pattern{taken, shown, phase};
        double wrong = 0;
        for (std::size_t k = 1; k < kinds.size() && wrong <= least; ++k) {
          if (kinds[k] == Kind::undecided) continue;
          wrong += pattern.repeats_at(steps[k]) != (kinds[k] == Kind::repeat) ? 1 : 0;
        }
        // A longer one must be much better.
        if (wrong > least || (best && 2 * wrong >= least)) continue;
        best = pattern;
        least = wrong;
      }
    }
  }
  return best;
}

/// The change in the part of a frame that changes most: movement is local, unlike the light of a
/// flickering lamp.
double most_in_a_part(const cv::Mat& changed) {
  constexpr int kPart_px = 32;
  double most = 0;
  for (int y = 0; y < changed.rows; y += kPart_px) {
    for (int x = 0; x < changed.cols; x += kPart_px) {
      const cv::Rect part(x, y, std::min(kPart_px, changed.cols - x),
                          std::min(kPart_px, changed.rows - y));
      most = std::max(most, cv::sum(changed(part))[0]);
    }
  }
  return most;
}

}  // namespace

void RepeatFinder::look(const cv::Mat& bgr) {
  double change = 0;
  if (!before_.empty()) {
    cv::Mat difference, changed;
    cv::absdiff(bgr, before_, difference);
    cv::cvtColor(difference, changed, cv::COLOR_BGR2GRAY);
    cv::threshold(changed, changed, kNoise, 0, cv::THRESH_TOZERO);
    change = most_in_a_part(changed);
  }
  changes_.push_back(change);
  bgr.copyTo(before_);
}

RepeatedFrames RepeatFinder::repeats(const std::optional<std::vector<double>>& steps) const {
  return repeats_among(changes_, steps);
}

RepeatedFrames repeats_among(const std::vector<double>& changes,
                             const std::optional<std::vector<double>>& steps) {
  RepeatedFrames found{.is_repeat = std::vector<bool>(changes.size())};
  const std::vector<Kind> kinds = kinds_of(changes);
  const auto repeats = std::count(kinds.begin(), kinds.end(), Kind::repeat);
  const auto moving = std::count(kinds.begin(), kinds.end(), Kind::moving);
  const auto sure = static_cast<double>(repeats);
  if (sure < kFewestRepeats) return found;
  const auto pattern = steps ? pattern_of(kinds, *steps) : std::nullopt;
  if (!pattern && sure < kFewestPart * static_cast<double>(moving)) return found;
  found.count = static_cast<int>(repeats);
  if (pattern) found.taken_at.emplace(changes.size());
  for (std::size_t k = 0; k < changes.size(); ++k) {
    if (pattern) found.taken_at->at(k) = pattern->taken_at(steps->at(k));
    const bool is_by_pattern = pattern && k > 0 && pattern->repeats_at(steps->at(k));
    found.is_repeat[k] = pattern ? is_by_pattern : kinds[k] == Kind::repeat;
  }
  return found;
}

}  // namespace repose::vision
