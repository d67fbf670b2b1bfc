#include "vision/track/plate_edge.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "base/units.h"

namespace repose::vision {
namespace {

constexpr float kLeastStep = 2;  ///< grey levels a pixel, across an edge

double at(const cv::Mat& grey, const cv::Point2d& p) {
  const int x = cvFloor(p.x), y = cvFloor(p.y);
  const double fx = p.x - x, fy = p.y - y;
  const auto* above = grey.ptr<float>(y);
  const auto* below = grey.ptr<float>(y + 1);
  return (1 - fy) * ((1 - fx) * above[x] + fx * above[x + 1]) +
         fy * ((1 - fx) * below[x] + fx * below[x + 1]);
}

/// Sums of the steps along all lines of one slope, a number for each row in the middle column.
std::vector<double> sums_along(const cv::Mat& steps, double slope, double sign) {
  std::vector<double> sums(static_cast<std::size_t>(steps.rows));
  constexpr float kMostStep = 10;  // so that a long faint edge counts for more than a short one
  for (int x = 0; x < steps.cols; ++x) {
    const int shift = cvRound(slope * (x - .5 * steps.cols));
    const int first = std::max(0, -shift), last = std::min(steps.rows, steps.rows - shift);
    for (int y = first; y < last; ++y) {
      const float step = static_cast<float>(sign) * steps.at<float>(y + shift, x);
      if (step > kLeastStep) sums[static_cast<std::size_t>(y)] += std::min(step, kMostStep);
    }
  }
  return sums;
}

/// The longest stretch in which the edge is seen, but for gaps as wide as a row of grains.
void find_ends(const cv::Mat& steps, PlateEdge& edge) {
  constexpr double kGap = .3;
  const int gap = cvRound(kGap * steps.cols);
  int from = -1, last = -1;
  const auto close = [&] {
    if (from >= 0 && last - from > edge.to - edge.from) {
      edge.from = from;
      edge.to = last;
    }
  };
  for (int x = 0; x < steps.cols; ++x) {
    const int row = cvRound(edge.line.row_at(x));
    float step = 0;
    for (int y = std::max(0, row - 1); y <= std::min(steps.rows - 1, row + 1); ++y) {
      step = std::max(step, static_cast<float>(edge.step) * steps.at<float>(y, x));
    }
    if (step <= kLeastStep) continue;
    if (from < 0 || x - last > gap) {
      close();
      from = x;
    }
    last = x;
  }
  close();
}

/// How far from the expected line the edge is, a number for each column where it is seen.
struct Offsets {
  std::vector<double> along, across;
  int looked = 0;
};

Offsets offsets_from(const cv::Mat& grey, const PlateEdge& edge, const EdgeLine& line) {
  constexpr int kReach_px = 7;
  constexpr double kLikely_px = 3.5;
  Offsets offsets;
  const cv::Point2d normal = line.normal();
  for (int x = edge.from; x <= edge.to; ++x) {
    const cv::Point2d foot(x, line.row_at(x));
    const double margin = kReach_px + 2;
    if (foot.y < margin || foot.y >= grey.rows - 1 - margin || foot.x < margin ||
        foot.x >= grey.cols - 1 - margin)
      continue;
    ++offsets.looked;
    std::array<double, 2 * kReach_px + 3> values{};
    for (int k = 0; k < static_cast<int>(values.size()); ++k) {
      values[static_cast<std::size_t>(k)] = at(grey, foot + (k - kReach_px - 1) * normal);
    }
    std::array<double, 2 * kReach_px + 1> steps{};
    std::size_t best = 0;
    double most = 0;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      steps[k] = .5 * edge.step * (values[k + 2] - values[k]);
      const double off = (static_cast<double>(k) - kReach_px) / kLikely_px;
      const double weighed = steps[k] * std::exp(-.5 * off * off);
      if (weighed <= most) continue;
      most = weighed;
      best = k;
    }
    if (steps[best] < kLeastStep || best == 0 || best + 1 == steps.size()) continue;
    const double before = steps[best - 1], after = steps[best + 1];
    const double bend = before - 2 * steps[best] + after;
    const double part = bend < 0 ? std::clamp(.5 * (before - after) / bend, -.5, .5) : 0;
    offsets.along.push_back((x - .5 * (edge.from + edge.to)) / std::cos(line.lean_rad));
    offsets.across.push_back(static_cast<double>(best) - kReach_px + part);
  }
  return offsets;
}

/// A straight line through offsets, which leaves out those far from it: offset, slope, and how many
/// lie on it.
struct OffsetLine {
  double offset = 0, slope = 0;
  int on = 0;
};

OffsetLine line_through(const Offsets& offsets) {
  constexpr int kRounds = 12;
  constexpr double kFirst_px = 4, kLast_px = .5, kOn_px = 1;
  OffsetLine line;
  double scale = kFirst_px;
  for (int round = 0; round < kRounds; ++round, scale = std::max(kLast_px, .7 * scale)) {
    double w = 0, wx = 0, wxx = 0, wy = 0, wxy = 0;
    for (std::size_t k = 0; k < offsets.along.size(); ++k) {
      const double x = offsets.along[k], y = offsets.across[k];
      const double off = (y - line.offset - line.slope * x) / scale;
      const double weight = 1 / ((1 + off * off) * (1 + off * off));
      w += weight;
      wx += weight * x;
      wxx += weight * x * x;
      wy += weight * y;
      wxy += weight * x * y;
    }
    const double spread = w * wxx - wx * wx;
    if (!(spread > 0)) return {};
    line.slope = (w * wxy - wx * wy) / spread;
    line.offset = (wy - line.slope * wx) / w;
  }
  for (std::size_t k = 0; k < offsets.along.size(); ++k) {
    const double off = offsets.across[k] - line.offset - line.slope * offsets.along[k];
    line.on += std::abs(off) < kOn_px ? 1 : 0;
  }
  return line;
}

}  // namespace

cv::Point2d EdgeLine::along() const { return {std::cos(lean_rad), std::sin(lean_rad)}; }

cv::Point2d EdgeLine::normal() const { return {-std::sin(lean_rad), std::cos(lean_rad)}; }

double EdgeLine::row_at(double column) const {
  return (offset_px + column * std::sin(lean_rad)) / std::cos(lean_rad);
}

cv::Mat edge_picture(const cv::Mat& bgr) {
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  grey.convertTo(grey, CV_32F);
  cv::GaussianBlur(grey, grey, {5, 5}, 1);
  return grey;
}

std::vector<PlateEdge> level_edges(const cv::Mat& grey, const cv::Mat& moves) {
  constexpr double kMostLean_deg = 8, kStep_deg = .5;
  constexpr int kApart_px = 4;
  constexpr std::size_t kMost = 16;
  constexpr double kLeastLength = .2;
  cv::Mat steps, near;
  cv::Sobel(grey, steps, CV_32F, 0, 1, 3, 1. / 8);
  cv::dilate(moves, near, cv::Mat(), {-1, -1}, 3);
  steps.setTo(0, near == 0);
  struct Found {
    double sum = 0, lean_deg = 0, sign = 1;
    int row = 0;
  };
  std::vector<Found> found;
  for (const double sign : {1.0, -1.0}) {
    std::vector<Found> best(static_cast<std::size_t>(steps.rows));
    for (double lean = -kMostLean_deg; lean <= kMostLean_deg; lean += kStep_deg) {
      const std::vector<double> sums = sums_along(steps, std::tan(lean * kDegree), sign);
      for (std::size_t y = 0; y < sums.size(); ++y) {
        if (sums[y] > best[y].sum) best[y] = {sums[y], lean, sign, static_cast<int>(y)};
      }
    }
    found.insert(found.end(), best.begin(), best.end());
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Found& a, const Found& b) { return a.sum > b.sum; });
  std::vector<PlateEdge> edges;
  std::vector<Found> taken;
  for (const Found& one : found) {
    if (taken.size() == kMost || one.sum <= 0) break;
    const bool is_taken = std::any_of(taken.begin(), taken.end(), [&](const Found& other) {
      return other.sign == one.sign && std::abs(other.row - one.row) < kApart_px;
    });
    if (is_taken) continue;
    taken.push_back(one);
    PlateEdge edge{.line = {.lean_rad = one.lean_deg * kDegree},
                   .step = one.sign,
                   .from = 0,
                   .to = steps.cols - 1};
    edge.line.offset_px = edge.line.normal().dot(cv::Point2d(.5 * steps.cols, one.row));
    // Its ends are seen on the line itself, which may lean otherwise by half a step or more.
    const double length = edge.to - edge.from;
    if (const auto seen = find_edge(grey, edge, edge.line)) edge.line = seen->line;
    edge.to = edge.from;
    find_ends(steps, edge);
    if (edge.to - edge.from > kLeastLength * length) edges.push_back(edge);
  }
  return edges;
}

std::optional<SeenEdge> find_edge(const cv::Mat& grey, const PlateEdge& edge,
                                  const EdgeLine& expected) {
  constexpr int kFewest = 24;
  constexpr double kLeastPart = .3;
  SeenEdge seen{.line = expected};
  // Again from where it was found, where the normals are its own.
  for (int round = 0; round < 2; ++round) {
    const Offsets offsets = offsets_from(grey, edge, seen.line);
    if (offsets.looked < kFewest) return std::nullopt;
    const OffsetLine line = line_through(offsets);
    seen.seen_part = line.on / static_cast<double>(offsets.looked);
    if (seen.seen_part < kLeastPart) return std::nullopt;
    const double middle = .5 * (edge.from + edge.to);
    const cv::Point2d on =
        cv::Point2d(middle, seen.line.row_at(middle)) + line.offset * seen.line.normal();
    seen.line.lean_rad += std::atan(line.slope);
    seen.line.offset_px = seen.line.normal().dot(on);
  }
  return seen;
}

}  // namespace repose::vision
