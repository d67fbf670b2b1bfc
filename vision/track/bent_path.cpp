#include "vision/track/bent_path.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace repose::vision {
namespace {

constexpr std::size_t kFewestInLine = 5;
/// Neighbouring places err alike: so many count as one.
constexpr double kPlacesAlike = 3;

/// Sums of places that are added one by one.
class LineSums {
 public:
  void add(const cv::Point2d& p) {
    ++count_;
    const cv::Point2d off = p - mean_;
    mean_ += off / count_;
    const cv::Point2d rest = p - mean_;
    xx_ += off.x * rest.x;
    xy_ += off.x * rest.y;
    yy_ += off.y * rest.y;
  }
  /// Sum of the squared distances from the line.
  double squares() const { return std::max(0.0, .5 * (xx_ + yy_) - half_spread()); }
  /// Sum of the squared places along the line.
  double spread() const { return .5 * (xx_ + yy_) + half_spread(); }
  double count() const { return count_; }

  PathLine line(const cv::Point2d& way, double variance) const {
    const double angle = .5 * std::atan2(2 * xy_, xx_ - yy_);
    cv::Point2d along(std::cos(angle), std::sin(angle));
    if (along.dot(way) < 0) along = -along;
    return {.middle = mean_,
            .along = along,
            .offset_error_px = std::sqrt(kPlacesAlike * variance / count_),
            .angle_error_rad = std::sqrt(kPlacesAlike * variance / spread())};
  }

 private:
  double half_spread() const { return std::hypot(.5 * (xx_ - yy_), xy_); }

  double count_ = 0;
  cv::Point2d mean_;
  double xx_ = 0, xy_ = 0, yy_ = 0;
};

/// Squared deviations of the first k places from their line, for each k.
std::vector<double> deviations(const std::vector<cv::Point2d>& path) {
  std::vector<double> squares = {0};
  LineSums sums;
  for (const cv::Point2d& p : path) {
    sums.add(p);
    squares.push_back(sums.squares());
  }
  return squares;
}

double distance_from(const PathLine& line, const cv::Point2d& p) {
  return std::abs((p - line.middle).cross(line.along));
}

/// Of the places that lie on one line, without those that do not, as where a grain hops at the
/// bend: it begins with the `sure` ones, which are farthest from there.
LineSums sums_along(std::span<const cv::Point2d> places, std::span<const cv::Point2d> sure) {
  constexpr int kRounds = 4;
  constexpr double kFarOff = 3 * 1.4826, kNear_px = .6;
  std::vector<cv::Point2d> kept(sure.begin(), sure.end());
  LineSums sums;
  for (int round = 0; kept.size() >= kFewestInLine; ++round) {
    sums = {};
    for (const cv::Point2d& p : kept) sums.add(p);
    if (round == kRounds) break;
    const PathLine line = sums.line({}, 0);
    std::vector<double> distances;
    for (const cv::Point2d& p : kept) distances.push_back(distance_from(line, p));
    const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
    std::nth_element(distances.begin(), middle, distances.end());
    const double most = std::max(kNear_px, kFarOff * *middle);
    kept.clear();
    std::copy_if(places.begin(), places.end(), std::back_inserter(kept),
                 [&](const cv::Point2d& p) { return distance_from(line, p) <= most; });
  }
  return sums;
}

/// Standard error across the line, beside a place on it.
double error_at(const PathLine& line, const cv::Point2d& p) {
  return std::hypot(line.offset_error_px, line.angle_error_rad * (p - line.middle).dot(line.along));
}

/// The number of the first place on the second line.
std::size_t bend_of(const std::vector<cv::Point2d>& path) {
  const std::vector<double> before = deviations(path);
  const std::vector<double> after = deviations({path.rbegin(), path.rend()});
  std::size_t bend = kFewestInLine;
  for (std::size_t k = kFewestInLine; k + kFewestInLine <= path.size(); ++k) {
    if (before[k] + after[path.size() - k] < before[bend] + after[path.size() - bend]) bend = k;
  }
  return bend;
}

}  // namespace

std::optional<BentPath> bent_path_through(const std::vector<cv::Point2d>& path) {
  // The places next to the bend may be on both lines at once.
  if (path.size() < 2 * kFewestInLine + 2) return std::nullopt;
  const std::size_t bend = bend_of(path);
  const std::span<const cv::Point2d> all = path;
  const auto before = all.first(bend - 1), after = all.subspan(bend + 1);
  const auto far = [](std::size_t count) {
    return std::max(count / 2, std::min(count, kFewestInLine));
  };
  const LineSums down = sums_along(before, before.first(far(before.size())));
  const LineSums out = sums_along(after, after.last(far(after.size())));
  const double used = down.count() + out.count();
  if (std::min(down.count(), out.count()) < kFewestInLine - 1) return std::nullopt;
  const double variance = (down.squares() + out.squares()) / std::max(1.0, used - 4);
  BentPath found;
  found.incline = down.line(path[bend - 1] - path.front(), variance);
  found.flat = out.line(path.back() - path[bend], variance);
  found.rms_px = std::sqrt(variance);
  found.left_out = 1 - used / static_cast<double>(path.size() - 2);
  const PathLine &a = found.incline, &b = found.flat;
  const double sine = std::abs(a.along.cross(b.along));
  constexpr double kLeastSine = 1e-3;
  if (sine < kLeastSine) return std::nullopt;
  found.bend_rad = std::atan2(sine, a.along.dot(b.along));
  found.bend_error_rad = std::hypot(a.angle_error_rad, b.angle_error_rad);
  found.corner =
      b.middle + b.along * ((a.middle - b.middle).cross(a.along) / b.along.cross(a.along));
  found.corner_error_px =
      std::hypot(error_at(a, found.corner), error_at(b, found.corner) * std::cos(found.bend_rad)) /
      sine;
  return found;
}

}  // namespace repose::vision
