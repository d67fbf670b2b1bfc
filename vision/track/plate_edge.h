#pragma once

#include <optional>
#include <vector>

#include <opencv2/core.hpp>

namespace repose::vision {

/// A straight line in a frame, in pixels with pixel centres at whole numbers.
struct EdgeLine {
  double lean_rad = 0;   ///< against the frame's rows; above 0: its right end is lower
  double offset_px = 0;  ///< along the normal, from the frame's first pixel

  cv::Point2d along() const;
  cv::Point2d normal() const;  ///< at right angles to it, downwards
  double row_at(double column) const;
};

/// A long straight edge: brightness steps up or down across it.
struct PlateEdge {
  EdgeLine line;
  double step = 1;  ///< 1: brighter below it; -1: darker
  int from = 0;     ///< columns between which it is seen
  int to = 0;
};

/// An edge found anew.
struct SeenEdge {
  EdgeLine line;
  double seen_part = 0;  ///< of its columns, those where it is
};

/// A frame's brightness, as edges are looked for in it.
cv::Mat edge_picture(const cv::Mat& bgr);

/// Long edges that are level or nearly so, of what moves.
/// @param grey   see edge_picture()
/// @param moves  not 0 where frames of the film differ
std::vector<PlateEdge> level_edges(const cv::Mat& grey, const cv::Mat& moves);

/// The edge near where it is expected; none where most of it is not seen.
std::optional<SeenEdge> find_edge(const cv::Mat& grey, const PlateEdge& edge,
                                  const EdgeLine& expected);

}  // namespace repose::vision
