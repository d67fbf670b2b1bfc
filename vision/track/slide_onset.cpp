#include "vision/track/slide_onset.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include <opencv2/core.hpp>

#include "vision/measure/line_fit.h"

namespace repose::vision {
namespace {

/// Error of a subpixel position, as found in rendered videos.
constexpr double kMinSlideNoise_px = .1;
/// Errors of neighbouring places are correlated: this many count as one.
constexpr double kAlikeInSlide = 3;
constexpr double kChiSquare95 = 3.84;

/// A value for each place, minus its mean and the part proportional to the plate's rotation.
class FitColumn {
 public:
  template <typename Value>
  FitColumn(std::span<const SlidAt> places, const Value& value) {
    const auto count = static_cast<double>(places.size());
    double mean = 0, mean_turn = 0, turns = 0, product = 0;
    for (const SlidAt& one : places) {
      mean += value(one) / count;
      mean_turn += one.turned_rad / count;
    }
    for (const SlidAt& one : places) {
      const double turn = one.turned_rad - mean_turn;
      turns += turn * turn;
      product += turn * value(one);
    }
    const double slope = turns > 0 ? product / turns : 0;
    for (const SlidAt& one : places) {
      values_.push_back(value(one) - mean - slope * (one.turned_rad - mean_turn));
    }
  }
  double dot(const FitColumn& other) const {
    return std::inner_product(values_.begin(), values_.end(), other.values_.begin(), 0.0);
  }

 private:
  std::vector<double> values_;
};

/// Residual sum of squares of a slide that begins at a given time.
double squares_left(std::span<const SlidAt> places, const FitColumn& slid, double begin_s) {
  const FitColumn step(places, [&](const SlidAt& one) {
    const double t = std::max(0.0, one.time_s - begin_s);
    return .5 * t * t;
  });
  const FitColumn growth(places, [&](const SlidAt& one) {
    const double t = std::max(0.0, one.time_s - begin_s);
    return t * t * t / 6;
  });
  const double aa = step.dot(step), aj = step.dot(growth), jj = growth.dot(growth);
  const double as = step.dot(slid), js = growth.dot(slid), ss = slid.dot(slid);
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

/// The place a moment earlier.
std::size_t shortly_before(std::span<const SlidAt> places, std::size_t place) {
  constexpr double kMoment_s = .12;
  std::size_t before = place;
  while (before > 0 && places[place].time_s - places[before].time_s < kMoment_s) --before;
  return before;
}

/// The last place at which the object stands still: after it comes the slide proper; before it the
/// object may have crept.
std::size_t last_at_rest(std::span<const SlidAt> places, double still_px) {
  std::size_t k = places.size() - 1;
  while (k > 0 && places[k].slid_px - places[shortly_before(places, k)].slid_px >= still_px) --k;
  return k;
}

/// The first of the places before that one, within a limited time, between which the object stands
/// still.
std::size_t first_at_rest(std::span<const SlidAt> places, std::size_t last, double still_px) {
  constexpr double kBefore_s = 1.5;  // before the slide is seen
  std::size_t first = last;
  while (first > 0 && places[first - 1].time_s > places[last].time_s - kBefore_s &&
         std::abs(places[first - 1].slid_px - places[shortly_before(places, first)].slid_px) <
             still_px)
    --first;
  return first;
}

/// By second differences, which steady motion does not affect.
double noise_of(std::span<const SlidAt> rest) {
  std::vector<double> bends;
  for (std::size_t k = 2; k < rest.size(); ++k) {
    bends.push_back(std::abs(rest[k].slid_px - 2 * rest[k - 1].slid_px + rest[k - 2].slid_px));
  }
  if (bends.empty()) return 0;
  return kMadToSigma * median(bends) / std::sqrt(6);
}

/// The largest distance between the medians of short stretches, after removing what a misplaced
/// hinge explains: an apparent motion with the cosine and the sine of the plate's angle.
double crept_before(const std::vector<SlidAt>& places, double onset_s) {
  constexpr double kStretch_s = .3, kRidge = 1e-9;
  const auto terms_of = [](const SlidAt& one) {
    return cv::Vec3d(1, std::cos(one.turned_rad), std::sin(one.turned_rad));
  };
  cv::Matx33d normal = kRidge * cv::Matx33d::eye();
  cv::Vec3d right(0, 0, 0);
  for (const SlidAt& one : places) {
    if (one.time_s >= onset_s) break;
    normal += terms_of(one) * terms_of(one).t();
    right += one.slid_px * terms_of(one);
  }
  const cv::Vec3d solution = normal.solve(right, cv::DECOMP_CHOLESKY);
  double least = 0, most = 0;
  std::vector<double> off;
  double begin_s = places.front().time_s;
  for (const SlidAt& one : places) {
    if (one.time_s >= begin_s + kStretch_s) {
      least = std::min(least, median(off));
      most = std::max(most, median(off));
      off.clear();
      begin_s = one.time_s;
    }
    if (one.time_s >= onset_s) break;
    off.push_back(one.slid_px - solution.dot(terms_of(one)));
  }
  return most - least;
}

/// A time without places around a given time: longer than three typical steps, otherwise none.
struct Unseen {
  double from_s = 0;
  double to_s = 0;
};

std::optional<Unseen> unseen_around(std::span<const SlidAt> places, double time_s) {
  constexpr double kUsualSteps = 3;
  std::vector<double> steps;
  for (std::size_t k = 1; k < places.size(); ++k) {
    steps.push_back(places[k].time_s - places[k - 1].time_s);
  }
  const auto after = std::find_if(places.begin(), places.end(),
                                  [=](const SlidAt& one) { return one.time_s > time_s; });
  if (after == places.begin() || after == places.end()) return std::nullopt;
  const Unseen gap = {std::prev(after)->time_s, after->time_s};
  if (gap.to_s - gap.from_s < kUsualSteps * median(steps)) return std::nullopt;
  return gap;
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
  const FitColumn slid(fitted, [](const SlidAt& one) { return one.slid_px; });
  std::vector<std::pair<double, double>> profile;
  const double until_s = std::max(seen_s + 2 * interval_s, places[rest + 1].time_s);
  for (double t = fitted.front().time_s; t <= until_s; t += interval_s / kParts) {
    profile.emplace_back(t, squares_left(fitted, slid, t));
  }
  const auto best =
      std::min_element(profile.begin(), profile.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  const double free = std::max(1.0, static_cast<double>(fitted.size()) - 5);
  const double variance = std::max(best->second / free, kMinSlideNoise_px * kMinSlideNoise_px);
  const double limit = best->second + kChiSquare95 * kAlikeInSlide * variance;
  auto earliest = best, latest = best;
  while (earliest != profile.begin() && std::prev(earliest)->second <= limit) --earliest;
  while (std::next(latest) != profile.end() && std::next(latest)->second <= limit) ++latest;
  if (earliest == profile.begin()) return std::nullopt;
  const Unseen unseen =
      unseen_around(fitted, best->first).value_or(Unseen{earliest->first, earliest->first});
  return SlideOnset{.time_s = best->first,
                    .earliest_s = std::min(earliest->first, unseen.from_s),
                    .latest_s = std::max(latest->first, unseen.to_s),
                    .unseen_s = unseen.to_s - unseen.from_s,
                    .rms_px = std::sqrt(best->second / free),
                    .rest_noise_px = noise,
                    .crept_px = crept_before(places, best->first)};
}

}  // namespace repose::vision
