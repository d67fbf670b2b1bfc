#include "vision/film/repeat_finder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include <opencv2/imgproc.hpp>

namespace repose::vision {
namespace {

constexpr int kNoise = 12;            ///< grey levels that a pixel may change by itself
constexpr double kLeastMoved = 1000;  ///< a grain of 12 pixels moves by one
/// Of the change to the frames around: a repeat's at most, a moving one's at least.
constexpr double kRepeat = .03, kMoves = .35;
constexpr std::size_t kAround = 6, kLongestRun = 5;
/// Fewer may be chance: the top of a flight, or an impact, half way between two frames. Of those
/// that move, where there is no pattern in them.
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
    if (changes[k] >= std::max(kLeastMoved, kMoves * around)) kinds[k] = Kind::moving;
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

/// Of `shown` frames each pattern shows `taken` ones; the frame at a step shows the newest one.
struct Pattern {
  int taken = 1;
  int shown = 1;
  int phase = 0;

  long newest_at(double step) const {
    return static_cast<long>(std::floor((taken * step + phase + .5) / static_cast<double>(shown)));
  }
  /// When the frame was taken that is shown at a step.
  double taken_at(double step) const {
    return (static_cast<double>(newest_at(step)) * shown - phase - .5) / taken;
  }
  bool repeats_at(double step) const { return newest_at(step) == newest_at(step - 1); }
};

/// The shortest pattern that tells nearly all repeats that are sure from those that are none.
std::optional<Pattern> pattern_of(const std::vector<Kind>& kinds,
                                  const std::vector<double>& steps) {
  constexpr int kLongest = 30;
  constexpr double kMostWrong = .15;
  const auto repeats = static_cast<double>(std::count(kinds.begin(), kinds.end(), Kind::repeat));
  const auto moving = static_cast<double>(std::count(kinds.begin(), kinds.end(), Kind::moving));
  std::optional<Pattern> best;
  double least = kMostWrong * std::min(repeats, moving);
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

/// Of all parts of a frame the one in which most changes: what moves is there, and not all over, as
/// the light of a flickering lamp.
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
