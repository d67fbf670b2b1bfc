#include "vision/measure/body.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <opencv2/imgproc.hpp>

#include "vision/measure/regions.h"

namespace repose::vision {
namespace {

constexpr double kSmallestBody = 0.003;  // of the frame's area
constexpr double kLargestStray = 0.05;   // of the heap's area
constexpr int kSmallestStray = 9;        // px: smaller specks are noise

/// The part above the ground line, of a mask whose corner is at `corner` in the picture.
cv::Mat1b cut_below(const cv::Mat1b& mask, const PictureLine& ground, cv::Point corner = {}) {
  std::vector<int> first(static_cast<std::size_t>(mask.cols));
  for (int col = 0; col < mask.cols; ++col) {
    const double surface = ground.y(corner.x + col + 0.5) - corner.y;
    first[col] = std::clamp(static_cast<int>(std::lround(surface)), 0, mask.rows);
  }
  cv::Mat1b above = mask.clone();
  for (int row = *std::min_element(first.begin(), first.end()); row < mask.rows; ++row) {
    std::uint8_t* pixels = above[row];
    for (std::size_t col = 0; col < first.size(); ++col) {
      pixels[col] = row < first[col] ? pixels[col] : 0;
    }
  }
  return above;
}

cv::Mat1b solid_mask(const Segmentation& segmentation, const WorkingPicture& work) {
  cv::Mat1b mask = (segmentation.inside > 0) & work.valid_mask;
  cv::morphologyEx(mask, mask, cv::MORPH_OPEN,
                   cv::getStructuringElement(cv::MORPH_ELLIPSE, {3, 3}));
  const UserHints& told = work.told;
  if (!told.on_heap.empty()) mask |= told.on_heap;
  if (!told.beside_heap.empty()) mask &= ~told.beside_heap;
  return holes_filled(mask);
}

int smallest_body(const WorkingPicture& work) {
  return static_cast<int>(kSmallestBody * work.frame.area());
}

/// The piece with most of the places that the user marked; otherwise the largest, which is the
/// first.
int pointed_at(const Pieces& pieces, const std::vector<int>& candidates, const cv::Mat1b& on_heap) {
  int best = candidates.front();
  int most = 0;
  for (const int candidate : candidates) {
    const int here = cv::countNonZero((pieces.labels == candidate) & on_heap);
    if (here > most) {
      best = candidate;
      most = here;
    }
  }
  return best;
}

/// The heap among the pieces of `mask` above the ground, holes filled; empty if there is none.
cv::Mat1b standing_piece(const cv::Mat1b& mask, const PictureLine& ground,
                         const WorkingPicture& work) {
  const cv::Rect box = cv::boundingRect(mask);
  if (box.empty()) return {};
  const Pieces standing(holes_filled(cut_below(mask(box), ground, box.tl())));
  const std::vector<int> heaps = largest_pieces(standing, smallest_body(work));
  if (heaps.empty()) return {};
  const cv::Mat1b& on_heap = work.told.on_heap;
  const int heap = on_heap.empty() ? heaps.front() : pointed_at(standing, heaps, on_heap(box));
  cv::Mat1b piece = cv::Mat1b::zeros(mask.size());
  piece(box).setTo(255, standing.labels == heap);
  return piece;
}

/// On the ground line drawn by the user.
std::vector<Body> bodies_on_told_ground(const cv::Mat1b& mask, const WorkingPicture& work) {
  const Ground ground{*work.told.ground, work.told.ground_deviation_rad};
  Body body{standing_piece(mask, ground, work), ground};
  if (body.mask.empty()) return {};
  return {std::move(body)};
}

}  // namespace

std::vector<Body> find_bodies(const Segmentation& segmentation, const WorkingPicture& work) {
  const cv::Mat1b mask = solid_mask(segmentation, work);
  if (work.told.ground) return bodies_on_told_ground(mask, work);
  const int smallest = smallest_body(work);
  const Pieces pieces(mask);
  std::vector<Body> bodies;
  for (const int piece : largest_pieces(pieces, smallest)) {
    const cv::Mat1b alone = pieces.labels == piece;
    const std::optional<Ground> ground = find_ground(spans_of(alone), work);
    if (!ground) continue;
    Body body{standing_piece(alone, *ground, work), *ground};
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
  body.ground.y_at_0 = pieces.box(largest.front()).br().y;
  return body;
}

Body body_on(const Body& known, const Segmentation& segmentation, const WorkingPicture& work) {
  Body body = known;
  body.mask = standing_piece(solid_mask(segmentation, work), known.ground, work);
  return body;
}

int count_strays(const Body& body, const Segmentation& segmentation, const WorkingPicture& work) {
  const cv::Mat1b above = cut_below(solid_mask(segmentation, work), body.ground);
  const cv::Rect shown = cv::boundingRect(above);
  if (shown.empty()) return 0;
  const Pieces pieces(above(shown));
  const double largest = kLargestStray * cv::countNonZero(body.mask);
  int loose_particles = 0;
  for (int i = 1; i < pieces.count; ++i) {
    const cv::Rect box = pieces.box(i) + shown.tl();
    const double gap = body.ground.y(box.x + box.width / 2.0) - box.br().y;
    if (pieces.area(i) >= kSmallestStray && pieces.area(i) < largest && gap < box.height)
      ++loose_particles;
  }
  return loose_particles;
}

}  // namespace repose::vision
