#include "vision/measure/body.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <opencv2/imgproc.hpp>

#include "vision/measure/ground.h"
#include "vision/measure/regions.h"

namespace repose::vision {
namespace {

constexpr double kSmallestBody = 0.003;  // of the frame's area
constexpr double kLargestStray = 0.05;   // of the heap's area
constexpr int kSmallestStray = 9;        // px: smaller specks are noise

/// What lies above the ground line.
cv::Mat1b cut_below(const cv::Mat1b& mask, const PictureLine& ground) {
  cv::Mat1b above = mask.clone();
  for (int row = 0; row < mask.rows; ++row) {
    if (row < std::min(ground.y(0), ground.y(mask.cols)) - 1) continue;
    for (int col = 0; col < mask.cols; ++col) {
      if (row >= std::lround(ground.y(col + 0.5))) above(row, col) = 0;
    }
  }
  return above;
}

cv::Mat1b solid_mask(const Segmentation& segmentation, const WorkingPicture& work) {
  cv::Mat1b mask = (segmentation.inside > 0) & work.evidence;
  cv::morphologyEx(mask, mask, cv::MORPH_OPEN,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {3, 3}));
  return holes_filled(mask);
}

int smallest_body(const WorkingPicture& work) {
  return static_cast<int>(kSmallestBody * work.frame.area());
}

/// The largest piece of `mask` above the ground, solid; empty when there is none.
cv::Mat1b standing_piece(const cv::Mat1b& mask, const PictureLine& ground, int smallest) {
  const Pieces standing(holes_filled(cut_below(mask, ground)));
  const std::vector<int> heaps = largest_pieces(standing, smallest);
  return heaps.empty() ? cv::Mat1b() : cv::Mat1b(standing.labels == heaps.front());
}

}  // namespace

std::vector<Body> find_bodies(const Segmentation& segmentation, const WorkingPicture& work) {
  const cv::Mat1b mask = solid_mask(segmentation, work);
  const int smallest = smallest_body(work);
  const Pieces pieces(mask);
  std::vector<Body> bodies;
  for (const int piece : largest_pieces(pieces, smallest)) {
    const cv::Mat1b alone = pieces.labels == piece;
    const std::optional<Ground> ground = find_ground(spans_of(alone), work);
    if (!ground) continue;
    Body body{standing_piece(alone, ground->line, smallest), ground->line, ground->deviation_rad,
              ground->bow, ground->mirrored};
    if (body.mask.empty()) continue;
    bodies.push_back(std::move(body));
  }
  return bodies;
}

Body largest_region(const Segmentation& segmentation, const WorkingPicture& work) {
  const cv::Mat1b mask = solid_mask(segmentation, work);
  const Pieces pieces(mask);
  const std::vector<int> largest = largest_pieces(pieces, smallest_body(work));
  if (largest.empty()) return {};
  Body body;
  body.mask = pieces.labels == largest.front();
  body.ground = {static_cast<double>(pieces.box(largest.front()).br().y), 0};
  return body;
}

Body body_on(const Body& known, const Segmentation& segmentation, const WorkingPicture& work) {
  Body body = known;
  body.mask = standing_piece(solid_mask(segmentation, work), known.ground, smallest_body(work));
  return body;
}

int count_strays(const Body& body, const Segmentation& segmentation, const WorkingPicture& work) {
  const Pieces pieces(cut_below(solid_mask(segmentation, work), body.ground));
  const double largest = kLargestStray * cv::countNonZero(body.mask);
  int strays = 0;
  for (int i = 1; i < pieces.count; ++i) {
    const cv::Rect box = pieces.box(i);
    const double gap = body.ground.y(box.x + box.width / 2.0) - box.br().y;
    if (pieces.area(i) >= kSmallestStray && pieces.area(i) < largest && gap < box.height) ++strays;
  }
  return strays;
}

}  // namespace repose::vision
