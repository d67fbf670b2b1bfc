#include "vision/camera/board.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include <cairo-pdf.h>
#include <cairo.h>
#include <fmt/format.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "vision/camera/markers.h"
#include "vision/picture/opencv.h"

namespace repose::vision {

namespace {

constexpr std::size_t kFewestCorners = 6;
// A corner farther than this from where the others predict it belongs to something else.
constexpr double kAstray = 0.15;  // of a square

/// Adds a marker's black cells; neighbours in a row form one patch, so that no gap shows in print.
void add_marker(int id, double x, double y, std::vector<BoardPatch>& patches) {
  const cv::Mat1b cells = marker_cells(id);
  const double side = kMarkerPart / cells.cols;
  for (int row = 0; row < cells.rows; ++row) {
    for (int first = 0; first < cells.cols; ++first) {
      if (cells(row, first) != 0) continue;
      int end = first;
      while (end < cells.cols && cells(row, end) == 0) ++end;
      patches.push_back({x + first * side, y + row * side, (end - first) * side, side});
      first = end;
    }
  }
}

/// The corners consistent with the view of one plane.
std::vector<SeenCorner> agreeing(const std::vector<SeenCorner>& corners) {
  if (corners.size() < kFewestCorners) return {};
  std::vector<cv::Point2d> on_board;
  std::vector<cv::Point2d> in_picture;
  for (const SeenCorner& corner : corners) {
    const Point place = board_corner(corner.number);
    on_board.emplace_back(place.x, place.y);
    in_picture.emplace_back(corner.place.x, corner.place.y);
  }
  // From the picture to the board, so that distances are in squares at any size.
  const cv::Mat to_board = cv::findHomography(in_picture, on_board, cv::LMEDS);
  if (to_board.empty()) return {};
  std::vector<cv::Point2d> seen_at;
  cv::perspectiveTransform(in_picture, seen_at, to_board);
  std::vector<SeenCorner> kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (cv::norm(seen_at[i] - on_board[i]) < kAstray) kept.push_back(corners[i]);
  }
  return kept.size() < kFewestCorners ? std::vector<SeenCorner>{} : kept;
}

/// Whether the corners are collinear: if so, they determine no plane.
bool are_in_line(const std::vector<SeenCorner>& corners) {
  const auto differs = [&](auto coordinate) {
    return std::any_of(corners.begin(), corners.end(), [&](const SeenCorner& corner) {
      return coordinate(corner) != coordinate(corners.front());
    });
  };
  return !differs([](const SeenCorner& corner) { return board_corner(corner.number).x; }) ||
         !differs([](const SeenCorner& corner) { return board_corner(corner.number).y; });
}

}  // namespace

std::vector<BoardPatch> board_patches() {
  std::vector<BoardPatch> patches;
  constexpr double kMargin = (1 - kMarkerPart) / 2;
  int id = 0;
  for (int row = 0; row < kBoardRows; ++row) {
    for (int column = 0; column < kBoardColumns; ++column) {
      if ((row + column) % 2 == 0) {
        patches.push_back({static_cast<double>(column), static_cast<double>(row), 1, 1});
      } else {
        add_marker(id++, column + kMargin, row + kMargin, patches);
      }
    }
  }
  return patches;
}

std::vector<SeenCorner> find_board(const Picture& picture) {
  keep_opencv_to_one_thread();
  cv::Mat1b grey;
  cv::cvtColor(mat_of(picture), grey, cv::COLOR_BGR2GRAY);
  std::vector<SeenCorner> corners = agreeing(detected_corners(grey));
  if (corners.empty() || are_in_line(corners)) return {};
  std::sort(corners.begin(), corners.end(),
            [](const SeenCorner& a, const SeenCorner& b) { return a.number < b.number; });
  return corners;
}

namespace {

constexpr double kInch_mm = 25.4;
constexpr double kPoint_mm = kInch_mm / 72;

struct PageSize {
  double width_mm = 0;
  double height_mm = 0;
};

PageSize size_of(Paper paper) {
  return paper == Paper::a4 ? PageSize{297, 210} : PageSize{279.4, 215.9};
}

struct Destroy {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* pen) const { cairo_destroy(pen); }
};
using Surface = std::unique_ptr<cairo_surface_t, Destroy>;
using Pen = std::unique_ptr<cairo_t, Destroy>;

constexpr double kTop_mm = 10;     // above the board: printers leave some millimetres white
constexpr double kRuler_mm = 100;  // long
constexpr double kTick_mm = 10;    // apart
constexpr double kBelow_mm = 8.5;  // from the board down to the ruler
constexpr double kLetters_mm = 3.1;
constexpr double kLine_mm = 4.6;  // from one line of text to the next

void draw_board(cairo_t* pen, const PageSize& page) {
  cairo_save(pen);
  cairo_translate(pen, (page.width_mm - kBoardColumns * kBoardSquare_mm) / 2, kTop_mm);
  cairo_scale(pen, kBoardSquare_mm, kBoardSquare_mm);
  for (const BoardPatch& patch : board_patches()) {
    cairo_rectangle(pen, patch.x, patch.y, patch.width, patch.height);
  }
  cairo_fill(pen);
  cairo_restore(pen);
}

void draw_ruler(cairo_t* pen, double x, double y) {
  constexpr double kHalfTick_mm = 1.5;
  cairo_set_line_width(pen, 0.25);
  cairo_move_to(pen, x, y);
  cairo_line_to(pen, x + kRuler_mm, y);
  for (int tick = 0; tick * kTick_mm <= kRuler_mm; ++tick) {
    const double half = tick % 10 == 0 ? 2 * kHalfTick_mm : kHalfTick_mm;
    cairo_move_to(pen, x + tick * kTick_mm, y - half);
    cairo_line_to(pen, x + tick * kTick_mm, y + half);
  }
  cairo_stroke(pen);
}

void write(cairo_t* pen, double x, double y, const std::string& text) {
  cairo_move_to(pen, x, y);
  cairo_show_text(pen, text.c_str());
}

/// Draws the page, in millimetres.
void draw_page(cairo_t* pen, const PageSize& page, const std::string& how_to_print) {
  cairo_set_source_rgb(pen, 1, 1, 1);
  cairo_paint(pen);
  cairo_set_source_rgb(pen, 0, 0, 0);
  draw_board(pen, page);
  const double left = (page.width_mm - kBoardColumns * kBoardSquare_mm) / 2;
  const double ruler = kTop_mm + kBoardRows * kBoardSquare_mm + kBelow_mm;
  draw_ruler(pen, left, ruler);
  cairo_select_font_face(pen, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(pen, kLetters_mm);
  write(pen, left + kRuler_mm + 5, ruler + kLetters_mm / 3,
        "This line is 100 mm long. If it is not: print again, or measure a square.");
  const std::array<std::string, 3> lines = {
      fmt::format("repose board: ChArUco, {} x {} squares of {:g} mm, markers of {:g} mm, {}. {}",
                  kBoardColumns, kBoardRows, kBoardSquare_mm, kMarkerPart * kBoardSquare_mm,
                  kBoardDictionary, how_to_print),
      "Glue it to a flat plate. Stand it upright beside the heap, in the plane of the heap's "
      "middle, "
      "facing the camera:",
      "repose measure PICTURE --board.  For the camera's lens: repose camera, with ten pictures of "
      "it from all sides.",
  };
  for (std::size_t i = 0; i < lines.size(); ++i) {
    write(pen, left, ruler + 8 + static_cast<double>(i) * kLine_mm, lines[i]);
  }
}

cairo_status_t append(void* text, const unsigned char* bytes, unsigned int count) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
  return CAIRO_STATUS_SUCCESS;
}

/// Only a lack of memory could make this fail.
void require(cairo_status_t status) {
  if (status == CAIRO_STATUS_SUCCESS) return;
  throw std::runtime_error(
      fmt::format("the board cannot be drawn: {}", cairo_status_to_string(status)));
}

}  // namespace

std::string board_pdf(Paper paper) {
  const PageSize page = size_of(paper);
  std::string pdf;
  const Surface surface(cairo_pdf_surface_create_for_stream(append, &pdf, page.width_mm / kPoint_mm,
                                                            page.height_mm / kPoint_mm));
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, "repose board");
  // Otherwise the time of writing.
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                 "2000-01-01T00:00:00Z");
  const Pen pen(cairo_create(surface.get()));
  cairo_scale(pen.get(), 1 / kPoint_mm, 1 / kPoint_mm);
  draw_page(pen.get(), page, "Print at 100 % (actual size).");
  cairo_show_page(pen.get());
  require(cairo_status(pen.get()));
  cairo_surface_finish(surface.get());
  require(cairo_surface_status(surface.get()));
  return pdf;
}

Picture board_picture(Paper paper, double pixels_per_inch) {
  const PageSize page = size_of(paper);
  const double px_per_mm = pixels_per_inch / kInch_mm;
  const auto pixels = [&](double length_mm) {
    return static_cast<int>(std::lround(length_mm * px_per_mm));
  };
  Picture picture = blank_picture(pixels(page.width_mm), pixels(page.height_mm));
  const Surface surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, picture.width, picture.height));
  const Pen pen(cairo_create(surface.get()));
  cairo_scale(pen.get(), px_per_mm, px_per_mm);
  draw_page(pen.get(), page, fmt::format("Print at {:g} pixels per inch.", pixels_per_inch));
  require(cairo_status(pen.get()));
  cairo_surface_flush(surface.get());
  const unsigned char* pixels_of_page = cairo_image_surface_get_data(surface.get());
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface.get()));
  // A pixel is 32 bits in native byte order, blue in the lowest 8: grey, so any byte but the
  // highest will do.
  cv::Mat target = mat_of(picture);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const unsigned char* pixel =
          pixels_of_page + static_cast<std::size_t>(y) * stride + 4 * static_cast<std::size_t>(x);
      target.at<cv::Vec3b>(y, x) = {pixel[1], pixel[1], pixel[1]};
    }
  }
  return picture;
}

}  // namespace repose::vision
