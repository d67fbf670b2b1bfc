#include "vision/measure/regions.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>

namespace repose::vision {

Spans spans_of(const cv::Mat1b& mask) {
  const auto columns = static_cast<std::size_t>(mask.cols);
  Spans spans{std::vector<int>(columns, mask.rows), std::vector<int>(columns, -1)};
  const cv::Rect box = cv::boundingRect(mask);
  for (int row = box.y; row < box.br().y; ++row) {
    const std::uint8_t* pixels = mask[row];
    for (auto col = static_cast<std::size_t>(box.x); col < static_cast<std::size_t>(box.br().x);
         ++col) {  // branchless, eight columns at a time
      spans.top[col] = std::min(spans.top[col], pixels[col] != 0 ? row : mask.rows);
      spans.bottom[col] = pixels[col] != 0 ? row : spans.bottom[col];
    }
  }
  for (int& top : spans.top) top = top == mask.rows ? -1 : top;
  return spans;
}

cv::Mat1b holes_filled(const cv::Mat1b& mask) {
  const cv::Rect box = cv::boundingRect(mask);
  cv::Mat1b filled = mask.clone();
  if (box.empty()) return filled;
  cv::Mat1b padded;
  // One pixel of padding lets the flood run around a heap that touches the frame.
  cv::copyMakeBorder(mask(box), padded, 1, 1, 1, 1, cv::BORDER_CONSTANT | cv::BORDER_ISOLATED, 0);
  cv::floodFill(padded, {0, 0}, 255);
  const cv::Mat1b reached = padded(cv::Rect(1, 1, box.width, box.height));
  filled(box) |= ~reached;
  return filled;
}

// Areas and boxes from runs of one piece: counted pixel by pixel, as OpenCV does together with the
// centroids, they take longer than the labels.
Pieces::Pieces(const cv::Mat1b& mask) : count(cv::connectedComponents(mask, labels, 4, CV_32S)) {
  areas_.resize(static_cast<std::size_t>(count));
  boxes_.resize(static_cast<std::size_t>(count));
  for (int row = 0; row < labels.rows; ++row) {
    const int* piece = labels[row];
    for (int from = 0; from < labels.cols;) {
      int to = from + 1;
      while (to < labels.cols && piece[to] == piece[from]) ++to;
      add_run(row, from, to);
      from = to;
    }
  }
}

void Pieces::add_run(int row, int from, int to) {
  const auto piece = static_cast<std::size_t>(labels(row, from));
  areas_[piece] += to - from;
  boxes_[piece] |= cv::Rect(from, row, to - from, 1);
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
