#include "vision/compare/heap_sets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "base/distributions.h"
#include "base/input_error.h"
#include "vision/compare/angle_difference.h"
#include "vision/compare/skyline.h"

namespace repose::vision {

namespace {

/// The mean outlines of two sets, in one unit.
struct MeanOutlines {
  LengthUnit unit = LengthUnit::root_area;
  std::array<MeanOutline, 2> sets;
  std::array<int, 2> left_out = {};  ///< pictures without a whole outline with both flanks
};

constexpr int kPlaces = 401;  // along the ground: closer than the pixels of a chart

constexpr double kBandFrom = 0.1;  // of the pictures

constexpr double kBandTo = 0.9;

/// The outlines of a heap's views, in the unit of comparison, with axes at 0.
using Outlines = std::vector<Skyline>;

bool is_whole(const ReposeAngle& view) {
  const bool has_outline = view.status != MeasureStatus::refused || view.outline_valid;
  return has_outline && !view.left.leaves_frame && !view.right.leaves_frame;
}

double area_of(const Skyline& skyline) {
  return difference_of(skyline, skyline, skyline.front().along, skyline.back().along).covered;
}

Outlines outlines_of(const SeenHeap& heap, LengthUnit unit, int& left_out) {
  Outlines outlines;
  for (const ReposeAngle& view : heap.views) {
    const bool is_usable = is_whole(view);
    const StandingHeap standing = is_usable ? standing_heap(view) : StandingHeap{};
    if (!is_usable || !standing.axis || area_of(standing.skyline) <= 0) {
      ++left_out;
      continue;
    }
    const double factor =
        unit == LengthUnit::metre ? *heap.m_per_px : 1 / std::sqrt(area_of(standing.skyline));
    outlines.push_back(placed(standing.skyline, *standing.axis, factor));
  }
  return outlines;
}

/// Heights of an outline at ascending positions.
std::vector<double> heights_at(const Skyline& skyline, const std::vector<double>& places) {
  std::vector<double> heights;
  heights.reserve(places.size());
  for (const double place : places) heights.push_back(height_at(skyline, place));
  return heights;
}

/// Quantile of sorted values, linearly interpolated.
double quantile(const std::vector<double>& sorted, double part) {
  const double rank = part * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(rank);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], rank - static_cast<double>(below));
}

MeanOutline mean_of(const std::vector<Outlines>& heaps, const std::vector<double>& places) {
  MeanOutline result;
  std::vector<double> mean(places.size(), 0);
  std::vector<std::vector<double>> pictures(places.size());
  int heaps_seen = 0;
  for (const Outlines& heap : heaps) {
    if (heap.empty()) continue;
    ++heaps_seen;
    for (const Skyline& view : heap) {
      ++result.pictures;
      const std::vector<double> heights = heights_at(view, places);
      for (std::size_t i = 0; i < places.size(); ++i) {
        mean[i] += heights[i] / static_cast<double>(heap.size());
        pictures[i].push_back(heights[i]);
      }
    }
  }
  if (heaps_seen == 0) return result;
  for (std::size_t i = 0; i < places.size(); ++i) {
    result.mean.push_back({places[i], mean[i] / heaps_seen});
    if (result.pictures < 2) continue;
    std::sort(pictures[i].begin(), pictures[i].end());
    result.low.push_back({places[i], quantile(pictures[i], kBandFrom)});
    result.high.push_back({places[i], quantile(pictures[i], kBandTo)});
  }
  return result;
}

std::vector<double> places_for(const std::array<std::vector<Outlines>, 2>& sets) {
  double from = std::numeric_limits<double>::infinity(), to = -from;
  for (const std::vector<Outlines>& set : sets) {
    for (const Outlines& heap : set) {
      for (const Skyline& view : heap) {
        from = std::min(from, view.front().along);
        to = std::max(to, view.back().along);
      }
    }
  }
  std::vector<double> places;
  if (!(from < to)) return places;
  for (int i = 0; i < kPlaces; ++i) {
    places.push_back(std::lerp(from, to, static_cast<double>(i) / (kPlaces - 1)));
  }
  return places;
}

bool have_scales(const std::array<const std::vector<SeenHeap>*, 2>& sets) {
  return std::all_of(sets.begin(), sets.end(), [](const std::vector<SeenHeap>* set) {
    return std::all_of(set->begin(), set->end(),
                       [](const SeenHeap& heap) { return heap.m_per_px.has_value(); });
  });
}

/// In metres if every heap has a scale; otherwise each outline is scaled to the same area.
MeanOutlines mean_outlines(const std::array<const std::vector<SeenHeap>*, 2>& sets) {
  MeanOutlines result;
  result.unit = have_scales(sets) ? LengthUnit::metre : LengthUnit::root_area;
  std::array<std::vector<Outlines>, 2> outlines;
  for (const std::size_t i : {0, 1}) {
    for (const SeenHeap& heap : *sets[i]) {
      outlines[i].push_back(outlines_of(heap, result.unit, result.left_out[i]));
    }
  }
  const std::vector<double> places = places_for(outlines);
  for (const std::size_t i : {0, 1}) result.sets[i] = mean_of(outlines[i], places);
  return result;
}

constexpr double kUpperTail = 0.975;
constexpr int kMaxHeaps = 1000;  // more would be unhelpful advice

using Sets = std::array<const std::vector<SeenHeap>*, 2>;

std::optional<double> angle_of(const SeenHeap& heap) {
  double sum = 0;
  std::size_t counted = 0;
  for (const ReposeAngle& view : heap.views) {
    if (view.status == MeasureStatus::refused || !view.angle_rad) continue;
    sum += *view.angle_rad;
    ++counted;
  }
  if (2 * counted < heap.views.size()) return std::nullopt;
  return sum / static_cast<double>(counted);
}

SetOfHeaps summary_of(const std::vector<SeenHeap>& heaps) {
  SetOfHeaps set;
  double sum = 0;
  for (const SeenHeap& heap : heaps) {
    set.angle_rad.push_back(angle_of(heap));
    if (!set.angle_rad.back()) continue;
    sum += *set.angle_rad.back();
    ++set.counted;
  }
  if (set.counted == 0) return set;
  set.mean_rad = sum / set.counted;
  if (set.counted < 2) return set;
  double squares = 0;
  for (const std::optional<double>& angle : set.angle_rad) {
    if (angle) squares += (*angle - *set.mean_rad) * (*angle - *set.mean_rad);
  }
  set.sd_rad = std::sqrt(squares / (set.counted - 1));
  set.uncertainty_rad =
      base::student_t_quantile(kUpperTail, set.counted - 1) * *set.sd_rad / std::sqrt(set.counted);
  return set;
}

/// Scatter of single heaps; a set of one heap borrows that of the other set.
std::array<double, 2> scatter_of(const std::array<SetOfHeaps, 2>& sets) {
  return {sets[0].sd_rad.value_or(sets[1].sd_rad.value_or(0)),
          sets[1].sd_rad.value_or(sets[0].sd_rad.value_or(0))};
}

/// Half-width of the 95 % interval of the difference of two means of n1 and n2 heaps.
double half_width(const std::array<double, 2>& sd, const std::array<int, 2>& n) {
  const base::EstimatedVariance first{sd[0] * sd[0] / n[0], n[0] - 1.};
  const base::EstimatedVariance second{sd[1] * sd[1] / n[1], n[1] - 1.};
  const double variance = first.variance + second.variance;
  if (variance == 0) return 0;
  const bool is_borrowed = n[0] < 2 || n[1] < 2;
  const double df = is_borrowed ? first.df + second.df : base::df_of_sum(first, second);
  return base::student_t_quantile(kUpperTail, df) * std::sqrt(variance);
}

/// Heaps needed in each set until the interval about the same difference excludes 0 or lies within
/// the margin.
std::optional<int> heaps_to_tell(const std::array<double, 2>& sd, double difference_rad,
                                 double margin_rad) {
  const double distance = std::abs(difference_rad);
  const double enough = std::max(distance, margin_rad - distance);
  for (int n = 2; n <= kMaxHeaps; ++n) {
    if (half_width(sd, {n, n}) <= enough) return n;
  }
  return std::nullopt;
}

void compare_angles(SetComparison& result, double margin_rad) {
  const SetOfHeaps& first = result.sets[0];
  const SetOfHeaps& second = result.sets[1];
  if (!first.mean_rad || !second.mean_rad || (!first.sd_rad && !second.sd_rad)) return;
  const std::array<double, 2> sd = scatter_of(result.sets);
  const double uncertainty = half_width(sd, {first.counted, second.counted});
  result.angle =
      angle_difference({*first.mean_rad, uncertainty}, {*second.mean_rad, 0}, margin_rad, false);
  if (result.angle->verdict == Agreement::cannot_tell) {
    result.heaps_to_tell = heaps_to_tell(sd, result.angle->difference_rad, margin_rad);
  }
}

void compare_outlines(SetComparison& result) {
  const Skyline& first = result.sets[0].outline.mean;
  const Skyline& second = result.sets[1].outline.mean;
  if (first.empty() || second.empty()) return;
  const SkylineDifference difference =
      difference_of(first, second, first.front().along, first.back().along);
  result.iou = difference.iou();
  result.profile_rmse = difference.rmse();
  if (result.unit == LengthUnit::metre) result.profile_mean = difference.mean();
}

void note(SetComparison& result, std::string code, std::string message) {
  result.warnings.push_back({std::move(code), std::move(message)});
}

void add_notes(SetComparison& result, const MeanOutlines& outlines) {
  constexpr std::array kSets = {"first", "second"};
  for (const std::size_t i : {0, 1}) {
    const SetOfHeaps& set = result.sets[i];
    const int without = static_cast<int>(set.angle_rad.size()) - set.counted;
    if (without > 0) {
      note(result, "heaps_without_angle",
           fmt::format("{} of {} heaps of the {} set have no angle and are left out of its mean: "
                       "half of their pictures or more were refused.",
                       without, set.angle_rad.size(), kSets[i]));
    }
    if (outlines.left_out[i] > 0) {
      note(
          result, "pictures_without_outline",
          fmt::format("{} of {} pictures of the {} set do not show a whole heap with two flanks "
                      "and are left out of its mean outline.",
                      outlines.left_out[i], outlines.left_out[i] + set.outline.pictures, kSets[i]));
    }
    if (set.counted == 1) {
      note(result, "one_heap",
           fmt::format("The {} set has only one heap: the scatter between heaps is {}.", kSets[i],
                       result.angle ? "taken from the other set" : "unknown"));
    }
  }
  if (result.unit != LengthUnit::metre && result.iou) {
    note(result, "no_scale",
         "Without a scale for both sets only shapes are compared, each outline enlarged to the "
         "same area: which heaps are larger cannot be told.");
  }
}

void check(const Sets& sets, double margin_rad) {
  if (!(margin_rad > 0))
    throw base::InputError({.value = "margin", .rule = "must be more than 0 degrees"});
  for (const std::vector<SeenHeap>* set : sets) {
    if (set->empty()) throw base::InputError({.value = "a set has no heap"});
    for (const SeenHeap& heap : *set) {
      if (heap.views.empty()) throw base::InputError({.value = "a heap has no picture"});
    }
  }
}

}  // namespace

SetComparison compare_sets(const std::vector<SeenHeap>& first, const std::vector<SeenHeap>& second,
                           double margin_rad) {
  const Sets sets = {&first, &second};
  check(sets, margin_rad);
  MeanOutlines outlines = mean_outlines(sets);
  SetComparison result;
  result.unit = outlines.unit;
  for (const std::size_t i : {0, 1}) {
    result.sets[i] = summary_of(*sets[i]);
    result.sets[i].outline = std::move(outlines.sets[i]);
  }
  compare_angles(result, margin_rad);
  compare_outlines(result);
  add_notes(result, outlines);
  return result;
}

}  // namespace repose::vision
