#include "vision/measure/ground_line.h"

#include <algorithm>
#include <cmath>

#include "vision/measure/band.h"
#include "vision/measure/line_fit.h"

namespace repose::vision {
namespace {

constexpr std::size_t kTrialPoints = 60;
constexpr double kBelowPenalty = 2;  // a point below the ground speaks against it twice as loudly

constexpr int kBand = 4;         // px on either side of the line that are compared
constexpr int kStretches = 40;   // of the line that must each show a step
constexpr double kTails = 0.25;  // of the base's width: bare ground that counts on each side

constexpr double kMostBelow = 0.15;  // of the points: what lies far below a line is not on ground

std::vector<Point> thinned(const std::vector<Point>& points) {
  if (points.size() <= kTrialPoints) return points;
  std::vector<Point> subset;
  for (std::size_t i = 0; i < kTrialPoints; ++i) {
    subset.push_back(points[i * (points.size() - 1) / (kTrialPoints - 1)]);
  }
  return subset;
}

double support(const PictureLine& line, const std::vector<Point>& points, double tolerance) {
  double votes = 0;
  for (const Point& p : points) {
    const double below = p.y - line.y(p.x);
    if (std::abs(below) <= tolerance) {
      votes += 1 - 0.5 * std::abs(below) / tolerance;
    } else if (below > tolerance) {
      votes -= kBelowPenalty;
    }
  }
  return votes;
}

struct Refit {
  PictureLine line;
  double deviation_rad = 0;
  double fraction = 0;
};

Refit refit(const PictureLine& start, const std::vector<Point>& points, double tolerance) {
  std::vector<double> x;
  std::vector<double> y;
  for (const Point& p : points) {
    if (std::abs(p.y - start.y(p.x)) > tolerance) continue;
    x.push_back(p.x);
    y.push_back(p.y);
  }
  const LineFit fit = least_squares_line(x, y);
  double squares = 0;
  double spread = 0;
  const double middle = x.empty() ? 0 : (x.front() + x.back()) / 2;
  for (std::size_t i = 0; i < x.size(); ++i) {
    squares += (y[i] - fit.y(x[i])) * (y[i] - fit.y(x[i]));
    spread += (x[i] - middle) * (x[i] - middle);
  }
  // Neighbouring base points belong to one grain: count every tenth as independent.
  const double independent = std::max(3.0, static_cast<double>(x.size()) / 10);
  const double n = std::max<double>(1, static_cast<double>(x.size()));
  const double variance = (squares / n + 0.01) / (independent - 2);
  const double deviation = spread > 0 ? std::sqrt(variance / (spread / n)) : 0.1;
  return {{fit.intercept, fit.slope}, deviation, n / static_cast<double>(points.size())};
}

}  // namespace

std::optional<SupportLine> support_line(const std::vector<Point>& points, double tolerance) {
  if (points.size() < 8) return std::nullopt;
  const std::vector<Point> subset = thinned(points);
  const double steepest = std::tan(kMaxGroundTilt_rad);
  const double shortest = 0.1 * (points.back().x - points.front().x);
  double best_votes = 0;
  std::optional<PictureLine> best;
  for (std::size_t i = 0; i < subset.size(); ++i) {
    for (std::size_t j = i + 1; j < subset.size(); ++j) {
      const double dx = subset[j].x - subset[i].x;
      if (dx <= 0 || dx < shortest) continue;
      const double slope = (subset[j].y - subset[i].y) / dx;
      if (std::abs(slope) > steepest) continue;
      const PictureLine line{subset[i].y - slope * subset[i].x, slope};
      const double votes = support(line, subset, tolerance);
      if (!best || votes > best_votes) {
        best = line;
        best_votes = votes;
      }
    }
  }
  if (!best) return std::nullopt;
  std::size_t below = 0;
  for (const Point& p : points) below += p.y - best->y(p.x) > 3 * tolerance ? 1 : 0;
  if (static_cast<double>(below) > kMostBelow * static_cast<double>(points.size())) {
    return std::nullopt;
  }
  const Refit once = refit(*best, points, tolerance);
  const Refit twice = refit(once.line, points, tolerance);
  if (std::abs(twice.line.slope) > steepest) return std::nullopt;
  return SupportLine{twice.line, twice.fraction, twice.deviation_rad};
}

double ground_evidence(const PictureLine& ground, const Base& base, const WorkingPicture& work) {
  const double tail = kTails * (base.to - base.from);
  const int first = std::max(work.frame.x, static_cast<int>(base.from - tail));
  const int last = std::min(work.frame.br().x, static_cast<int>(base.to + tail));
  double sum = 0;
  for (int stretch = 0; stretch < kStretches; ++stretch) {
    Band above;
    Band below;
    const int end = first + (stretch + 1) * (last - first) / kStretches;
    for (int col = first + stretch * (last - first) / kStretches; col < end; ++col) {
      const int level = static_cast<int>(std::lround(ground.y(col + 0.5)));
      if (level - kBand < work.frame.y || level + kBand > work.frame.br().y) continue;
      for (int row = level - kBand; row < level + kBand; ++row) {
        if (work.valid_mask(row, col) != 0) (row < level ? above : below).add(work.lab(row, col));
      }
    }
    if (above.count == 0 || below.count == 0) continue;
    sum += saturated(step_contrast(above, below), 1) / kStretches;
  }
  return sum;
}

}  // namespace repose::vision
