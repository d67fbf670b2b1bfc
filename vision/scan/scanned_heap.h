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
  /// What one unit of the file is; none: as the scan says, if it does.
  std::optional<double> unit_mm = {};
  /// Three points on it, in the file's unit; none: it is found.
  std::optional<std::array<base::Corner, 3>> ground = {};
  double window_from = 0.2;  ///< as of MeasureOptions
  double window_to = 0.8;
  base::FieldNames names = {};  ///< how the user gives "unit" and "ground plane"
};

/// The heap along one half-plane through its axis.
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
  int sectors = 0;           ///< of those in which the ground is seen
};

/// Heights above the ground around the heap, for drawing; lengths in the file's unit.
struct ScanMap {
  int side = 0;  ///< cells across
  double cell = 0;
  std::vector<float> height;          ///< row by row; NaN: nothing seen
  std::vector<std::uint8_t> is_heap;  ///< the heap's base, where it is clear of the roughness
  /// And as far around it as its flanks need to come down to the ground; empty: refused.
  std::vector<std::uint8_t> with_toe = {};
  std::vector<std::uint8_t> is_hole;  ///< unseen, and filled from around it
  std::array<double, 2> axis = {};    ///< from the map's corner
};

struct ScannedHeap {
  /// Status, reason, angle, interval, window, definitions and warnings. Its sides are absent: a
  /// scan has azimuths.
  ReposeAngle angle;
  std::vector<Azimuth> azimuths;
  std::optional<double> azimuth_sd_rad;  ///< standard deviation between those that have an angle
  std::size_t points = 0;
  std::size_t points_left_out = 0;
  std::optional<ScanGround> ground;
  std::optional<base::Corner> axis;  ///< where it meets the ground, in the file's coordinates
  double hole_share = 0;             ///< of the base, that was not seen
  std::optional<double> unit_mm;     ///< what one unit of the file is, as told or by its format
  std::string size_reason;           ///< why a size below is missing
  std::optional<Estimate> height_mm;
  std::optional<Estimate> base_mm;    ///< diameter of the circle as large as the base
  std::optional<Estimate> volume_ml;  ///< between the ground and the heap's surface
  ScanMap map;
  std::vector<Point> mean_profile;   ///< distance from the axis and mean height over all azimuths
  std::optional<Segment> mean_line;  ///< fitted to that over the window, from the crest outwards
};

inline constexpr int kAzimuths = 72;

/// Measures a heap of which at least half is seen from all around.
///
/// The ground is the plane with most points that has one heap on it and is seen around it; the
/// heap's side is that on which a body stands that the ground encloses. Heights above the ground
/// are the medians of the points in each cell of a plan of up to 240 cells across the heap. The
/// axis goes through the centre of volume between 20 and 80 % of the height, which neither toe nor
/// crest moves. Along 72 half-planes through it, each the mean of a sector of 30 degrees so that
/// single grains do not make its line, the flank is fitted as the side of a silhouette is
/// (fit_flank()), with the window's heights those of the heap's crest. The angle is their mean.
///
/// The interval is of this heap's angle by this definition. It covers, in quadrature, half-widths
/// of 95 %:
/// - the points' noise: the same from either half of the points, and how far these differ;
/// - the ground's level: by how much the levels of the sectors around the heap scatter, and what
///   moving all heights by that changes; the same scatter as a tilt of single flanks, since stands
///   that are registered wrongly tilt both;
/// - a ground that is bent as a whole, by a bowl fitted to what is seen of it: its slope where the
///   window ends;
/// - the surface between the grains, of which stands see more or less: a quarter of its relief,
/// over
///   the window's length;
/// - azimuths that were not seen: the scatter between octants, as a sample of a finite population
///   (Cochran, Sampling Techniques (1977), sec. 2.6);
/// - a floor of 0.06 degrees, as of pictures;
/// and, added to these, what counting aprons in full would change. It does not cover the scatter
/// between heaps, nor an error of the scanner's own scale.
///
/// Volume:
///
///     V = sum over the base of h A        h  height above the ground, A  a cell's area
///
/// from the middle of cells (midpoint rule); the base reaches as far as the flank needs to come
/// down from the threshold to the ground. Its interval covers the ground's level and bend, the
/// surface between the grains and the holes. A plate under the heap that is not much wider counts
/// as heap; a step where the heap ends short of its flanks' line is flagged.
/// Proved by ScannedHeap.* in tests/vision/scanned_heap_test.cpp: cones of known angle and volume.
/// @throws base::InputError  a window that MeasureOptions refuses, a unit that is not above 0 or
///   not the file's own, or three points on one line.
ScannedHeap measure_scan(const Scan& scan, const ScanOptions& options = {});

}  // namespace repose::vision
