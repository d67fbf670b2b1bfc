#include "vision/drawing/overlay_caption.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "vision/drawing/overlay_style.h"

namespace repose::vision {
namespace {

struct CaptionLine {
  std::string text;
  int height = 0;
  cv::Scalar colour;
};

struct Badge {
  std::string text;
  cv::Scalar colour;
};

Badge badge_of(MeasureStatus status) {
  switch (status) {
    case MeasureStatus::ok:
      return {"ok", kGreen};
    case MeasureStatus::flagged:
      return {"flagged", kOrange};
    case MeasureStatus::refused:
      return {"refused", kVermilion};
  }
  return {};
}

std::string heading(const ReposeAngle& measured) {
  if (!measured.angle_rad) return "no angle";
  return angle_text(*measured.angle_rad, measured.uncertainty_rad);
}

std::string details(const ReposeAngle& measured) {
  std::string text = fmt::format("{} method · window {:.0f}–{:.0f} % of the height",
                                 measured.method == Method::paper ? "paper" : "auto",
                                 100 * measured.window[0], 100 * measured.window[1]);
  if (measured.ground_tilt_rad) {
    text += fmt::format(" · ground tilt {:.1f}°", to_degrees(*measured.ground_tilt_rad));
  }
  if (!measured.segmentation.empty()) text += " · silhouette: " + measured.segmentation;
  return text + fmt::format(" · confidence {:.2f}", measured.confidence);
}

/// Text in the caption, wrapped to its width.
class Lines {
 public:
  Lines(const Lettering& lettering, int width) : lettering_(lettering), width_(width) {}

  void add(const std::string& text, int height, const cv::Scalar& colour) {
    for (const std::string& line : lettering_.wrap(text, height, width_)) {
      lines_.push_back({line, height, colour});
    }
  }
  const std::vector<CaptionLine>& all() const { return lines_; }

 private:
  const Lettering& lettering_;
  int width_;
  std::vector<CaptionLine> lines_;
};

std::vector<CaptionLine> lines_of(const ReposeAngle& measured, const OverlayNotes& notes,
                                  const Lettering& lettering, int width, int height) {
  Lines lines(lettering, width);
  lines.add(notes.title, height, kWhite);
  if (measured.status == MeasureStatus::refused) lines.add(measured.reason, height, kWhite);
  lines.add(details(measured), height, kGrey);
  for (const Warning& warning : measured.warnings) {
    lines.add("⚠ " + warning.message, height, kYellow);
  }
  return lines.all();
}

void draw_badge(cv::Mat& bar, const Badge& badge, cv::Point top_left, int height,
                const Lettering& lettering) {
  const int pad = height / 2;
  const cv::Rect plate(
      top_left, cv::Size(lettering.width(badge.text, height) + 2 * pad, height + height / 3));
  cv::rectangle(bar, plate, badge.colour, cv::FILLED);
  lettering.draw(bar, badge.text, top_left + cv::Point(pad, height / 6), height, kWhite);
}

}  // namespace

cv::Mat draw_caption(int width, const ReposeAngle& measured, const OverlayNotes& notes,
                     const Lettering& lettering) {
  const int height = std::max(14, width / 46);
  const int heading_height = 2 * height;
  const int pad = height;
  const int spacing = height / 3;
  const auto lines = lines_of(measured, notes, lettering, width - 2 * pad, height);

  int bar_height = pad + heading_height + spacing;
  for (const CaptionLine& line : lines) bar_height += line.height + spacing;
  cv::Mat bar(bar_height + pad - spacing, width, CV_8UC3, kDark);

  const std::string head = heading(measured);
  lettering.draw(bar, head, {pad, pad - height / 4}, heading_height, kWhite);
  const int badge_x = pad + lettering.width(head, heading_height) + pad;
  draw_badge(bar, badge_of(measured.status), {badge_x, pad + height / 6}, height, lettering);
  int y = pad + heading_height + spacing;
  for (const CaptionLine& line : lines) {
    lettering.draw(bar, line.text, {pad, y}, line.height, line.colour);
    y += line.height + spacing;
  }
  return bar;
}

}  // namespace repose::vision
