#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "vision/film/film_file.h"
#include "vision/film/film_survey.h"
#include "vision/track/plate_edge.h"

namespace repose::vision {

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
    return sense * (one.line.lean_rad - level_rad);
  }
  /// The point of the edge's line next to the hinge, from which places along the plate count.
  cv::Point2d origin(const EdgeLine& line) const { return hinge + above_px * line.normal(); }
};

/// Follows all long level edges that move, from frame to frame, and takes the one that turns, the
/// uppermost of parallel ones; none where none turns by more than a fraction of a degree.
std::optional<PlateMotion> plate_in_film(const FilmFile& file, const FilmSurvey& survey,
                                         const FilmProgress& progress);

}  // namespace repose::vision
