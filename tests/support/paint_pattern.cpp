#include "tests/support/paint_pattern.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "tests/support/heap_texture.h"

namespace repose::testing {
namespace {

/// From -1 to 1, constant for each stone.
double shade_of(int row, int column) {
  const auto mixed = (static_cast<std::uint64_t>(row + 5000) * 0x9E3779B97F4A7C15) ^
                     (static_cast<std::uint64_t>(column + 5000) * 0xC2B2AE3D27D4EB4F);
  return static_cast<double>((mixed ^ (mixed >> 29)) % 1000) / 500 - 1;
}

/// Courses of stones whose joints are offset by half a stone.
double brick_at(double x, double y, double joint) {
  const int row = static_cast<int>(std::floor(y));
  const double along = x / 2 + (row % 2 == 0 ? 0 : .5);
  const int column = static_cast<int>(std::floor(along));
  if (y - row < joint || along - column < joint / 2) return 1.6;
  return .6 * shade_of(row, column);
}

/// Rows of tiles, each dark below the one above it.
double tile_at(double x, double y) {
  const int row = static_cast<int>(std::floor(y));
  const double along = x + (row % 2 == 0 ? 0 : .5);
  const int column = static_cast<int>(std::floor(along));
  const double arch = std::abs(along - column - .5);
  return 1.2 * (y - row) - .8 - (arch > .43 ? 1.2 : 0) + .4 * shade_of(row, column);
}

double plank_at(double x, double y) {
  const int row = static_cast<int>(std::floor(y / 3));
  const double in_row = y / 3 - row;
  return in_row < .07 ? -2.2 : .5 * shade_of(row, 0) + .2 * std::sin(9 * y + .3 * x);
}

template <class ValueAt>
cv::Mat drawn(cv::Size size, double scale_px, ValueAt value_at) {
  cv::Mat field(size, CV_32F);
  for (int row = 0; row < size.height; ++row) {
    for (int column = 0; column < size.width; ++column) {
      field.at<float>(row, column) =
          static_cast<float>(value_at(column / scale_px, row / scale_px));
    }
  }
  return field;
}

}  // namespace

cv::Mat pattern_field(Pattern pattern, cv::Size size, double scale_px, Random& random) {
  const double scale = std::max(1.0, scale_px);
  const double joint = random.uniform(.06, .16);
  const double turn_rad = random.uniform(0, CV_PI);
  switch (pattern) {
    case Pattern::noise:
      return texture_field(Texture::noise, size, scale, random);
    case Pattern::fabric:
      return texture_field(Texture::fabric, size, scale, random);
    case Pattern::wood:
      return texture_field(Texture::wood, size, scale, random);
    case Pattern::bricks:
      return drawn(size, scale, [=](double x, double y) { return brick_at(x, y, joint); });
    case Pattern::tiles:
      return drawn(size, scale, tile_at);
    case Pattern::planks:
      return drawn(size, scale, plank_at);
    case Pattern::stripes:
      return drawn(size, scale, [=](double x, double y) {
        return std::sin(CV_PI * (x * std::cos(turn_rad) + y * std::sin(turn_rad))) > 0 ? 1. : -1.;
      });
    case Pattern::plain:
      break;
  }
  return cv::Mat::zeros(size, CV_32F);
}

}  // namespace repose::testing
