#include "dem/experiment/flank_line.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace repose::dem {
namespace {

constexpr std::size_t kFewestColumns = 12;
/// So many grains of flank must be left above an apron. Over fewer the slope is a grain's, and one
/// that sticks out makes an apron of what is below it: twelve heaps of 455 hazelnuts, alike but for
/// their seeds, scattered by 2.7 degrees and the views of one by 2.4, instead of 2.2 and 1.6.
/// Proved by SurfaceProfile.AHollowFootOfFewLargeGrainsIsNoApron.
constexpr double kFewestGrains = 5;
/// A line that would meet the crest's axis higher than this many times the crest is the edge of a
/// plateau, such as the outermost grain of a layer, and no slope. It is 1 for a cone; the mean of a
/// heap of hazelnuts is up to 1.7, and was 14 and 15 for layers of them. Proved by
/// SurfaceProfile.ALayerHasNoFlank and AHeapWithAFlatTopHasFlanks.
constexpr double kHighestAtCrest = 3;

struct Window {
  std::size_t first = 0;
  std::size_t last = 0;  ///< one past the end
  std::size_t size() const { return last > first ? last - first : 0; }
};

/// Weighted least squares through the window.
FlankLine weighted_line(const std::vector<double>& flank, const Window& window,
                        const std::vector<double>& weight) {
  double sum = 0;
  double sum_x = 0;
  double sum_y = 0;
  for (std::size_t k = 0; k < window.size(); ++k) {
    sum += weight[k];
    sum_x += weight[k] * static_cast<double>(window.first + k);
    sum_y += weight[k] * flank[window.first + k];
  }
  const double mean_x = sum_x / sum;
  const double mean_y = sum_y / sum;
  double square = 0;
  double product = 0;
  for (std::size_t k = 0; k < window.size(); ++k) {
    const double off = static_cast<double>(window.first + k) - mean_x;
    square += weight[k] * off * off;
    product += weight[k] * off * (flank[window.first + k] - mean_y);
  }
  const double fall = square > 0 ? -product / square : 0;
  return {.at_crest = mean_y + fall * mean_x, .fall = fall};
}

FlankLine plain_line(const std::vector<double>& flank, const Window& window) {
  return weighted_line(flank, window, std::vector<double>(window.size(), 1.0));
}

/// Tukey's biweight, by reweighting from the plain line on.
FlankLine robust_line(const std::vector<double>& flank, const Window& window) {
  constexpr int kRounds = 20;
  constexpr double kMadToSigma = 1.4826;
  constexpr double kCutoff = 4.685;
  FlankLine line = plain_line(flank, window);
  std::vector<double> off(window.size());
  std::vector<double> weight(window.size());
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t k = 0; k < off.size(); ++k) {
      const auto x = static_cast<double>(window.first + k);
      off[k] = std::abs(flank[window.first + k] - (line.at_crest - line.fall * x));
    }
    std::vector<double> sorted = off;
    const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
    std::nth_element(sorted.begin(), middle, sorted.end());
    const double reach = kCutoff * kMadToSigma * *middle;
    if (reach <= 0) break;  // most points lie on the line
    for (std::size_t k = 0; k < off.size(); ++k) {
      const double fraction = std::min(1.0, off[k] / reach);
      weight[k] = (1 - fraction * fraction) * (1 - fraction * fraction);
    }
    line = weighted_line(flank, window, weight);
  }
  return line;
}

std::size_t first_below(const std::vector<double>& smooth, std::size_t from, double height) {
  while (from < smooth.size() && smooth[from] >= height) ++from;
  return from;
}

Window window_between(const Flank& flank, double low, double high) {
  constexpr int kRounds = 4;
  Window window;
  window.first = first_below(flank.smooth, 0, high);
  window.last = first_below(flank.smooth, window.first, low);
  const double columns = static_cast<double>(flank.height.size());
  const auto column = [columns](double place) {
    return static_cast<std::size_t>(std::clamp(std::ceil(place), 0.0, columns));
  };
  for (int round = 0; round < kRounds && window.size() >= kFewestColumns; ++round) {
    const FlankLine line = plain_line(flank.height, window);
    if (line.fall <= 0) break;
    const Window next{column((line.at_crest - high) / line.fall),
                      column((line.at_crest - low) / line.fall)};
    if (next.size() < kFewestColumns) break;
    window = next;
  }
  return window;
}

/// What counts for a grain's size, m.
double grain_m(const Flank& flank, const Window& window) {
  constexpr double kLargest = .2;  // of the crest's height
  const FlankLine line = plain_line(flank.height, window);
  const auto is_above = [&](std::size_t k) {
    return flank.height[k] >= line.at_crest - line.fall * static_cast<double>(k);
  };
  int crossings = 0;
  for (std::size_t k = window.first + 1; k < window.last; ++k) {
    crossings += !is_above(k - 1) && is_above(k) ? 1 : 0;
  }
  const double length_m = static_cast<double>(window.size() - 1) * flank.column_m;
  return std::min(length_m / std::max(1, crossings), kLargest * flank.crest_m);
}

/// Column where the apron begins; the window's end without one.
std::size_t apron_start(const Flank& flank, const Window& window, double two_grains_m) {
  const FlankLine upper =
      plain_line(flank.height, {window.first, window.first + window.size() / 2});
  if (upper.fall <= 0) return window.last;
  const auto two_grains = static_cast<std::size_t>(two_grains_m / flank.column_m);
  for (std::size_t k = window.first + window.size() / 2; k < window.last; ++k) {
    const auto to_foot = static_cast<double>(flank.height.size() - 1 - k);
    const bool is_thin = flank.smooth[k] < two_grains_m;
    if (is_thin && to_foot * upper.fall > 2 * flank.smooth[k]) return k;
    const std::size_t half = std::min(k, std::max({two_grains, window.size() / 8, std::size_t{4}}));
    if (k + half >= flank.height.size()) break;
    if (plain_line(flank.height, {k - half, k + half}).fall < upper.fall / 3) return k;
  }
  return window.last;
}

}  // namespace

std::optional<FlankLine> fit_flank_line(const Flank& flank, double low, double high) {
  Window window = window_between(flank, low, high);
  if (window.size() < kFewestColumns) return std::nullopt;
  const double grain = grain_m(flank, window);
  const std::size_t cut = apron_start(flank, window, 2 * grain);
  const auto left_m = static_cast<double>(cut - window.first) * flank.column_m;
  if (left_m > kFewestGrains * grain && cut > window.first + kFewestColumns) {
    window.last = std::min(window.last, cut);
  }
  const FlankLine line = robust_line(flank.height, window);
  const bool is_slope = line.fall > 0 && line.at_crest <= kHighestAtCrest * flank.crest_m;
  return is_slope ? std::optional(line) : std::nullopt;
}

}  // namespace repose::dem
