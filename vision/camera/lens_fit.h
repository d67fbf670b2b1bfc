#pragma once

#include <optional>
#include <string>
#include <vector>

#include "vision/camera/board.h"
#include "vision/camera/lens.h"
#include "vision/measure/repose_angle.h"

namespace repose::vision {

/// A picture of the board, for fitting its camera's lens.
struct BoardPicture {
  std::string file;  ///< as named in messages
  int width = 0;
  int height = 0;
  std::vector<SeenCorner> corners;
};

/// The fit's result for one picture.
struct FittedPicture {
  int corners = 0;                      ///< seen in it
  bool is_used = false;                 ///< enough of the board is seen
  std::optional<double> error_px = {};  ///< root mean square distance of its corners from the fit
  std::optional<double> tilt_rad = {};  ///< of the board, from facing the camera
  std::optional<double> distance = {};  ///< of the board's middle from the lens, in squares
};

struct LensFit {
  MeasureStatus status = MeasureStatus::refused;
  std::string reason;  ///< if refused: what is wrong and how to fix it
  std::vector<Warning> warnings;
  Lens lens;                            ///< valid unless refused
  std::optional<double> error_px = {};  ///< root mean square distance of all corners from the fit
  std::optional<double> coverage =
      {};  ///< fraction of the picture's area where a board was seen, 0 to 1
  std::optional<double> turned_rad = {};  ///< largest angle between two boards
  std::vector<FittedPicture> pictures;    ///< in the given order
};

/// Minimum number of pictures of the board for a fit.
inline constexpr int kFewestPictures = 5;

/// Fits the lens to all corners of all pictures together (Zhang (2000), IEEE Trans. Pattern Anal.
/// 22, 1330-1334, as in OpenCV's calibrateCamera).
///
/// The number of distortion coefficients minimises the Bayesian information criterion (Schwarz
/// (1978), Ann. Stat. 6, 461-464): none; k1; k1, k2; k1, k2, p1, p2; all five. The others are 0.
/// Half-widths are the larger of that from the corners' scatter and that from leaving out one
/// picture at a time (jackknife, Student's t; Efron (1982), The Jackknife, 3.2).
///
/// Refused, with all reasons at once: fewer than kFewestPictures that show the board, different
/// sizes, boards that all face the same way, too little of the picture covered, corners too far
/// from the fit, a focal length that remains uncertain.
/// Proved by tests/vision/lens_fit_test.cpp on drawn boards.
LensFit fit_lens(const std::vector<BoardPicture>& pictures);

}  // namespace repose::vision
