#include "vision/track/grain_template.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace repose::vision {
namespace {

cv::Vec3f at(const cv::Mat& bgr, double x, double y) {
  const int column = cvFloor(x), row = cvFloor(y);
  const auto fx = static_cast<float>(x - column), fy = static_cast<float>(y - row);
  const auto* above = bgr.ptr<cv::Vec3b>(row);
  const auto* below = bgr.ptr<cv::Vec3b>(row + 1);
  return (1 - fy) * ((1 - fx) * cv::Vec3f(above[column]) + fx * cv::Vec3f(above[column + 1])) +
         fy * ((1 - fx) * cv::Vec3f(below[column]) + fx * cv::Vec3f(below[column + 1]));
}

void take_out_mean(std::vector<cv::Vec3f>& colours) {
  cv::Vec3f mean(0, 0, 0);
  const auto count = static_cast<float>(colours.size());
  for (const cv::Vec3f& one : colours) mean += one / count;
  for (cv::Vec3f& one : colours) one -= mean;
}

}  // namespace

GrainTemplate::GrainTemplate(const cv::Mat& bgr, const cv::Mat& mask) {
  std::vector<cv::Vec3f> colours;
  for (int y = 1; y + 1 < bgr.rows; ++y) {
    for (int x = 1; x + 1 < bgr.cols; ++x) {
      if (mask.at<uchar>(y, x) == 0) continue;
      const auto colour = [&](int row, int column) {
        return cv::Vec3f(bgr.at<cv::Vec3b>(row, column));
      };
      colours.push_back(colour(y, x));
      pixels_.push_back({.place = cv::Point2d(x, y),
                         .colour = {},
                         .across = .5F * (colour(y, x + 1) - colour(y, x - 1)),
                         .down = .5F * (colour(y + 1, x) - colour(y - 1, x))});
      centre_ += cv::Point2d(x, y);
    }
  }
  if (pixels_.empty()) return;
  centre_ /= static_cast<double>(pixels_.size());
  take_out_mean(colours);
  for (std::size_t k = 0; k < pixels_.size(); ++k) {
    pixels_[k].place -= centre_;
    pixels_[k].colour = colours[k];
    contrast_ += colours[k].dot(colours[k]);
    mean_square_px2_ +=
        pixels_[k].place.dot(pixels_[k].place) / static_cast<double>(pixels_.size());
  }
}

/// False where most of it would lie outside.
bool GrainTemplate::sample(const cv::Mat& bgr, const TemplateMatch& match,
                           std::vector<cv::Vec3f>& seen) const {
  const double c = std::cos(match.turned_rad), s = std::sin(match.turned_rad);
  const cv::Point2d centre = centre_ + match.moved;
  if (centre.x < 1 || centre.y < 1 || centre.x > bgr.cols - 2 || centre.y > bgr.rows - 2)
    return false;
  seen.clear();
  for (const Pixel& pixel : pixels_) {
    const double x = centre.x + c * pixel.place.x - s * pixel.place.y;
    const double y = centre.y + s * pixel.place.x + c * pixel.place.y;
    seen.push_back(
        at(bgr, std::clamp(x, 0.0, bgr.cols - 1.001), std::clamp(y, 0.0, bgr.rows - 1.001)));
  }
  take_out_mean(seen);
  return true;
}

double GrainTemplate::squares(const std::vector<cv::Vec3f>& seen) const {
  double sum = 0;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const cv::Vec3f off = seen[k] - pixels_[k].colour;
    sum += off.dot(off);
  }
  return sum;
}

TemplateMatch GrainTemplate::refined(const cv::Mat& bgr, TemplateMatch match, bool turns) const {
  constexpr int kRounds = 12;
  constexpr double kEnough_px = .002, kLongest_px = 1.5;
  cv::Matx33d normal = cv::Matx33d::zeros();
  const auto terms_of = [&](const Pixel& pixel, int channel) {
    const double across = pixel.across[channel], down = pixel.down[channel];
    return cv::Vec3d(across, down, turns ? down * pixel.place.x - across * pixel.place.y : 0);
  };
  for (const Pixel& pixel : pixels_) {
    for (int channel = 0; channel < 3; ++channel) {
      const cv::Vec3d terms = terms_of(pixel, channel);
      normal += terms * terms.t();
    }
  }
  // Of a round one the turn is unknown, and stays what it was.
  constexpr double kRidge = 1e-3, kTurnRidge = .02;
  const double spread = normal(0, 0) + normal(1, 1);
  normal(0, 0) += kRidge * spread;
  normal(1, 1) += kRidge * spread;
  normal(2, 2) += kTurnRidge * spread * mean_square_px2_ + kRidge * spread;
  std::vector<cv::Vec3f> seen;
  for (int round = 0; round < kRounds; ++round) {
    if (!sample(bgr, match, seen)) break;
    cv::Vec3d right(0, 0, 0);
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const cv::Vec3f off = seen[k] - pixels_[k].colour;
      for (int channel = 0; channel < 3; ++channel) {
        right += off[channel] * terms_of(pixels_[k], channel);
      }
    }
    const cv::Vec3d step = normal.solve(right, cv::DECOMP_CHOLESKY);
    const double c = std::cos(match.turned_rad), s = std::sin(match.turned_rad);
    cv::Point2d moved(c * step[0] - s * step[1], s * step[0] + c * step[1]);
    const double length = std::hypot(moved.x, moved.y);
    if (length > kLongest_px) moved *= kLongest_px / length;
    match.moved -= moved;
    match.turned_rad -= step[2];
    if (length < kEnough_px) break;
  }
  match.likeness = 0;
  if (contrast_ > 0 && sample(bgr, match, seen)) match.likeness = 1 - squares(seen) / contrast_;
  return match;
}

TemplateMatch GrainTemplate::find(const cv::Mat& bgr, const TemplateMatch& expected,
                                  int reach_px) const {
  constexpr int kRise_px = 1;
  TemplateMatch best = expected;
  double least = std::numeric_limits<double>::infinity();
  std::vector<cv::Vec3f> seen;
  for (int rise = -kRise_px; rise <= kRise_px; ++rise) {
    for (int along = -reach_px; along <= reach_px; ++along) {
      const TemplateMatch one{.moved = expected.moved + cv::Point2d(along, rise),
                              .turned_rad = expected.turned_rad};
      if (!sample(bgr, one, seen)) continue;
      const double off = squares(seen);
      if (off >= least) continue;
      least = off;
      best = one;
    }
  }
  return refined(bgr, best, false);
}

TemplateMatch GrainTemplate::find_turned(const cv::Mat& bgr, const TemplateMatch& found) const {
  return refined(bgr, found, true);
}

}  // namespace repose::vision
