#include "calibrate/experiment/picture_set.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "base/distributions.h"
#include "base/units.h"
#include "calibrate/experiment/heap_angle.h"
#include "vision/measure/repose_angle.h"

namespace repose::calibrate {
namespace {

constexpr double kOutlying = 3.5;
constexpr double kMadToSd = 1.4826;  // for a normal distribution
constexpr std::size_t kFewestForOutliers = 3;

double middle_of(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

bool has_angle(const SetPicture& picture) {
  return picture.angle_deg && counts_in_mean(picture.status);
}

/// Indices of each heap's pictures; heaps in the order of their first pictures.
using Heaps = std::vector<std::vector<std::size_t>>;

template <typename Counts>
Heaps heaps_of(std::span<const SetPicture> pictures, const Counts& counts) {
  Heaps heaps;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (!has_angle(pictures[i]) || !counts(i)) continue;
    const std::string& name = pictures[i].heap;
    const auto same = std::ranges::find_if(
        heaps, [&](const auto& heap) { return pictures[heap.front()].heap == name; });
    if (name.empty() || same == heaps.end()) {
      heaps.push_back({i});
    } else {
      same->push_back(i);
    }
  }
  return heaps;
}

template <typename Number>
double mean_over(const std::vector<std::size_t>& heap, const Number& number) {
  double sum = 0;
  for (const std::size_t i : heap) sum += number(i);
  return sum / static_cast<double>(heap.size());
}

std::vector<double> means_of(std::span<const SetPicture> pictures, const Heaps& heaps) {
  std::vector<double> means;
  for (const auto& heap : heaps) {
    means.push_back(mean_over(heap, [&](std::size_t i) { return *pictures[i].angle_deg; }));
  }
  return means;
}

std::optional<Summary> summary_of(const std::vector<double>& means) {
  return means.empty() ? std::nullopt : std::optional(summarise(means));
}

/// Scatter among pictures of one heap, and the uncertainty common to all.
void count_uncertainty_of(std::span<const SetPicture> pictures, const Heaps& heaps,
                          PictureSet& set) {
  double squares = 0;
  double freedom = 0;
  double inverse = 0;
  double own2 = 0;
  double camera = 0;
  for (std::size_t k = 0; k < heaps.size(); ++k) {
    const auto count = static_cast<double>(heaps[k].size());
    for (const std::size_t i : heaps[k]) {
      squares += std::pow(*pictures[i].angle_deg - set.heaps[k].angle_deg, 2);
    }
    freedom += count - 1;
    inverse += 1 / count;
    own2 += mean_over(heaps[k], [&](std::size_t i) { return std::pow(pictures[i].own_deg, 2); }) /
            count;
    camera += mean_over(heaps[k], [&](std::size_t i) { return pictures[i].camera_deg; });
  }
  if (heaps.empty()) return;
  const auto all = static_cast<double>(heaps.size());
  set.own_deg = std::sqrt(own2 / all);
  set.camera_deg = camera / all;
  if (freedom <= 0) return;
  const double within2 = squares / freedom;
  set.within_sd_deg = std::sqrt(within2);
  if (set.heaps_deg->sd) {
    const double between2 = std::pow(*set.heaps_deg->sd, 2) - within2 * inverse / all;
    set.between_sd_deg = std::sqrt(std::max(0.0, between2));
  }
  for (std::size_t k = 0; k < heaps.size(); ++k) {
    HeapOfSet& heap = set.heaps[k];
    const double alone2 = mean_over(
        heaps[k], [&](std::size_t i) { return std::pow(pictures[i].own_deg, 2) / heap.pictures; });
    const double seen =
        base::student_t_quantile(.975, freedom) * std::sqrt(within2 / heap.pictures);
    heap.within_deg = std::max(seen, std::sqrt(alone2)) + set.camera_deg;
  }
}

std::vector<HeapOfSet> described(std::span<const SetPicture> pictures, const Heaps& heaps) {
  std::vector<HeapOfSet> all;
  for (const auto& heap : heaps) {
    std::vector<double> angles;
    for (const std::size_t i : heap) angles.push_back(*pictures[i].angle_deg);
    const Summary of_pictures = summarise(angles);
    all.push_back({.name = pictures[heap.front()].heap,
                   .pictures = of_pictures.n,
                   .angle_deg = of_pictures.mean,
                   .sd_deg = of_pictures.sd,
                   .within_deg = {}});
  }
  return all;
}

void find_outliers(std::span<const SetPicture> pictures, PictureSet& set) {
  std::vector<double> angles;
  std::vector<double> own;
  for (const SetPicture& picture : pictures) {
    if (!has_angle(picture)) continue;
    angles.push_back(*picture.angle_deg);
    own.push_back(picture.own_deg / base::kNormal95);
  }
  if (angles.empty()) return;
  set.median_deg = middle_of(angles);
  if (angles.size() < kFewestForOutliers) return;
  for (double& angle : angles) angle = std::abs(angle - set.median_deg);
  const double scatter = std::max(kMadToSd * middle_of(angles), middle_of(own));
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (!has_angle(pictures[i])) continue;
    const double off = std::abs(*pictures[i].angle_deg - set.median_deg);
    if (!(off > kOutlying * scatter)) continue;
    set.outliers.push_back({.place = i,
                            .score = scatter > 0 ? off / scatter : off,
                            .is_counted = pictures[i].status == vision::MeasureStatus::ok});
  }
}

}  // namespace

vision::MeasureStatus picture_status_named(std::string_view name) {
  for (const auto status : {vision::MeasureStatus::ok, vision::MeasureStatus::flagged}) {
    if (name == name_of(status)) return status;
  }
  return vision::MeasureStatus::refused;
}

SetPicture set_picture_of(const vision::ReposeAngle& measured, const std::string& heap) {
  SetPicture picture{.status = measured.status, .angle_deg = {}, .heap = heap};
  if (measured.angle_rad) picture.angle_deg = to_degrees(*measured.angle_rad);
  picture.own_deg = to_degrees(measured.own_uncertainty_rad.value_or(0));
  picture.camera_deg = to_degrees(measured.camera_uncertainty_rad.value_or(0));
  return picture;
}

PictureSet set_of_pictures(std::span<const SetPicture> pictures) {
  PictureSet set;
  find_outliers(pictures, set);
  const auto is_counted = [&](std::size_t i) {
    return std::ranges::none_of(set.outliers, [&](const OutlyingPicture& outlier) {
      return outlier.place == i && !outlier.is_counted;
    });
  };
  const Heaps heaps = heaps_of(pictures, is_counted);
  set.heaps = described(pictures, heaps);
  set.heaps_deg = summary_of(means_of(pictures, heaps));
  count_uncertainty_of(pictures, heaps, set);
  set.all_deg =
      summary_of(means_of(pictures, heaps_of(pictures, [](std::size_t) { return true; })));
  set.ok_deg = summary_of(means_of(pictures, heaps_of(pictures, [&](std::size_t i) {
                                     return pictures[i].status == vision::MeasureStatus::ok;
                                   })));
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    if (!has_angle(pictures[i])) {
      ++set.refused;
    } else if (is_counted(i)) {
      ++set.pictures;
      set.flagged += pictures[i].status == vision::MeasureStatus::flagged ? 1 : 0;
    }
  }
  return set;
}

std::string text_of(const OutlyingPicture& outlier, const PictureSet& set, double angle_deg) {
  return fmt::format(
      "{:.2f}° is an outlier: the median of these pictures is {:.2f}°, and it is {:.1f} times "
      "their "
      "scatter away, where 3.5 is allowed. {}",
      angle_deg, set.median_deg, outlier.score,
      outlier.is_counted ? "It counts in the mean, as nothing else is wrong with it: look at it."
                         : "It is flagged besides, and left out of the mean: look at it.");
}

}  // namespace repose::calibrate
