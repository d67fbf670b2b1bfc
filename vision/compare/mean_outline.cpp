#include "vision/compare/mean_outline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vision/compare/placed_heap.h"

namespace repose::vision {
namespace {

constexpr int kPlaces = 401;       // along the ground: closer than the pixels of a chart
constexpr double kBandFrom = 0.1;  // of the pictures
constexpr double kBandTo = 0.9;

/// The outlines of a heap's views, in the unit of the comparison, axes at 0.
using Outlines = std::vector<Skyline>;

bool is_whole(const ReposeAngle& view) {
  const bool has_outline = view.status != MeasureStatus::refused || view.outline_holds;
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

/// Heights of an outline at places that ascend.
std::vector<double> heights_at(const Skyline& skyline, const std::vector<double>& places) {
  std::vector<double> heights;
  heights.reserve(places.size());
  for (const double place : places) heights.push_back(height_at(skyline, place));
  return heights;
}

/// Of values that are sorted, between neighbours by a straight line.
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

}  // namespace

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

}  // namespace repose::vision
