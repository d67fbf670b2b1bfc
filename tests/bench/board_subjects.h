#pragma once

#include <cstdint>
#include <vector>

#include "tests/support/drawn_board.h"
#include "vision/camera/lens.h"
#include "vision/camera/lens_fit.h"
#include "vision/measure/scale_bar.h"
#include "vision/picture/picture.h"

/// Synthetic pictures of boards, and of boards beside heaps, with known ground truth.
namespace repose::bench {

/// A camera with any lens that a phone or a compact camera may have.
testing::BoardCamera any_camera(std::uint64_t seed);

/// Pictures of a board held at places all over the frame, for fitting a lens.
std::vector<vision::BoardPicture> board_pictures(const testing::BoardCamera& camera, int count,
                                                 std::uint64_t seed);

/// A heap with a board as people set it up: not quite upright, not quite in its plane, not quite
/// printed to size.
struct HeapWithBoard {
  vision::Picture picture;
  testing::BoardCamera camera;
  double board_offset_mm = 0;  ///< as stated to the measurement
  double square_mm = 24;
  double pitch_rad = 0;
  double roll_rad = 0;
  vision::Box board_box;  ///< around the board's sheet [px]
  vision::ScaleBar bar;   ///< two points beside the crest
  double mm_per_px = 0;   ///< where the heap's axis meets the ground
  double angle_rad = 0;   ///< of the outline in parallel projection, height over half the base
  double height_mm = 0;
  double base_mm = 0;
};

HeapWithBoard heap_with_board(std::uint64_t seed, bool stands_behind);

}  // namespace repose::bench
