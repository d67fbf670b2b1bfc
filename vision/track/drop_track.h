#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vision/film/film_file.h"
#include "vision/track/track.h"

namespace repose::vision {

/// One impact with the free flights before and after it.
struct Bounce {
  int number = 1;  ///< from the first on, also of those that were not read
  double time_s = 0;
  Point place = {};           ///< of the grain's centre
  Estimate restitution = {};  ///< speed after over speed before, along gravity
  Estimate drop_mm = {};      ///< height of a fall from rest to the speed before
  Estimate rebound_mm = {};   ///< height of rise with the speed after
  int sightings_before = 0;
  int sightings_after = 0;
};

/// An impact between flights, one of which was not seen well enough.
struct UnreadBounce {
  int number = 1;
  std::optional<double> time_s = {};  ///< about; none before the first flight that was
};

/// A fitted flight, to be drawn.
struct FlightPath {
  std::vector<Point> curve;
  Point top;
  bool has_top = false;  ///< it was in flight at its highest point
};

/// What a film of a dropped grain tells.
struct DropTrack {
  MeasureStatus status = MeasureStatus::refused;
  std::string reason = {};  ///< why there is no number
  std::vector<Warning> warnings = {};
  FilmFacts film = {};

  std::vector<Bounce> bounces = {};               ///< in their order
  std::vector<UnreadBounce> unread_bounces = {};  ///< before the last that was read
  double gravity_px_s2 = 0;                       ///< by the film's own time stamps
  /// Of the scale; without one, what gravity and the time stamps make it.
  std::optional<double> mm_per_px = {};
  bool has_scale = false;
  std::vector<Point> board = {};  ///< corners of the board's sheet, where that is the scale
  /// Gravity as scale and time stamps have it; none without a scale.
  std::optional<Estimate> gravity_m_s2 = {};
  double roll_rad = 0;    ///< of gravity against the picture's upright, clockwise
  double readout_ms = 0;  ///< from the first row of a frame to the last
  double noise_px = 0;    ///< standard deviation of a centre
  double grain_px = 0;    ///< diameter of a disc of the grain's area

  std::vector<GrainPlace> places = {};  ///< all of the grain's path
  std::vector<FlightPath> flights = {};
  Picture strobe = {};  ///< the grain at successive times in one picture, when it was asked for

  /// Whether the first bounce listed is the first that the grain made.
  bool has_first_bounce() const { return !bounces.empty() && bounces.front().number == 1; }
};

/// Follows the grain that is dropped in a film and fits a parabola to each flight between impacts.
///
/// Gravity is the ruler: the ratio of speeds at an impact needs no scale. Heights do: they are in
/// mm of the scale where one is given, else in those that 9.80665 m/s2 makes of the time stamps.
/// Frames are not kept: memory does not grow with the film's length.
/// @throws base::InputError  "FILE: what. Fix: ...": it is no film that can be read.
DropTrack track_drop(const FilmFile& file, const TrackOptions& options = {});

}  // namespace repose::vision
