#include "vision/measure/heap_template.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <opencv2/imgproc.hpp>

namespace repose::vision {
namespace {

constexpr double kUsualOfBox = 0.75;  // part of all places that show less contrast than an edge
                                      // would: a row of flank is worth what it shows beyond that
constexpr double kLevelCost = 0.06;   // what a column of level crest costs: a box may cut it off
constexpr double kAside = 0.015;      // of the height: how far bumps lie from the rough flank
constexpr std::array kBows = {-0.08, 0., 0.08};  // real flanks are hollow, or a little round
constexpr int kSearchStep = 3;                   // px between the places that are tried
constexpr double kFlattest = 0.1;                // rise a column
constexpr double kLeastHeight = 0.75;            // of the box: it is drawn close around the heap

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

/// The best flank that ends at or before each column, seen in the order of `candidates`.
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
  for (int height = deepest; height > kLeastHeight * deepest; height -= kSearchStep) {
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

}  // namespace repose::vision
