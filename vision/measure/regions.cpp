#include "vision/measure/regions.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace repose::vision {

static_assert(Pieces::kArea == cv::CC_STAT_AREA && cv::CC_STAT_LEFT == 0 && cv::CC_STAT_TOP == 1 &&
              cv::CC_STAT_WIDTH == 2 && cv::CC_STAT_HEIGHT == 3);

Spans spans_of(const cv::Mat1b& mask) {
  const auto columns = static_cast<std::size_t>(mask.cols);
  Spans spans{std::vector<int>(columns, -1), std::vector<int>(columns, -1)};
  for (int row = 0; row < mask.rows; ++row) {
    const std::uint8_t* pixels = mask[row];
    for (std::size_t col = 0; col < columns; ++col) {
      if (pixels[col] == 0) continue;
      if (spans.top[col] < 0) spans.top[col] = row;
      spans.bottom[col] = row;
    }
  }
  return spans;
}

cv::Mat1b holes_filled(const cv::Mat1b& mask) {
  cv::Mat1b padded;
  // One pixel of padding lets the flood run around a heap that touches the frame.
  cv::copyMakeBorder(mask, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::floodFill(padded, {0, 0}, 255);
  const cv::Mat1b reached = padded(cv::Rect(1, 1, mask.cols, mask.rows));
  return mask | ~reached;
}

Pieces::Pieces(const cv::Mat1b& mask) {
  cv::Mat centroids;
  cv::Mat all;
  count = cv::connectedComponentsWithStats(mask, labels, all, centroids, 4, CV_32S);
  stats = all;
}

std::vector<int> largest_pieces(const Pieces& pieces, int smallest) {
  constexpr std::size_t kMaxPieces = 3;
  std::vector<int> order;
  for (int i = 1; i < pieces.count; ++i) {
    if (pieces.area(i) >= smallest) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return pieces.area(a) > pieces.area(b); });
  if (order.size() > kMaxPieces) order.resize(kMaxPieces);
  return order;
}

}  // namespace repose::vision
