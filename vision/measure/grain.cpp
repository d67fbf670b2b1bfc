#include "vision/measure/grain.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

#include "vision/measure/likeness.h"

namespace repose::vision {
namespace {

constexpr int kLongestLag = 60;
constexpr double kElbow = 0.2;  // of the steepest fall, below which the pattern has ended
constexpr double kDiameterPerElbow = 1.25;
constexpr double kPackedPerElbow = 1.7;  // if it ends below zero: light grains beside dark gaps
constexpr double kPackedDip = -0.05;
constexpr double kFaintest = 1.0;   // least variance of lightness (L 0 to 100) of a pattern
constexpr int kTiles = 8;           // of the body's height: grains' pattern covers all of it
constexpr double kPatterned = 0.5;  // of the tiles; a few specks are not a pattern

/// Mean product of the pattern with itself `lag` pixels to the right and below, both inside; 0 for
/// 100 pairs or fewer.
double correlation(const cv::Mat1f& pattern, const cv::Mat1f& inside, int lag) {
  double products = 0;
  double pairs = 0;
  for (const cv::Point shift : {cv::Point(lag, 0), cv::Point(0, lag)}) {
    const cv::Rect whole({}, pattern.size());
    const cv::Rect here = whole & (whole - shift);
    const cv::Rect there = here + shift;
    if (here.empty()) continue;
    products += pattern(here).dot(pattern(there));
    pairs += inside(here).dot(inside(there));
  }
  return pairs > 100 ? products / pairs : 0;
}

/// Whether the pattern covers the whole body, not just a speck here and there.
bool is_everywhere(const cv::Mat1f& pattern, const cv::Mat1f& inside) {
  const int side = std::max(8, pattern.rows / kTiles);
  int tiles = 0;
  int patterned = 0;
  for (int row = 0; row + side <= pattern.rows; row += side) {
    for (int col = 0; col + side <= pattern.cols; col += side) {
      const cv::Rect tile(col, row, side, side);
      const double pixels = cv::sum(inside(tile))[0];
      if (pixels < tile.area() / 2.0) continue;
      ++tiles;
      patterned += pattern(tile).dot(pattern(tile)) > kFaintest * pixels ? 1 : 0;
    }
  }
  return patterned >= kPatterned * tiles;
}

}  // namespace

std::optional<double> grain_size(const WorkingPicture& work, const cv::Mat1b& body) {
  const cv::Rect box = cv::boundingRect(body);
  if (box.width < 20 || box.height < 10) return std::nullopt;
  cv::Mat1b core;
  cv::erode(body(box), core, cv::getStructuringElement(cv::MORPH_RECT, {5, 5}));
  cv::Mat1f lightness;
  cv::extractChannel(work.lab(box), lightness, 0);
  if (light_steps(lightness, core).is_silhouette()) return std::nullopt;
  cv::Mat1f inside;
  core.convertTo(inside, CV_32F, 1 / 255.0);
  // The local mean over the body alone: pixels outside must not influence it.
  const double coarse_px = std::max(2.0, box.height / 8.0);
  cv::Mat1f sum;
  cv::Mat1f weight;
  cv::GaussianBlur(lightness.mul(inside), sum, {}, coarse_px);
  cv::GaussianBlur(inside, weight, {}, coarse_px);
  const cv::Mat1f pattern = (lightness - sum / (weight + 1e-6)).mul(inside);

  const double at_1 = correlation(pattern, inside, 1);
  const double at_2 = correlation(pattern, inside, 2);
  const double at_0 =  // without the noise of single pixels
      std::min(correlation(pattern, inside, 0), 2 * at_1 - at_2);
  if (at_0 < kFaintest || !is_everywhere(pattern, inside)) return std::nullopt;
  double steepest = 0;
  double here = at_0;
  for (int lag = 0; lag < std::min(kLongestLag, box.height / 2); ++lag) {
    const double next = correlation(pattern, inside, lag + 1);
    const double fall = here - next;
    if (fall < kElbow * steepest) {
      return (here < kPackedDip * at_0 ? kPackedPerElbow : kDiameterPerElbow) * (lag + 0.5);
    }
    steepest = std::max(steepest, fall);
    here = next;
  }
  return std::nullopt;
}

}  // namespace repose::vision
