#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/film/film_file.h"
#include "vision/film/film_survey.h"

namespace repose::vision {

/// A straight line in a frame, in pixels with pixel centres at whole numbers.
struct EdgeLine {
  double roll_rad = 0;   ///< against the frame's rows; above 0: its right end is lower
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

/// The plate's upper edge in one frame.
struct PlateSighting {
  int frame = 0;
  double time_s = 0;
  EdgeLine line;
};

/// A plate that turns about a hinge, which may be out of the picture. In pixels of frames that are
/// reduced, with pixel centres at whole numbers.
struct PlateMotion {
  int reduction = 1;
  PlateEdge edge;  ///< in the first frame
  std::vector<PlateSighting> seen;
  double seen_part = 0;        ///< of the edge, on average
  double level_rad = 0;        ///< its lean before it turns
  double level_error_rad = 0;  ///< what that may be off by, as where a table's edge lies behind it
  double rest_s = 0;           ///< how long it lies still at first
  double noise_rad = 0;        ///< standard deviation of its lean in a frame
  double sense = 1;            ///< 1: its right end sinks against the left one; -1: the other way
  double turned_rad = 0;       ///< at most
  cv::Point2d hinge = {};
  double above_px = 0;   ///< of the edge's line over the hinge, downwards
  double wobble_px = 0;  ///< root mean square of what no turning about one hinge explains

  double turned_at(const PlateSighting& one) const {
    return sense * (one.line.roll_rad - level_rad);
  }
  /// The point of the edge's line next to the hinge, from which places along the plate count.
  cv::Point2d origin(const EdgeLine& line) const { return hinge + above_px * line.normal(); }
};

/// Follows all long level edges that move, from frame to frame, and takes the one that turns, the
/// uppermost of parallel ones; none where none turns by more than a fraction of a degree.
std::optional<PlateMotion> plate_in_film(const FilmFile& file, const FilmSurvey& survey,
                                         const FilmProgress& progress);

/// What stands above the plate's edge, turned so that the plate lies still: along the plate from
/// left to right, its last row just above the edge.
struct PlateStrip {
  double from_px = 0;  ///< of its first column along the plate, from the origin beside the hinge
  cv::Size size;
};

/// How far along the plate from the origin the edge is in a column of the first frame.
double along_plate(const PlateMotion& motion, int column);

PlateStrip strip_above(const PlateMotion& motion, const cv::Size& frame);

/// @param frame  reduced as the motion is
cv::Mat strip_picture(const cv::Mat& frame, const PlateMotion& motion, const EdgeLine& line,
                      const PlateStrip& strip);

/// Where a place of the strip is in the frame.
cv::Point2d in_frame(const cv::Point2d& place, const PlateMotion& motion, const EdgeLine& line,
                     const PlateStrip& strip);

}  // namespace repose::vision
