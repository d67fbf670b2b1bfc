#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "vision/measure/repose_angle.h"
#include "vision/measure/scale_bar.h"
#include "vision/scan/scan_file.h"

/// The angle of repose and the volume of a heap in a three-dimensional scan.

namespace repose::vision {

struct ScanOptions {
  /// Length of one unit of the file; std::nullopt: taken from the scan, if it has one.
  std::optional<double> unit_mm = {};
  /// Three points on it, in the file's unit; std::nullopt: found automatically.
  std::optional<std::array<base::Corner, 3>> ground = {};
  double window_from = 0.2;  ///< as in MeasureOptions
  double window_to = 0.8;
  base::FieldNames names = {};  ///< the user's names for "unit" and "ground plane"
};

/// The heap along a half-plane through its axis.
struct Azimuth {
  double azimuth_rad = 0;  ///< about the axis, counter-clockwise seen from above
  FlankStatus status = FlankStatus::absent;
  std::string reason;  ///< why it has no angle
  std::optional<double> angle_rad;
};

struct ScanGround {
  base::Corner normal = {};  ///< length 1, towards the heap, in the file's axes
  double offset = 0;         ///< normal . place on the ground, in the file's unit
  double noise = 0;          ///< robust standard deviation of the map's cells around it
  double level_sd = 0;       ///< of the levels of the eight sectors around the heap
  int sectors = 0;           ///< number of sectors in which the ground is seen
};

/// Heights above the ground around the heap, for plots; lengths in the file's unit.
struct ScanMap {
  int side = 0;  ///< cells across
  double cell = 0;
  std::vector<float> height;          ///< row by row; NaN: not seen
  std::vector<std::uint8_t> is_heap;  ///< the heap's base, where it clears the ground's roughness
  /// The base, extended to where its flanks meet the ground; empty: refused.
  std::vector<std::uint8_t> with_toe = {};
  std::vector<std::uint8_t> is_hole;  ///< unseen, and filled from its surroundings
  std::array<double, 2> axis = {};    ///< from the map's corner
};

struct ScannedHeap {
  /// Status, reason, angle, interval, window, definitions and warnings. Its sides are absent: a
  /// scan has azimuths instead.
  ReposeAngle angle;
  std::vector<Azimuth> azimuths;
  std::optional<double> azimuth_sd_rad;  ///< standard deviation between azimuths with an angle
  std::size_t points = 0;
  std::size_t points_left_out = 0;
  std::optional<ScanGround> ground;
  std::optional<base::Corner> axis;  ///< where it meets the ground, in the file's coordinates
  double hole_share = 0;             ///< fraction of the base that was not seen
  std::optional<double> unit_mm;     ///< length of one unit of the file, as given or by its format
  std::string size_reason;           ///< why a size below is missing
  std::optional<Estimate> height_mm;
  std::optional<Estimate> base_mm;    ///< diameter of the circle with the base's area
  std::optional<Estimate> volume_ml;  ///< between the ground and the heap's surface
  ScanMap map;
  std::vector<Point> mean_profile;   ///< distance from the axis and mean height over all azimuths
  std::optional<Segment> mean_line;  ///< fitted to the profile over the window, from the crest
                                     ///< outwards
};

inline constexpr int kAzimuths = 72;

/// Measures a heap of which at least half of the azimuths are seen.
///
/// The ground is the plane with most points that has one heap on it and is seen around it; the
/// heap's side is the one with a body enclosed by the ground. Heights above the ground are means
/// over the cells of a grid of up to 240 cells across the heap. The axis goes through the centre of
/// volume between 20 and 80 % of the height, which neither toe nor crest moves. Along 72
/// half-planes through it, each the mean of a sector of 30 degrees so that single grains do not
/// dominate the line, the flank is fitted like the side of a silhouette (fit_flank()), with the
/// window relative to the height of the heap's crest. The angle is their mean.
///
/// The interval is that of this heap's angle by this definition. It covers, in quadrature,
/// half-widths of 95 %:
/// - the points' noise: from the angles of the two halves of the points, and how far these differ;
/// - the ground's level: the scatter of the levels of the sectors around the heap, and the change
///   if all heights move by that; also the same scatter as a tilt of single flanks, since stands
///   that are registered wrongly tilt both;
/// - a ground that is bent as a whole, by a bowl fitted to its visible part: its slope where the
///   window ends;
/// - the surface between the grains, of which stands see more or less: a quarter of its relief,
///   over the window's length;
/// - azimuths that were not seen: the scatter between octants, as a sample of a finite population
///   (Cochran, Sampling Techniques (1977), sec. 2.6);
/// - a floor of 0.06 degrees, as for pictures;
/// and, added linearly, the change if aprons had full weight. It covers neither the scatter between
/// heaps nor an error of the scanner's own scale.
///
/// Volume:
///
///     V = sum over the base of h A        h  height above the ground, A  a cell's area
///
/// from the middle of cells (midpoint rule); the base extends to where the flank would come down
/// from the threshold to the ground. Its interval covers the ground's level and bend, the surface
/// between the grains and the holes. A plate under the heap that is not much wider counts as heap;
/// a step where the heap ends short of its flanks' line is flagged. Proved by ScannedHeap.* in
/// tests/vision/scanned_heap_test.cpp: cones of known angle and volume.
/// @throws base::InputError  a window that MeasureOptions refuses, a unit that is not above 0 or
///   not the file's own, or three collinear points.
ScannedHeap measure_scan(const Scan& scan, const ScanOptions& options = {});

}  // namespace repose::vision
