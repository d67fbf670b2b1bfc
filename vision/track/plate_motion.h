#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/film/film_file.h"
#include "vision/film/film_survey.h"

namespace repose::vision {

/// A straight line in a frame, in pixels with pixel centres at integers.
struct EdgeLine {
  double roll_rad = 0;   ///< from the frame's rows; > 0: its right end is lower
  double offset_px = 0;  ///< along the normal, from the frame's first pixel

  cv::Point2d along() const;
  cv::Point2d normal() const;  ///< perpendicular to it, downwards
  double row_at(double column) const;
};

/// A long straight edge: brightness steps up or down across it.
struct PlateEdge {
  EdgeLine line;
  double step = 1;  ///< 1: brighter below it; -1: darker
  int from = 0;     ///< columns between which it is visible
  int to = 0;
};

/// An edge found again.
struct SeenEdge {
  EdgeLine line;
  double seen_part = 0;  ///< fraction of its columns in which it is visible
};

/// A frame's brightness, prepared for edge detection.
cv::Mat edge_picture(const cv::Mat& bgr);

/// Long edges of moving objects that are level or nearly so.
/// @param grey   see edge_picture()
/// @param moves  nonzero where the video's frames differ
std::vector<PlateEdge> level_edges(const cv::Mat& grey, const cv::Mat& moves);

/// The edge near its expected place; std::nullopt if too little of it is visible.
std::optional<SeenEdge> find_edge(const cv::Mat& grey, const PlateEdge& edge,
                                  const EdgeLine& expected);

/// The plate's upper edge in one frame.
struct PlateSighting {
  int frame = 0;
  double time_s = 0;
  EdgeLine line;
};

/// A plate that turns about a hinge, which may be outside the picture. In pixels of reduced frames,
/// with pixel centres at integers.
struct PlateMotion {
  int reduction = 1;
  PlateEdge edge;  ///< in the first frame
  std::vector<PlateSighting> seen;
  double seen_part = 0;        ///< fraction of the edge that is visible, on average
  double level_rad = 0;        ///< its slope before it turns
  double level_error_rad = 0;  ///< error of that, as from a table's edge behind it
  double rest_s = 0;           ///< how long it lies still at first
  double noise_rad = 0;        ///< standard deviation of its slope in a frame
  double sense = 1;            ///< 1: its right end sinks relative to the left; -1: the other way
  double turned_rad = 0;       ///< at most
  cv::Point2d hinge = {};
  double above_px = 0;   ///< of the edge's line from the hinge, positive downwards
  double wobble_px = 0;  ///< root mean square deviation from a rotation about one hinge

  double turned_at(const PlateSighting& one) const {
    return sense * (one.line.roll_rad - level_rad);
  }
  /// The point of the edge's line nearest to the hinge; positions along the plate are counted from
  /// it.
  cv::Point2d origin(const EdgeLine& line) const { return hinge + above_px * line.normal(); }
};

/// Follows all long, level, moving edges from frame to frame and takes the one that turns, the
/// uppermost of parallel ones; std::nullopt if none turns by more than a fraction of a degree.
std::optional<PlateMotion> plate_in_film(const FilmFile& file, const FilmSurvey& survey,
                                         const FilmProgress& progress);

/// The picture above the plate's edge, rotated so that the plate lies still: along the plate from
/// left to right, with its last row just above the edge.
struct PlateStrip {
  double from_px = 0;  ///< position of its first column along the plate, from the origin beside the
                       ///< hinge
  cv::Size size;
};

/// Position along the plate, from the origin, of the edge's point in a column of the first frame.
double along_plate(const PlateMotion& motion, int column);

PlateStrip strip_above(const PlateMotion& motion, const cv::Size& frame);

/// @param frame  reduced like the motion
cv::Mat strip_picture(const cv::Mat& frame, const PlateMotion& motion, const EdgeLine& line,
                      const PlateStrip& strip);

/// Converts a place in the strip to the frame.
cv::Point2d in_frame(const cv::Point2d& place, const PlateMotion& motion, const EdgeLine& line,
                     const PlateStrip& strip);

}  // namespace repose::vision
