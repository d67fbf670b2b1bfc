#include "vision/measure/traced_edge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "vision/measure/heap_template.h"
#include "vision/measure/side_contrast.h"

namespace repose::vision {
namespace {

constexpr int kTracedSide = 400;     // px; the cost grows with the square
constexpr double kUsualPart = 0.8;   // part of all places that show less contrast than an edge
                                     // would: a pixel of edge is worth what it shows beyond that
constexpr double kTurnBack = 0.3;    // what a pixel of falling before the crest costs, or of rising
                                     // behind it: grains stick out, but a heap has one crest
constexpr double kDeviation_px = 2;  // of the edge's place: half of the least reach of a contrast
constexpr double kRoughness = 2;     // weight beside lightness and colours

constexpr double kCorridor = 0.06;  // of the height, on either side of the straight flanks

constexpr int kRises = 2 * SideContrast::kSteepest + 1;
constexpr double kNever = -std::numeric_limits<double>::infinity();

enum Leg { rising, falling };
constexpr int kLegs = 2;

std::size_t index_of(int rise) {
  const int slope = rise + SideContrast::kSteepest;
  return static_cast<std::size_t>(slope);
}

/// How the best edge came to a place: from which leg, by which rise.
struct Step {
  std::uint8_t leg = rising;
  std::int8_t rise = 0;
};

/// Rows between which the edge is sought in a column.
struct Gap {
  int first = 0;
  int last = 0;
};

std::vector<Gap> corridor_along(const HeapTemplate& shape, const std::vector<int>& ground) {
  const double aside = kCorridor * shape.height;
  std::vector<Gap> gaps;
  for (std::size_t col = 0; col < ground.size(); ++col) {
    double slack = aside;
    for (const auto& flank : {shape.left, shape.right}) {
      if (flank)
        slack = std::max(slack, aside * std::hypot(1, shape.height / (flank->top - flank->foot)));
    }
    const double height = shape.flank_height(static_cast<double>(col));
    const double low = std::min(height, shape.height) - slack;
    Gap gap;
    gap.first = std::max(0, ground[col] - static_cast<int>(std::min(1e6, height + slack)));
    gap.last = std::clamp(ground[col] - static_cast<int>(low), gap.first, ground[col]);
    gaps.push_back(gap);
  }
  return gaps;
}

/// The rows of the best edge, column by column; the ground's row where there is no heap.
class EdgeSearch {
 public:
  EdgeSearch(const SideContrast& contrast, std::vector<int> ground, std::vector<Gap> corridor)
      : contrast_(contrast),
        ground_(std::move(ground)),
        corridor_(std::move(corridor)),
        chance_(usual_contrast(contrast.all(), kUsualPart)) {
    highest_ = *std::max_element(ground_.begin(), ground_.end());
    steps_.resize(ground_.size() * places());
    find();
  }
  const std::vector<int>& rows() const { return rows_; }

 private:
  const SideContrast& contrast_;
  std::vector<int> ground_;
  std::vector<Gap> corridor_;
  double chance_;
  int highest_ = 0;  // row of the ground's lowest place
  std::vector<Step> steps_;
  std::vector<int> rows_;

  std::size_t places() const { return static_cast<std::size_t>(highest_ + 1) * kLegs; }
  std::size_t place(int row, int leg) const {
    return static_cast<std::size_t>(row) * kLegs + static_cast<std::size_t>(leg);
  }

  /// Of a pixel's step along the edge, to a column and row.
  double worth(int col, int row, int rise, int leg) const {
    const double back = std::max(0, leg == rising ? -rise : rise);
    const float contrast = contrast_.at(row, col, rise);
    const double gain = contrast < 0 ? 0 : (contrast - chance_) * std::hypot(1, rise);
    return gain - kTurnBack * back;
  }

  void go_on(const std::vector<double>& before, int col, std::vector<double>& sums) {
    const auto here = static_cast<std::size_t>(col);
    for (int row = corridor_[here].first; row <= corridor_[here].last; ++row) {
      std::array<double, kRises> worths[kLegs];
      for (int i = 0; i < kRises; ++i) {
        for (const int leg : {rising, falling}) {
          worths[leg][static_cast<std::size_t>(i)] =
              worth(col, row, i - SideContrast::kSteepest, leg);
        }
      }
      for (const int leg : {rising, falling}) {
        double& best = sums[place(row, leg)];
        Step& step = steps_[here * places() + place(row, leg)];
        for (int rise = -SideContrast::kSteepest; rise <= SideContrast::kSteepest; ++rise) {
          const int from = row + rise;
          if (from < 0 || from > ground_[here - 1]) continue;
          const bool on_ground = row == ground_[here] && from == ground_[here - 1];
          for (int earlier = rising; earlier <= leg; ++earlier) {
            const double gain = on_ground ? 0 : worths[leg][index_of(rise)];
            const double sum = before[place(from, earlier)] + gain;
            if (sum <= best) continue;
            best = sum;
            step = {static_cast<std::uint8_t>(earlier), static_cast<std::int8_t>(rise)};
          }
        }
      }
    }
  }

  void find() {
    std::vector<double> before(places(), kNever);
    for (int row = corridor_.front().first; row <= corridor_.front().last; ++row) {
      before[place(row, rising)] = before[place(row, falling)] = 0;
    }
    const int last = static_cast<int>(ground_.size()) - 1;
    for (int col = 1; col <= last; ++col) {
      std::vector<double> sums(places(), kNever);
      go_on(before, col, sums);
      before = std::move(sums);
    }
    int row = ground_.back();
    int leg = falling;
    double best = kNever;
    for (int end = corridor_.back().first; end <= corridor_.back().last; ++end) {
      for (const int on : {rising, falling}) {
        const double sum = before[place(end, on)];
        if (sum <= best) continue;
        best = sum;
        row = end;
        leg = on;
      }
    }
    rows_.assign(ground_.size(), row);
    for (int col = last; col > 0; --col) {
      rows_[static_cast<std::size_t>(col)] = row;
      const Step step = steps_[static_cast<std::size_t>(col) * places() + place(row, leg)];
      row += step.rise;
      leg = step.leg;
    }
    rows_.front() = row;
  }
};

/// Lightness, colours and roughness, at the size at which edges are sought.
cv::Mat4f material_of(const WorkingPicture& work, cv::Size size) {
  std::array<cv::Mat1f, 4> channels;
  cv::split(work.lab, channels.data());
  channels[3] = kRoughness * roughness(channels[0], work.valid_mask, 1.5);
  cv::Mat4f material;
  cv::merge(channels.data(), channels.size(), material);
  cv::resize(material, material, size, 0, 0, cv::INTER_AREA);
  return material;
}

}  // namespace

Segmentation traced_segmentation(const WorkingPicture& work) {
  const cv::Size whole = work.lab.size();
  const double scale =
      std::min(1.0, static_cast<double>(kTracedSide) / std::max(whole.width, whole.height));
  const cv::Size size(std::max(1, static_cast<int>(std::lround(scale * whole.width))),
                      std::max(1, static_cast<int>(std::lround(scale * whole.height))));
  cv::Mat1b valid_mask;
  cv::resize(work.valid_mask, valid_mask, size, 0, 0, cv::INTER_NEAREST);
  const SideContrast contrast(material_of(work, size), valid_mask);
  const double down = static_cast<double>(size.height) / whole.height;
  const double across = static_cast<double>(size.width) / whole.width;
  std::vector<int> ground;
  for (int col = 0; col < size.width; ++col) {
    const double level = down * work.told.ground->y((col + 0.5) / across);
    ground.push_back(std::clamp(static_cast<int>(std::lround(level)), 0, size.height - 1));
  }
  const HeapTemplate shape = best_template(contrast, ground);
  if (!shape.left && !shape.right) return {kTraced, cv::Mat1f(whole, -1.F)};
  const std::vector<int> rows = EdgeSearch(contrast, ground, corridor_along(shape, ground)).rows();
  Segmentation traced{kTraced, cv::Mat1f(whole), kDeviation_px / down};
  for (int col = 0; col < whole.width; ++col) {
    const double place = std::clamp((col + 0.5) * across - 0.5, 0.0, size.width - 1.0);
    const auto before = static_cast<std::size_t>(place);
    const auto after = std::min(before + 1, rows.size() - 1);
    const double part = place - static_cast<double>(before);
    const double edge = ((1 - part) * rows[before] + part * rows[after]) / down;
    for (int row = 0; row < whole.height; ++row) {
      traced.inside(row, col) = static_cast<float>(row + 0.5 - edge);
    }
  }
  return traced;
}

}  // namespace repose::vision
