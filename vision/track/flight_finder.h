#pragma once

#include <cstddef>
#include <vector>

namespace repose::vision {

/// The centre of a grain in one frame.
struct SeenAt {
  double time_s = 0;
  double x_px = 0;
  double y_px = 0;    ///< downwards
  double row_px = 0;  ///< of the frame, from its middle: rows may be exposed one after the other
};

/// Sightings [from, to) in one free flight.
struct FlightSpan {
  std::size_t from = 0;
  std::size_t to = 0;
};

struct Flights {
  std::vector<FlightSpan> spans;
  double gravity_px_s2 = 0;
};

/// Parts of a path that are free flights under one and the same gravity, which the path itself
/// tells.
///
/// Of all ways to cut the path into parabolas of nearly one bend and loose sightings (held, at
/// rest, blurred by an impact), the one is taken that costs least. A flight whose bend does not
/// stand out from the noise is none.
Flights find_flights(const std::vector<SeenAt>& path, double noise_px);

}  // namespace repose::vision
