#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "base/units.h"
#include "vision/picture/picture.h"

/// Colours and text shared by marks and captions.

namespace cv::freetype {
class FreeType2;
}

namespace repose::vision {

/// Blue, green, red. Okabe and Ito's colour-blind safe set.
inline const cv::Scalar kOrange{0, 159, 230};
inline const cv::Scalar kSkyBlue{233, 180, 86};
inline const cv::Scalar kYellow{66, 228, 240};
inline const cv::Scalar kGreen{115, 158, 0};
inline const cv::Scalar kVermilion{0, 94, 213};
inline const cv::Scalar kWhite{255, 255, 255};
inline const cv::Scalar kGrey{190, 190, 190};
inline const cv::Scalar kDark{28, 24, 22};

/// "23.4° ± 0.5°"; two decimals if the interval is below 0.1°.
inline std::string angle_text(double angle_rad, std::optional<double> uncertainty_rad) {
  if (!uncertainty_rad) return fmt::format("{:.1f}°", to_degrees(angle_rad));
  const double uncertainty_deg = to_degrees(*uncertainty_rad);
  const int decimals = uncertainty_deg < 0.1 ? 2 : 1;
  return fmt::format("{:.{}f}° ± {:.{}f}°", to_degrees(angle_rad), decimals, uncertainty_deg,
                     decimals);
}

inline constexpr int kSmallestCaption = 640;  ///< px wide, beneath narrow pictures

/// Scale at which to draw a picture so that lines and letters suit it: whole numbers keep the
/// pixels of small pictures square.
double drawing_scale(const Picture& picture);

cv::Mat scaled(const Picture& picture, double scale);

/// Common paths of fonts that have degree and plus-minus signs.
std::span<const std::filesystem::path> usual_fonts();

/// Draws text with the first font of a list that exists, or else with OpenCV's own strokes, which
/// are plain ASCII.
class Lettering {
 public:
  explicit Lettering(std::span<const std::filesystem::path> fonts = usual_fonts());

  /// Width of a line of text whose letters are `height` pixels high, including ascenders and
  /// descenders.
  int width(const std::string& text, int height) const;

  /// Draws a line of text; `top_left` is the corner of its box of width() x `height`.
  void draw(cv::Mat& image, const std::string& text, cv::Point top_left, int height,
            const cv::Scalar& colour) const;

  /// The text in lines at most `max_width` wide, broken at spaces; a wider word is broken anywhere.
  std::vector<std::string> wrap(const std::string& text, int height, int max_width) const;

 private:
  cv::Ptr<cv::freetype::FreeType2> font_;
};

using Path = std::vector<cv::Point2d>;

/// An image that shows a picture enlarged `scale` times, with stroke and letter sizes to match.
/// Lines have a halo, so that they are visible on any background.
class Canvas {
 public:
  Canvas(cv::Mat& image, double scale, const cv::Scalar& halo = kDark);

  /// Point of the picture at the image's top left corner; initially (0, 0).
  void set_corner(const Point& corner) { corner_ = corner; }

  cv::Mat& image() const { return image_; }
  cv::Point2d at(const Point& point) const {
    return {(point.x - corner_.x) * scale_, (point.y - corner_.y) * scale_};
  }
  int stroke(double weight) const;
  double length(double part) const { return part * size_; }
  Path path_of(const std::vector<Point>& points) const;

  void draw(const Path& path, const cv::Scalar& colour, double weight, bool closed = false) const;
  /// Dashes and gaps are `dash` long, as a fraction of the image's size.
  void draw_dashed(const Path& path, const cv::Scalar& colour, double weight,
                   double dash = 0.012) const;

 private:
  void draw_once(const Path& path, const cv::Scalar& colour, int thickness, bool closed) const;

  cv::Mat& image_;
  double scale_;
  double size_;
  cv::Scalar halo_;
  Point corner_;
};

/// A text of a legend, with a heap's line before it if `heap` is 0 or 1.
struct TextRow {
  std::string text;
  cv::Scalar colour;
  int heap = -1;
};

/// A white bar of `width` pixels with the texts below each other, wrapped to it.
cv::Mat draw_text_rows(int width, const std::vector<TextRow>& rows, const Lettering& lettering);

}  // namespace repose::vision
