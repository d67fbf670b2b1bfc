#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vision/film/film_file.h"
#include "vision/track/track.h"

namespace repose::vision {

/// One impact, with the free flights before and after it.
struct Bounce {
  int number = 1;  ///< counted from the first, including those that were not read
  double time_s = 0;
  Point place = {};           ///< the grain's centre
  Estimate restitution = {};  ///< speed after / speed before, along gravity
  Estimate drop_mm = {};      ///< fall height from rest to the speed before
  Estimate rebound_mm = {};   ///< height reached with the speed after
  int sightings_before = 0;
  int sightings_after = 0;
};

/// An impact next to a flight that was not seen well enough.
struct UnreadBounce {
  int number = 1;
  std::optional<double> time_s = {};  ///< approximate; std::nullopt before the first flight that
                                      ///< was seen well enough
};

/// A fitted flight, for drawing.
struct FlightPath {
  std::vector<Point> curve;
  Point top;
  bool has_top = false;  ///< its highest point was in flight
};

/// Result of a video of a dropped grain.
struct DropTrack {
  MeasureStatus status = MeasureStatus::refused;
  std::string reason = {};  ///< why there is no number
  std::vector<Warning> warnings = {};
  FilmFacts film = {};

  std::vector<Bounce> bounces = {};               ///< in order of time
  std::vector<UnreadBounce> unread_bounces = {};  ///< before the last one that was read
  double gravity_px_s2 = 0;                       ///< by the video's own time stamps
  /// From the scale; without one, from gravity and the time stamps.
  std::optional<double> mm_per_px = {};
  bool has_scale = false;
  std::vector<Point> board = {};  ///< corners of the board's sheet, if it gives the scale
  /// Gravity from the scale and the time stamps; std::nullopt without a scale.
  std::optional<Estimate> gravity_m_s2 = {};
  double roll_rad = 0;    ///< of gravity, from the picture's vertical, clockwise
  double readout_ms = 0;  ///< from a frame's first row to its last
  double noise_px = 0;    ///< standard deviation of a centre
  double grain_px = 0;    ///< diameter of a disc with the grain's area

  std::vector<GrainPlace> places = {};  ///< all of the grain's path
  std::vector<FlightPath> flights = {};
  Picture strobe = {};  ///< the grain at successive times in one picture, if requested

  /// Whether the first bounce listed is the first the grain made.
  bool has_first_bounce() const { return !bounces.empty() && bounces.front().number == 1; }
};

/// Follows the dropped grain in a video and fits a parabola to each flight between impacts.
///
/// Gravity is the ruler: the ratio of speeds at an impact needs no scale. Heights do: they are in
/// mm of the scale if one is given, otherwise in those implied by 9.80665 m/s2 and the time stamps.
/// Frames are not kept: memory does not grow with the video's length.
/// @throws base::InputError  "FILE: what. Fix: ...": it is not a readable video.
DropTrack track_drop(const FilmFile& file, const TrackOptions& options = {});

}  // namespace repose::vision
