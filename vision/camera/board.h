#pragma once

#include <array>
#include <string>
#include <vector>

#include "vision/picture/picture.h"

/// The printed board that determines scales, cameras and lenses: a chessboard with a square marker
/// in each of its white squares (ChArUco), so that any visible part of it can be identified.
///
/// On the board x points right, y down, from the outer corner of the top left square, in squares.

namespace repose::vision {

inline constexpr int kBoardColumns = 10;
/// Odd: the layout of boards with an even number of rows changed in OpenCV 4.6.
inline constexpr int kBoardRows = 7;
inline constexpr double kBoardSquare_mm = 24;  ///< when printed at true size
/// Limits for printers and posters.
inline constexpr double kSmallestSquare_mm = 1, kLargestSquare_mm = 1000;
inline constexpr double kMarkerPart = 0.75;  ///< side of a marker / side of a square
inline constexpr const char* kBoardDictionary = "DICT_4X4_50";

/// Corners at which four squares meet.
inline constexpr int kBoardCorners = (kBoardColumns - 1) * (kBoardRows - 1);

/// A corner of the board by its number, row by row from the top left.
inline Point board_corner(int number) {
  const int row = number / (kBoardColumns - 1);
  return {1.0 + number - row * (kBoardColumns - 1), 1.0 + row};
}

/// A black rectangle of the board, in squares.
struct BoardPatch {
  double x = 0;
  double y = 0;
  double width = 0;
  double height = 0;
};

/// All that is black on the board.
std::vector<BoardPatch> board_patches();

/// A corner of the board as seen in a picture.
struct SeenCorner {
  int number = 0;
  Point place;  ///< px
};

/// The visible corners of the board, by number, at subpixel precision; empty if no board is seen.
/// Deterministic.
std::vector<SeenCorner> find_board(const Picture& picture);

enum class Paper { a4, letter };

/// A PDF page with the board at true size, a line of 100 mm for checking the print, and a
/// description. The output is always the same bytes.
std::string board_pdf(Paper paper);

/// The same page as a picture with that many pixels per inch.
Picture board_picture(Paper paper, double pixels_per_inch);

}  // namespace repose::vision
