#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "vision/camera/board.h"
#include "vision/camera/heap_sizes.h"
#include "vision/camera/lens.h"
#include "vision/measure/repose_angle.h"
#include "vision/measure/scale_bar.h"

/// A heap measured in millimetres: with a scale or a board in the picture, and a lens if known.
namespace repose::vision {

/// Where the millimetres come from.
struct ScaleOptions {
  std::optional<Lens> lens = {};
  std::filesystem::path lens_file = {};  ///< file it was read from
  bool finds_board = false;
  double square_mm = kBoardSquare_mm;  ///< as printed
  double board_offset_mm =
      0;  ///< how far behind the heap's middle plane the board stands; needs a lens
  std::optional<ScaleBar> scale = {};  ///< in the uncorrected picture; instead of a board
};

/// A board beside or behind the heap.
struct SeenBoard {
  std::vector<Point> outline;  ///< its sheet's four corners, in the corrected picture [px]
  int corners = 0;
  double error_px = 0;
  Estimate roll_rad;                    ///< of the camera; > 0: the ground's right end is lower
  std::optional<Estimate> pitch_rad;    ///< downward pitch of the camera
  std::string missing;                  ///< why there is no pitch
  std::optional<Estimate> distance_mm;  ///< of the heap's plane from the lens; only with a pitch
};

struct SizedHeap {
  Picture corrected;       ///< the measured picture, if a lens correction changed it
  MeasureOptions options;  ///< used for the measurement: in its pixels, without the board
  ReposeAngle angle;
  std::optional<Lens> lens;
  std::optional<SeenBoard> board;
  bool has_scale = false;  ///< a scale, or a visible board
  HeapSizes sizes;
};

/// Corrects the picture, finds the board, measures the heap without it, and determines its size.
///
/// A board stands upright within 1 degree, parallel to the heap's middle plane within 3 degrees,
/// within 10 mm of its stated distance, and is printed to scale within 0.5 %: half-widths included
/// in the sizes and the pitch. If no pitch was given, the board's is used, provided it is known
/// within 3 degrees; if both exist and differ, the given one is used with a warning. Without a lens
/// a scale is accurate to 2 %, for possible distortion, and a board gives no pitch.
/// @throws base::InputError  as measure_repose_angle and lens_for; a distance behind the heap
///   without a lens.
SizedHeap measure_sized_heap(const Picture& picture, const MeasureOptions& options,
                             const ScaleOptions& scale);

}  // namespace repose::vision
