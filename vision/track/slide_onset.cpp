#include "vision/track/slide_onset.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace repose::vision {
namespace {

/// Of a place between whole pixels, as drawn films show it.
constexpr double kLeastNoise_px = .1;
/// So long before the slide is seen the rest is looked at, and the onset is sought.
constexpr double kBefore_s = 1.5;
/// Neighbouring places err alike: so many count as one.
constexpr double kAlike = 3;
constexpr double kChiSquare95 = 3.84;

double median_of(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Sum of squares of what a slide that begins at a time leaves over.
double squares_left(std::span<const SlidAt> places, double begin_s) {
  // The two terms as far as they are free of the place at rest and of each other.
  const auto count = static_cast<double>(places.size());
  const auto step = [&](const SlidAt& one) {
    const double t = std::max(0.0, one.time_s - begin_s);
    return .5 * t * t;
  };
  const auto growth = [&](const SlidAt& one) {
    const double t = std::max(0.0, one.time_s - begin_s);
    return t * t * t / 6;
  };
  double mean_a = 0, mean_j = 0, mean_s = 0;
  for (const SlidAt& one : places) {
    mean_a += step(one) / count;
    mean_j += growth(one) / count;
    mean_s += one.slid_px / count;
  }
  double aa = 0, aj = 0, jj = 0, as = 0, js = 0, ss = 0;
  for (const SlidAt& one : places) {
    const double a = step(one) - mean_a, j = growth(one) - mean_j, s = one.slid_px - mean_s;
    aa += a * a;
    aj += a * j;
    jj += j * j;
    as += a * s;
    js += j * s;
    ss += s * s;
  }
  double left = ss;
  if (aa > 0 && as > 0) left = std::min(left, ss - as * as / aa);
  if (jj > 0 && js > 0) left = std::min(left, ss - js * js / jj);
  const double determinant = aa * jj - aj * aj;
  if (determinant > 1e-12 * aa * jj) {
    const double a = (as * jj - js * aj) / determinant, j = (js * aa - as * aj) / determinant;
    if (a > 0 && j > 0) left = std::min(left, ss - a * as - j * js);
  }
  return std::max(0.0, left);
}

/// The number of the last place at which it stands still: what comes after is the slide proper,
/// what came before may have crept.
std::size_t last_at_rest(std::span<const SlidAt> places, double still_px) {
  constexpr double kLook_s = .12;
  std::size_t k = places.size() - 1;
  for (std::size_t before = k; k > 0; --k) {
    before = std::min(before, k);
    while (before > 0 && places[k].time_s - places[before].time_s < kLook_s) --before;
    if (places[k].slid_px - places[before].slid_px < still_px) break;
  }
  return k;
}

/// The first of the places before that one, up to a while before, between which it does not move.
std::size_t first_at_rest(std::span<const SlidAt> places, std::size_t last, double still_px) {
  std::size_t first = last;
  while (first > 0 && places[first - 1].time_s > places[last].time_s - kBefore_s &&
         std::abs(places[first - 1].slid_px - places[last].slid_px) < 2 * still_px)
    --first;
  return first;
}

double noise_of(std::span<const SlidAt> rest) {
  constexpr double kSigmaPerMad = 1.4826;
  std::vector<double> steps;
  for (std::size_t k = 1; k < rest.size(); ++k) {
    steps.push_back(std::abs(rest[k].slid_px - rest[k - 1].slid_px));
  }
  return kSigmaPerMad * median_of(steps) / std::sqrt(2);
}

double crept_before(const std::vector<SlidAt>& places, double onset_s) {
  constexpr double kStretch_s = .3;
  std::vector<double> first, last;
  for (const SlidAt& one : places) {
    if (one.time_s < places.front().time_s + kStretch_s) first.push_back(one.slid_px);
    if (one.time_s > onset_s - kStretch_s && one.time_s < onset_s) last.push_back(one.slid_px);
  }
  return last.empty() ? 0 : median_of(last) - median_of(first);
}

}  // namespace

std::optional<SlideOnset> slide_onset(const std::vector<SlidAt>& places, double least_px,
                                      double most_px) {
  constexpr std::size_t kFewest = 3, kFewestSliding = 4;
  constexpr double kStill_px = .4, kSigmas = 5;
  const auto gone = std::find_if(places.begin(), places.end(),
                                 [&](const SlidAt& one) { return one.slid_px > least_px; });
  if (gone == places.end()) return std::nullopt;
  const auto end =
      std::find_if(gone, places.end(), [&](const SlidAt& one) { return one.slid_px > most_px; });
  const auto count = static_cast<std::size_t>(end - places.begin());
  const double noise = noise_of({places.begin(), gone});
  const double still_px = std::max(kStill_px, kSigmas * noise);
  const std::size_t rest = last_at_rest({places.data(), count}, still_px);
  const std::size_t from = first_at_rest(places, rest, still_px);
  if (rest < from + kFewest || count < rest + kFewestSliding) return std::nullopt;
  const double seen_s = places[rest].time_s;
  const std::span<const SlidAt> fitted(places.data() + from, count - from);

  const double interval_s =
      (fitted.back().time_s - fitted.front().time_s) / static_cast<double>(fitted.size() - 1);
  constexpr double kParts = 20;  // of the time between frames
  std::vector<std::pair<double, double>> profile;
  for (double t = fitted.front().time_s; t <= seen_s + 2 * interval_s; t += interval_s / kParts) {
    profile.emplace_back(t, squares_left(fitted, t));
  }
  const auto best =
      std::min_element(profile.begin(), profile.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  const double free = std::max(1.0, static_cast<double>(fitted.size()) - 4);
  const double variance = std::max(best->second / free, kLeastNoise_px * kLeastNoise_px);
  const double limit = best->second + kChiSquare95 * kAlike * variance;
  auto earliest = best, latest = best;
  while (earliest != profile.begin() && std::prev(earliest)->second <= limit) --earliest;
  while (std::next(latest) != profile.end() && std::next(latest)->second <= limit) ++latest;
  if (earliest == profile.begin()) return std::nullopt;
  return SlideOnset{.time_s = best->first,
                    .earliest_s = earliest->first,
                    .latest_s = latest->first,
                    .rms_px = std::sqrt(best->second / free),
                    .rest_noise_px = noise,
                    .crept_px = crept_before(places, best->first)};
}

}  // namespace repose::vision
