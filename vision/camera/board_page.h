#pragma once

#include <string>

#include "vision/camera/board.h"
#include "vision/picture/picture.h"

/// The board on paper.
namespace repose::vision {

enum class Paper { a4, letter };

/// A page of PDF with the board at true size, a line of 100 mm to check the print by, and what it
/// is. The same bytes whenever it is made.
std::string board_pdf(Paper paper);

/// The same page as a picture of that many pixels per inch.
Picture board_picture(Paper paper, double pixels_per_inch);

}  // namespace repose::vision
