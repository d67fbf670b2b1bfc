#include "vision/drawing/lettering.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <utility>

#include <opencv2/freetype.hpp>
#include <opencv2/imgproc.hpp>

#include "base/text.h"

namespace repose::vision {
namespace {

constexpr int kFilled = -1;
constexpr double kLetterPart = 0.78;  // of a line's height; below it hang the tails of g and y

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
  constexpr double kCapitalPart = 0.75;  // of a font's size; OpenCV asks for the capitals' height
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
    std::string part;  // of a word that is wider alone
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

}  // namespace repose::vision
