#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

namespace cv::freetype {
class FreeType2;
}

namespace repose::vision {

/// Where systems keep a font that has degree and plus-minus signs.
std::span<const std::filesystem::path> usual_fonts();

/// Draws text. With the first font of a list that is there; with OpenCV's own strokes, which are
/// plain ASCII, when none is.
class Lettering {
 public:
  explicit Lettering(std::span<const std::filesystem::path> fonts = usual_fonts());

  /// Width of a line of text, of letters `height` pixels high with all that sticks out.
  int width(const std::string& text, int height) const;

  /// Draws a line of text; `top_left` is the corner of its box of width() x `height`.
  void draw(cv::Mat& image, const std::string& text, cv::Point top_left, int height,
            const cv::Scalar& colour) const;

  /// The text in lines that are not wider than `max_width`, broken at spaces; a word that is
  /// wider alone is broken anywhere.
  std::vector<std::string> wrap(const std::string& text, int height, int max_width) const;

 private:
  cv::Ptr<cv::freetype::FreeType2> font_;
};

}  // namespace repose::vision
