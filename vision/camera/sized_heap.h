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

/// A heap measured in millimetres: with a known lens, and a scale or a board in the picture.
namespace repose::vision {

/// What gives the millimetres.
struct ScaleOptions {
  std::optional<Lens> lens = {};
  std::filesystem::path lens_file = {};  ///< that it was read from
  bool finds_board = false;
  double square_mm = kBoardSquare_mm;  ///< as printed
  double board_offset_mm =
      0;  ///< how far behind the heap's middle plane the board stands; needs a lens
  std::optional<ScaleBar> scale = {};  ///< in the picture as it is; in place of a board
};

/// A board beside or behind the heap.
struct SeenBoard {
  std::vector<Point> outline;  ///< its sheet's four corners, in the corrected picture [px]
  int corners = 0;
  double error_px = 0;
  Estimate roll_rad;                  ///< of the camera; above 0: the ground's right end lies lower
  std::optional<Estimate> pitch_rad;  ///< how far the camera looks down; above 0: down
  std::string missing;                ///< why there is no pitch
  std::optional<Estimate> distance_mm;  ///< of the heap's plane from the lens; with the pitch
};

struct SizedHeap {
  Picture corrected;       ///< the picture that was measured, where a lens has changed it
  MeasureOptions options;  ///< that it was measured with: in its pixels, without the board
  ReposeAngle angle;
  std::optional<Lens> lens;
  std::optional<SeenBoard> board;
  bool has_scale = false;  ///< a scale, or a board that was seen
  HeapSizes sizes;
};

/// Corrects the picture, looks for the board, measures the heap without it, and takes its size.
///
/// A board stands upright within 1 degree, parallel to the heap's middle plane and within 10 mm of
/// where it is said to stand, and is printed true within 0.5 %: half-widths that the sizes and the
/// pitch allow for. Where the pitch was not told, the board's is used, if it is known within 3
/// degrees; where both are and differ, the told one is used and a warning says so. Without a lens a
/// scale holds within 2 %, for what distortion may do, and a board tells no pitch.
/// @throws base::InputError  as measure_repose_angle and lens_for; a distance behind the heap
///   without a lens.
SizedHeap measure_sized_heap(const Picture& picture, const MeasureOptions& options,
                             const ScaleOptions& scale);

}  // namespace repose::vision
