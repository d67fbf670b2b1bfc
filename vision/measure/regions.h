#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

/// Masks (255 inside, 0 outside) and the pieces they are made of.
namespace repose::vision {

/// First and last row of the mask in every column; -1 where the column is empty.
struct Spans {
  std::vector<int> top;
  std::vector<int> bottom;
};

Spans spans_of(const cv::Mat1b& mask);

/// Background that is not connected to the outside becomes foreground.
cv::Mat1b holes_filled(const cv::Mat1b& mask);

/// The connected pieces of a mask; piece 0 is the background.
struct Pieces {
  cv::Mat1i labels;  ///< number of the piece each pixel belongs to
  int count = 0;

  explicit Pieces(const cv::Mat1b& mask);
  int area(int piece) const { return areas_[static_cast<std::size_t>(piece)]; }
  cv::Rect box(int piece) const { return boxes_[static_cast<std::size_t>(piece)]; }

 private:
  void add_run(int row, int from, int to);

  std::vector<int> areas_;
  std::vector<cv::Rect> boxes_;
};

/// The three largest pieces of at least `smallest` pixels, largest first.
std::vector<int> largest_pieces(const Pieces& pieces, int smallest);

}  // namespace repose::vision
