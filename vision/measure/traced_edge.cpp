#include "vision/measure/traced_edge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "vision/measure/ground.h"

namespace repose::vision {

namespace {

constexpr std::array kReaches = {4, 12};  // px on either side: fine grains, and lumps
constexpr int kSamples = 4;               // columns on either side of the pixel's own
constexpr double kEnough = 0.25;          // of each side that must be valid
constexpr double kUnsharp = 4;            // minimum variance, as in step_contrast

constexpr int kSums = 6;  // of four channels, of their squares, and the number of pixels
using Sums = cv::Vec<double, kSums>;

/// Sums of the columns from the top down to each row.
class ColumnSums {
 public:
  ColumnSums(const cv::Mat4f& material, const cv::Mat1b& valid_mask)
      : sums_(material.rows + 1, material.cols, Sums()) {
    for (int row = 0; row < material.rows; ++row) {
      for (int col = 0; col < material.cols; ++col) {
        Sums here = sums_(row, col);
        if (valid_mask(row, col) != 0) {
          const cv::Vec4f& value = material(row, col);
          for (int i = 0; i < 4; ++i) here[i] += value[i];
          here[4] += value.dot(value);
          here[5] += 1;
        }
        sums_(row + 1, col) = here;
      }
    }
  }
  int rows() const { return sums_.rows - 1; }
  int cols() const { return sums_.cols; }
  Sums between(int from, int to, int col) const {
    return sums_(std::clamp(to, 0, rows()), col) - sums_(std::clamp(from, 0, rows()), col);
  }

 private:
  cv::Mat_<Sums> sums_;
};

double variance(const Sums& sums) {
  double squares = 0;
  for (int i = 0; i < 4; ++i) squares += sums[i] * sums[i];
  return std::max(0.0, sums[4] / sums[5] - squares / (sums[5] * sums[5]));
}

/// A short line, and how far its two sides extend up and down from it.
struct Stroke {
  double slope;
  double step;  ///< columns from one sample to the next
  int depth;    ///< rows

  Stroke(double rise, int reach)
      : slope(rise),
        step(reach / std::hypot(1, rise) / kSamples),
        depth(static_cast<int>(std::lround(reach * std::hypot(1, rise)))) {}

  float contrast(const ColumnSums& sums, int row, int col) const {
    Sums above;
    Sums below;
    for (int k = -kSamples; k <= kSamples; ++k) {
      const int there = col + static_cast<int>(std::lround(k * step));
      if (there < 0 || there >= sums.cols()) continue;
      const int level = row - static_cast<int>(std::lround(k * step * slope));
      above += sums.between(level - depth, level, there);
      below += sums.between(level, level + depth, there);
    }
    const double enough = kEnough * (2 * kSamples + 1) * depth;
    if (above[5] < enough || below[5] < enough) return -1;
    double squares = 0;
    for (int i = 0; i < 4; ++i) {
      const double step_here = above[i] / above[5] - below[i] / below[5];
      squares += step_here * step_here;
    }
    const double scatter = kUnsharp + variance(above) + 0.5 * variance(below);
    return static_cast<float>(saturated(std::sqrt(squares / scatter), 1));
  }
};

/// The mean over the reaches of the contrast beside lines of one slope.
cv::Mat1f contrast_along(double slope, const ColumnSums& sums) {
  cv::Mat1f contrast(sums.rows(), sums.cols(), 0.F);
  for (const int reach : kReaches) {
    const Stroke stroke(slope, reach);
    for (int row = 0; row < contrast.rows; ++row) {
      for (int col = 0; col < contrast.cols; ++col) {
        const float here = stroke.contrast(sums, row, col);
        float& mean = contrast(row, col);
        mean = here < 0 || mean < 0 ? -1 : mean + here / static_cast<float>(kReaches.size());
      }
    }
  }
  return contrast;
}

}  // namespace

SideContrast::SideContrast(const cv::Mat4f& material, const cv::Mat1b& valid_mask) {
  const ColumnSums sums(material, valid_mask);
  for (int rise = -kSteepest; rise <= kSteepest; ++rise) {
    const int slope_index = rise + kSteepest;
    cv::Mat1f& best = contrast_[static_cast<std::size_t>(slope_index)];
    best = contrast_along(rise, sums);
    for (const double slope : {rise - 0.5, rise + 0.5}) {
      if (std::abs(slope) < kSteepest) best = cv::max(best, contrast_along(slope, sums));
    }
  }
}

double usual_contrast(std::span<const cv::Mat1f> contrast, double part) {
  constexpr int kStep = 4;
  std::vector<float> values;
  for (const cv::Mat1f& one : contrast) {
    for (int row = 0; row < one.rows; row += kStep) {
      for (int col = 0; col < one.cols; col += kStep) {
        if (one(row, col) >= 0) values.push_back(one(row, col));
      }
    }
  }
  if (values.empty()) return 1;
  const auto at = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

namespace {

constexpr double kUsualOfBox = 0.75;  // fraction of places that show less contrast than an edge
                                      // would: a row of flank is worth what it shows beyond that
constexpr double kLevelCost = 0.06;   // cost of a column of level crest: a box may cut it off
constexpr double kAside = 0.015;      // of the height: how far bumps lie from the rough flank
constexpr std::array kBows = {-0.08, 0., 0.08};  // real flanks are concave, or slightly convex
constexpr int kSearchStep = 3;                   // px between the positions tried
constexpr double kFlattest = 0.1;                // rise per column
constexpr double kMinHeight = 0.75;              // of the box, which is drawn close around the heap

struct Candidate {
  RoughFlank flank;
  double worth = -std::numeric_limits<double>::infinity();
};

class Search {
 public:
  Search(const SideContrast& contrast, const std::vector<int>& ground)
      : ground_(ground), cols_(static_cast<int>(ground.size())) {
    const int deepest = *std::max_element(ground.begin(), ground.end());
    const int aside = std::max(1, static_cast<int>(kAside * deepest));
    const cv::Mat near = cv::Mat1b::ones(2 * aside + 1, 1);
    for (int rise = -SideContrast::kSteepest; rise <= SideContrast::kSteepest; ++rise) {
      cv::Mat1f best;
      cv::dilate(contrast.of(rise), best, near);
      contrast_.push_back(best);
    }
    chance_ = usual_contrast(contrast_, kUsualOfBox);
  }

  /// For each column that may be its top (in steps), the best flank up to a height.
  /// @param inwards  1: a left flank, -1: a right one
  std::vector<Candidate> flanks(int height, int inwards) const {
    std::vector<Candidate> best;
    for (int top = 0; top < cols_; top += kSearchStep) {
      Candidate here;
      for (int foot = top - inwards; foot >= 0 && foot < cols_; foot -= inwards * kSearchStep) {
        const double rise = static_cast<double>(height) / std::abs(top - foot);
        if (rise > SideContrast::kSteepest) continue;
        if (rise < kFlattest) break;
        for (const double bow : kBows) {
          const RoughFlank flank{static_cast<double>(foot), static_cast<double>(top), bow};
          const double worth = worth_of(flank, rise * inwards, height);
          if (worth > here.worth) here = {flank, worth};
        }
      }
      best.push_back(here);
    }
    return best;
  }

 private:
  const std::vector<int>& ground_;
  int cols_;
  std::vector<cv::Mat1f> contrast_;
  double chance_ = 0;

  double worth_of(const RoughFlank& flank, double rise, int height) const {
    double worth = 0;
    const auto slope = static_cast<std::size_t>(std::lround(rise) + SideContrast::kSteepest);
    const int ground = ground_[static_cast<std::size_t>(flank.foot)];
    for (int up = 1; up < height; up += 2) {
      const int col = static_cast<int>(flank.column(static_cast<double>(up) / height));
      const float here =
          contrast_[slope](ground - std::min(up, ground), std::clamp(col, 0, cols_ - 1));
      if (here >= 0) worth += 2 * (here - chance_);
    }
    return worth;
  }
};

/// The best flank that ends at or before each column, in the order of `candidates`.
std::vector<Candidate> best_so_far(std::vector<Candidate> candidates) {
  for (std::size_t i = 1; i < candidates.size(); ++i) {
    const double levelled = candidates[i - 1].worth - kLevelCost * kSearchStep;
    if (levelled <= candidates[i].worth) continue;
    candidates[i] = candidates[i - 1];
    candidates[i].worth = levelled;
  }
  return candidates;
}

}  // namespace

double RoughFlank::column(double part) const {
  return foot + (top - foot) * (part + 4 * bow * part * (1 - part));
}

double RoughFlank::part(double col) const {
  const double straight = (col - foot) / (top - foot);
  if (straight <= 0 || straight >= 1) return straight;
  double part = straight;
  for (int round = 0; round < 4; ++round) part = straight - 4 * bow * part * (1 - part);
  return part;
}

double HeapTemplate::flank_height(double col) const {
  double lower = std::numeric_limits<double>::infinity();
  for (const auto& flank : {left, right}) {
    if (flank) lower = std::min(lower, flank->part(col) * height);
  }
  return std::max(0.0, lower);
}

HeapTemplate best_template(const SideContrast& contrast, const std::vector<int>& ground) {
  const Search search(contrast, ground);
  const int deepest = *std::min_element(ground.begin(), ground.end());
  HeapTemplate best;
  double most = 0;
  for (int height = deepest; height > kMinHeight * deepest; height -= kSearchStep) {
    const auto left = best_so_far(search.flanks(height, 1));
    auto right = search.flanks(height, -1);
    std::reverse(right.begin(), right.end());
    right = best_so_far(right);
    std::reverse(right.begin(), right.end());
    const auto consider = [&](const Candidate* l, const Candidate* r, double worth) {
      if (worth <= most) return;
      most = worth;
      best = {.left = l ? std::optional(l->flank) : std::nullopt,
              .right = r ? std::optional(r->flank) : std::nullopt,
              .height = static_cast<double>(height)};
    };
    for (std::size_t i = 0; i < left.size(); ++i) {
      consider(&left[i], &right[i], left[i].worth + right[i].worth);
    }
    consider(&left.back(), nullptr, left.back().worth);
    consider(nullptr, &right.front(), right.front().worth);
  }
  return best;
}

namespace {

constexpr int kTracedSide = 400;     // px; the cost grows with the square
constexpr double kUsualPart = 0.8;   // fraction of places that show less contrast than an edge
                                     // would: a pixel of edge is worth what it shows beyond that
constexpr double kTurnBack = 0.3;    // cost of a pixel of fall before the crest, or of rise after
                                     // it: grains stick out, but a heap has one crest
constexpr double kDeviation_px = 2;  // of the edge's position: half of a contrast's least reach
constexpr double kRoughness = 2;     // weight relative to lightness and colours

constexpr double kCorridor = 0.06;  // of the height, on either side of the straight flanks

constexpr int kRises = 2 * SideContrast::kSteepest + 1;
constexpr double kNever = -std::numeric_limits<double>::infinity();

enum Leg { rising, falling };
constexpr int kLegs = 2;

std::size_t index_of(int rise) {
  const int slope = rise + SideContrast::kSteepest;
  return static_cast<std::size_t>(slope);
}

/// How the best edge reached a place: from which leg, by which rise.
struct Step {
  std::uint8_t leg = rising;
  std::int8_t rise = 0;
};

/// Rows between which the edge is searched for in a column.
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

  /// Value of one step of the edge, to a column and row.
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

/// Lightness, colours and roughness, at the resolution of the edge search.
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
