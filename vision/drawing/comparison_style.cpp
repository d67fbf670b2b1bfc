#include "vision/drawing/comparison_style.h"

#include <cmath>

#include <fmt/format.h>

namespace repose::vision {
namespace {

/// The longest of 1, 2, 5, 10, ... that fits.
double round_length(double most) {
  const double decade = std::pow(10.0, std::floor(std::log10(most)));
  for (const double step : {5.0, 2.0}) {
    if (step * decade <= most) return step * decade;
  }
  return decade;
}

}  // namespace

void draw_heap_line(const Canvas& canvas, const Path& path, std::size_t heap) {
  constexpr double kWeight = 1.3;
  constexpr double kDash = 0.02;
  if (heap == 0) {
    canvas.draw(path, kInk, kWeight);
  } else {
    canvas.draw_dashed(path, kVermilion, kWeight, kDash);
  }
}

void draw_scale_bar(const Canvas& canvas, double px_per_m, const Lettering& lettering) {
  const cv::Mat& image = canvas.image();
  const double length_m = round_length(image.cols / 6.0 / px_per_m);
  const double pad = canvas.length(0.02);
  const cv::Point2d from(pad, pad), to(pad + length_m * px_per_m, pad);
  const cv::Point2d tick(0, canvas.length(0.008));
  canvas.draw({from, to}, kInk, 0.5);
  for (const cv::Point2d end : {from, to}) canvas.draw({end - tick, end + tick}, kInk, 0.5);
  const int height = cvRound(canvas.length(0.026));
  lettering.draw(canvas.image(), fmt::format("{:g} mm", length_m * 1000),
                 cv::Point(cvRound(pad), cvRound(pad + tick.y) + height / 4), height, kInk);
}

std::string length_text(double length, LengthUnit unit) {
  if (unit == LengthUnit::metre) return fmt::format("{:.3g} mm", length * 1000);
  return fmt::format("{:.1f} % of the {}", 100 * length,
                     unit == LengthUnit::height ? "height" : "area's square root");
}

std::string difference_text(const std::optional<AngleDifference>& angle, double margin_rad) {
  if (!angle) return "an angle is missing: angles not compared";
  const char* verdict = angle->verdict == Agreement::equivalent  ? "equivalent"
                        : angle->verdict == Agreement::different ? "different"
                                                                 : "cannot tell";
  // Adding 0 turns a rounded -0.0 into 0.0.
  const auto tenths = [](double rad) { return std::round(10 * to_degrees(rad)) / 10 + 0; };
  return fmt::format("angle difference {:.1f}° (95 %: {:.1f} to {:.1f}°): {} · margin {:g}°",
                     tenths(angle->difference_rad), tenths(angle->interval_rad[0]),
                     tenths(angle->interval_rad[1]), verdict, to_degrees(margin_rad));
}

}  // namespace repose::vision
