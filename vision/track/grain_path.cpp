#include "vision/track/grain_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace repose::vision {
namespace {

constexpr double kNotYet = std::numeric_limits<double>::infinity();

double length(const cv::Point2d& v) { return std::hypot(v.x, v.y); }

/// As wide as a disc of its area.
double width_px(const Blob& blob) { return 2 * std::sqrt(blob.area_px / CV_PI); }

}  // namespace

double PathFinder::cost(const GrainPath& path, double time_s, const Blob& blob) const {
  const Sighting& last = path.back();
  const double ratio = std::abs(std::log(blob.area_px / last.blob.area_px));
  const double colours = cv::norm(blob.colour - last.blob.colour);
  constexpr double kMostRatio = 1.0, kMostColours = 90;
  if (ratio > kMostRatio || colours > kMostColours) return kNotYet;
  const double waited_s = time_s - last.time_s;
  cv::Point2d moved(0, 0);
  if (path.size() > 1) {
    const Sighting& before = path[path.size() - 2];
    moved = (last.blob.centre - before.blob.centre) * (waited_s / (last.time_s - before.time_s));
  }
  const cv::Point2d gone = blob.centre - last.blob.centre;
  // Flown on, lying still, or thrown back.
  const double off = std::min({length(gone - moved), .5 * length(gone) + .25 * length(moved),
                               length(gone - cv::Point2d(moved.x, -.6 * moved.y))});
  const double reach = 2 * width_px(last.blob) + .5 * length(moved) + 8;
  if (off > reach) return kNotYet;
  return off / reach + ratio / kMostRatio + colours / kMostColours;
}

void PathFinder::note_gap(double time_s) {
  constexpr double kGap = 1.6;
  if (last_s_ && time_s - *last_s_ > kGap * interval_s_) {
    gaps_.push_back({*last_s_, time_s - *last_s_ - interval_s_});
  }
  last_s_ = time_s;
}

double PathFinder::unseen_s(double since_s) const {
  double unseen_s = 0;
  for (const Gap& gap : gaps_) unseen_s += gap.begins_s >= since_s ? gap.lasts_s : 0;
  return unseen_s;
}

void PathFinder::forget_lost(double time_s) {
  constexpr double kLongest_s = .07;
  constexpr double kFrames = 3.5;
  const double patience_s = std::max(kLongest_s, kFrames * interval_s_);
  const auto lost = std::stable_partition(open_.begin(), open_.end(), [&](const GrainPath& path) {
    return time_s - path.back().time_s - unseen_s(path.back().time_s) <= patience_s;
  });
  std::move(lost, open_.end(), std::back_inserter(closed_));
  open_.erase(lost, open_.end());
  // Flicker leaves many paths of a frame or two.
  std::erase_if(closed_, [](const GrainPath& path) { return path.size() < 4; });
}

void PathFinder::add(int frame, double time_s, const std::vector<Blob>& blobs) {
  note_gap(time_s);
  forget_lost(time_s);
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t path = 0; path < open_.size(); ++path) {
    for (std::size_t blob = 0; blob < blobs.size(); ++blob) {
      const double off = cost(open_[path], time_s, blobs[blob]);
      if (off < kNotYet) pairs.emplace_back(off, path, blob);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> has_path(open_.size()), is_taken(blobs.size());
  for (const auto& [off, path, blob] : pairs) {
    if (has_path[path] || is_taken[blob]) continue;
    has_path[path] = is_taken[blob] = true;
    open_[path].push_back({frame, time_s, blobs[blob]});
  }
  for (std::size_t blob = 0; blob < blobs.size(); ++blob) {
    if (!is_taken[blob]) open_.push_back({{frame, time_s, blobs[blob]}});
  }
}

std::vector<GrainPath> PathFinder::paths() && {
  forget_lost(kNotYet);
  std::vector<GrainPath> moved;
  for (GrainPath& path : closed_) {
    if (way_px(path) > std::max(4.0, .2 * width_px(path.front().blob)))
      moved.push_back(std::move(path));
  }
  std::stable_sort(moved.begin(), moved.end(),
                   [](const auto& a, const auto& b) { return way_px(a) > way_px(b); });
  return moved;
}

double way_px(const GrainPath& path) {
  constexpr double kStep_px = 2;
  double way = 0;
  cv::Point2d at = path.front().blob.centre;
  for (const Sighting& sighting : path) {
    const double step = length(sighting.blob.centre - at);
    if (step < kStep_px) continue;
    way += step;
    at = sighting.blob.centre;
  }
  return way;
}

}  // namespace repose::vision
