#pragma once

#include <array>
#include <string>
#include <vector>

#include "vision/picture/picture.h"

/// The printed board that scales, cameras and lenses are told by: a chessboard with a square marker
/// in each of its white squares (ChArUco), so that a part of it is known wherever it is seen.
///
/// On the board x points right, y down, from the outer corner of the top left square, in squares.

namespace repose::vision {

inline constexpr int kBoardColumns = 10;
/// Odd: boards of an even number of rows are laid out in another way since OpenCV 4.6.
inline constexpr int kBoardRows = 7;
inline constexpr double kBoardSquare_mm = 24;  ///< as it is printed at true size
/// What a printer or a poster can hold of it.
inline constexpr double kSmallestSquare_mm = 1, kLargestSquare_mm = 1000;
inline constexpr double kMarkerPart = 0.75;  ///< a marker's side / a square's
inline constexpr const char* kBoardDictionary = "DICT_4X4_50";

/// Corners at which four squares meet.
inline constexpr int kBoardCorners = (kBoardColumns - 1) * (kBoardRows - 1);

/// A corner of the board by its number, row by row from the top left one.
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

/// A corner of the board where a picture shows it.
struct SeenCorner {
  int number = 0;
  Point place;  ///< px
};

/// The corners of the board that a picture shows, by their numbers; none where it shows no board.
/// Finer than a pixel. Deterministic.
std::vector<SeenCorner> find_board(const Picture& picture);

enum class Paper { a4, letter };

/// A page of PDF with the board at true size, a line of 100 mm to check the print by, and what it
/// is. The same bytes whenever it is made.
std::string board_pdf(Paper paper);

/// The same page as a picture of that many pixels per inch.
Picture board_picture(Paper paper, double pixels_per_inch);

}  // namespace repose::vision
