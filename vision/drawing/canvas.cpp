#include "vision/drawing/canvas.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>

#include <opencv2/freetype.hpp>
#include <opencv2/imgproc.hpp>

#include "base/text.h"
#include "vision/drawing/comparison_style.h"
#include "vision/picture/opencv.h"

namespace repose::vision {

double drawing_scale(const Picture& picture) {
  constexpr int kSmallestSide = 800;  // px; smaller pictures are enlarged by a whole number
  constexpr int kLargestSide = 2400;  // px; more than a printed page can show
  const int longest = std::max(picture.width, picture.height);
  if (longest > kLargestSide) return static_cast<double>(kLargestSide) / longest;
  return longest < kSmallestSide ? (kSmallestSide + longest - 1) / longest : 1;
}

cv::Mat scaled(const Picture& picture, double scale) {
  const cv::Size size(std::max(1, cvRound(picture.width * scale)),
                      std::max(1, cvRound(picture.height * scale)));
  cv::Mat result;
  cv::resize(mat_of(picture), result, size, 0, 0, scale < 1 ? cv::INTER_AREA : cv::INTER_NEAREST);
  return result;
}

namespace {

constexpr int kFilled = -1;
constexpr double kLetterPart = 0.78;  // of a line's height; the rest is for descenders

int letter_height(int height) { return std::max(1, cvRound(kLetterPart * height)); }

std::string to_ascii(std::string text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 5> kSpelled{
      {{"°", " deg"}, {"±", "+/-"}, {"–", "-"}, {"…", "..."}, {"·", "|"}}};
  for (const auto& [sign, spelled] : kSpelled) {
    for (auto at = text.find(sign); at != std::string::npos; at = text.find(sign, at)) {
      text.replace(at, sign.size(), spelled);
    }
  }
  std::string ascii;
  for (const char byte : text) {
    if (static_cast<unsigned char>(byte) < 0x80) {
      ascii += byte;
    } else if (base::starts_a_letter(byte)) {
      ascii += '?';
    }
  }
  return ascii;
}

constexpr int kStrokes = cv::FONT_HERSHEY_SIMPLEX;

int stroke_thickness(int height) { return std::max(1, height / 12); }

double stroke_scale(int height) {
  constexpr double kCapitalPart = 0.75;  // of a font's size; OpenCV takes the height of capitals
  return cv::getFontScaleFromHeight(kStrokes, cvRound(kCapitalPart * letter_height(height)),
                                    stroke_thickness(height));
}

}  // namespace

std::span<const std::filesystem::path> usual_fonts() {
  static const std::array<std::filesystem::path, 4> fonts{
      "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",    // Debian, Ubuntu
      "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",  // Fedora
      "/usr/share/fonts/TTF/DejaVuSans.ttf",                // Arch
      "/usr/share/fonts/truetype/liberation/LiberationSans-Regular.ttf",
  };
  return fonts;
}

Lettering::Lettering(std::span<const std::filesystem::path> fonts) {
  std::error_code ignored;
  const auto font = std::find_if(fonts.begin(), fonts.end(), [&](const auto& file) {
    return std::filesystem::is_regular_file(file, ignored);
  });
  if (font == fonts.end()) return;
  font_ = cv::freetype::createFreeType2();
  font_->loadFontData(font->string(), 0);
}

int Lettering::width(const std::string& text, int height) const {
  if (text.empty()) return 0;
  int baseline = 0;
  if (font_) return font_->getTextSize(text, letter_height(height), kFilled, &baseline).width;
  return cv::getTextSize(to_ascii(text), kStrokes, stroke_scale(height), stroke_thickness(height),
                         &baseline)
      .width;
}

void Lettering::draw(cv::Mat& image, const std::string& text, cv::Point top_left, int height,
                     const cv::Scalar& colour) const {
  if (text.empty()) return;
  if (font_) {
    font_->putText(image, text, top_left, letter_height(height), colour, kFilled, cv::LINE_AA,
                   false);
    return;
  }
  const cv::Point baseline = top_left + cv::Point(0, letter_height(height));
  cv::putText(image, to_ascii(text), baseline, kStrokes, stroke_scale(height), colour,
              stroke_thickness(height), cv::LINE_AA);
}

std::vector<std::string> Lettering::wrap(const std::string& text, int height, int max_width) const {
  const auto fits = [&](const std::string& line) { return width(line, height) <= max_width; };
  std::vector<std::string> lines;
  for (const std::string& line : base::wrapped(text, fits)) {
    std::string part;  // of a word wider than a line
    for (const char byte : line) {
      const bool is_full = !part.empty() && base::starts_a_letter(byte) && !fits(line) &&
                           width(part + 'm', height) > max_width;
      if (is_full) lines.push_back(std::exchange(part, {}));
      part += byte;
    }
    if (!part.empty()) lines.push_back(std::move(part));
  }
  return lines;
}

namespace {

constexpr int kFractionBits = 4;  // OpenCV draws at sixteenths of a pixel

/// The dashes of a path; dashes and gaps are `dash` long.
std::vector<Path> dashes_of(const Path& path, double dash) {
  std::vector<Path> dashes;
  double left = 0;  // of the current dash or gap
  bool is_down = false;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const cv::Point2d from = path[i - 1], to = path[i];
    const double whole = cv::norm(to - from);
    double at = 0;
    while (at < whole) {
      const cv::Point2d here = from + (to - from) * (at / whole);
      if (left <= 0) {
        is_down = !is_down;
        left = dash;
        if (is_down) dashes.push_back({here});
      }
      const double step = std::min(left, whole - at);
      at += step;
      left -= step;
      if (is_down) dashes.back().push_back(from + (to - from) * (at / whole));
    }
  }
  return dashes;
}

}  // namespace

Canvas::Canvas(cv::Mat& image, double scale, const cv::Scalar& halo)
    : image_(image),
      scale_(scale),
      size_(std::sqrt(static_cast<double>(image.cols) * image.rows)),
      halo_(halo) {}

int Canvas::stroke(double weight) const { return std::max(1, cvRound(weight * size_ / 350)); }

Path Canvas::path_of(const std::vector<Point>& points) const {
  Path path;
  path.reserve(points.size());
  for (const Point& point : points) path.push_back(at(point));
  return path;
}

void Canvas::draw(const Path& path, const cv::Scalar& colour, double weight, bool closed) const {
  const int halo = stroke(weight) + 2 * std::max(1, stroke(weight) / 3);
  draw_once(path, halo_, halo, closed);
  draw_once(path, colour, stroke(weight), closed);
}

void Canvas::draw_dashed(const Path& path, const cv::Scalar& colour, double weight,
                         double dash) const {
  for (const Path& piece : dashes_of(path, length(dash))) draw(piece, colour, weight);
}

void Canvas::draw_once(const Path& path, const cv::Scalar& colour, int thickness,
                       bool closed) const {
  std::vector<cv::Point> points;
  points.reserve(path.size());
  for (const cv::Point2d& point : path) {
    // OpenCV's origin is the centre of the first pixel, ours its corner.
    points.emplace_back(cvRound((point.x - 0.5) * (1 << kFractionBits)),
                        cvRound((point.y - 0.5) * (1 << kFractionBits)));
  }
  cv::polylines(image_, points, closed, colour, thickness, cv::LINE_AA, kFractionBits);
}

namespace {

/// A line of a wrapped text.
struct PlacedLine {
  std::string text;
  cv::Scalar colour;
  int indent = 0;
  int heap = -1;
};

}  // namespace

cv::Mat draw_text_rows(int width, const std::vector<TextRow>& rows, const Lettering& lettering) {
  const int height = std::max(14, width / 52);
  const int pad = height;
  const int sample = 5 * height;
  std::vector<PlacedLine> lines;
  for (const TextRow& row : rows) {
    const int indent = row.heap >= 0 ? sample + pad : 0;
    int heap = row.heap;
    for (const std::string& text : lettering.wrap(row.text, height, width - 2 * pad - indent)) {
      lines.push_back({text, row.colour, indent, heap});
      heap = -1;
    }
  }
  const int line_height = height + height / 2;
  cv::Mat bar(static_cast<int>(lines.size()) * line_height + 2 * pad, width, CV_8UC3, kWhite);
  const Canvas canvas(bar, 1, kWhite);
  int y = pad;
  for (const PlacedLine& line : lines) {
    if (line.heap >= 0) {
      const double middle = y + height / 2.0;
      draw_heap_line(canvas, {{double(pad), middle}, {double(pad + sample), middle}},
                     static_cast<std::size_t>(line.heap));
    }
    lettering.draw(bar, line.text, {pad + line.indent, y}, height, line.colour);
    y += line_height;
  }
  return bar;
}

}  // namespace repose::vision
