#include "vision/drawing/angle_strip.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "vision/drawing/comparison_style.h"

namespace repose::vision {
namespace {

/// An axis from one whole degree to another.
struct Axis {
  double from_deg = 0;
  double to_deg = 1;
  double left_px = 0;
  double width_px = 1;

  double at(double degrees) const {
    return left_px + width_px * (degrees - from_deg) / (to_deg - from_deg);
  }
};

Axis axis_for(int width, const std::array<SetOfHeaps, 2>& sets) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  const auto include = [&](double angle_rad) {
    low = std::min(low, to_degrees(angle_rad));
    high = std::max(high, to_degrees(angle_rad));
  };
  for (const SetOfHeaps& set : sets) {
    for (const std::optional<double>& angle : set.angle_rad) {
      if (angle) include(*angle);
    }
    if (!set.mean_rad) continue;
    include(*set.mean_rad - set.uncertainty_rad.value_or(0));
    include(*set.mean_rad + set.uncertainty_rad.value_or(0));
  }
  constexpr double kSide = 0.06;  // of the width
  return {.from_deg = std::floor(low),
          .to_deg = std::max(std::ceil(high), std::floor(low) + 1),
          .left_px = kSide * width,
          .width_px = (1 - 2 * kSide) * width};
}

void draw_set(const Canvas& canvas, const Axis& axis, const SetOfHeaps& set, std::size_t number,
              double y, double row) {
  const double radius = row / 7;
  const cv::Scalar colour = number == 0 ? kInk : kVermilion;
  for (const std::optional<double>& angle : set.angle_rad) {
    if (!angle) continue;
    const cv::Point centre(cvRound(axis.at(to_degrees(*angle))), cvRound(y - row / 5));
    cv::circle(canvas.image(), centre, cvRound(radius), colour, cvRound(row / 18), cv::LINE_AA);
  }
  if (!set.mean_rad) return;
  const double mean = axis.at(to_degrees(*set.mean_rad));
  const double below = y + row / 5;
  if (set.uncertainty_rad) {
    const double reach = to_degrees(*set.uncertainty_rad);
    draw_heap_line(canvas,
                   {{axis.at(to_degrees(*set.mean_rad) - reach), below},
                    {axis.at(to_degrees(*set.mean_rad) + reach), below}},
                   number);
  }
  canvas.draw({{mean, below - row / 6}, {mean, below + row / 6}}, colour, 1.6);
}

void draw_axis(const Canvas& canvas, const Axis& axis, double y, int letters,
               const Lettering& lettering) {
  canvas.draw({{axis.at(axis.from_deg), y}, {axis.at(axis.to_deg), y}}, kFaint, 0.4);
  const double span = axis.to_deg - axis.from_deg;
  const double step = span <= 12 ? 1 : span <= 30 ? 2 : 5;
  for (double degree = axis.from_deg; degree <= axis.to_deg; degree += step) {
    const double x = axis.at(degree);
    canvas.draw({{x, y}, {x, y + letters / 4.0}}, kFaint, 0.4);
    const std::string text = fmt::format("{:g}°", degree);
    lettering.draw(canvas.image(), text,
                   {cvRound(x) - lettering.width(text, letters) / 2, cvRound(y) + letters / 2},
                   letters, kFaint);
  }
}

}  // namespace

cv::Mat draw_angle_strip(int width, const std::array<SetOfHeaps, 2>& sets,
                         const Lettering& lettering) {
  const int letters = std::max(14, width / 60);
  const double row = 3.0 * letters;
  cv::Mat image(cvRound(2 * row) + 3 * letters, width, CV_8UC3, kWhite);
  const Canvas canvas(image, 1, kWhite);
  const Axis axis = axis_for(width, sets);
  for (const std::size_t set : {0, 1}) {
    draw_set(canvas, axis, sets[set], set, (static_cast<double>(set) + 0.5) * row + letters / 2.0,
             row);
  }
  draw_axis(canvas, axis, 2 * row + letters, letters, lettering);
  return image;
}

}  // namespace repose::vision
