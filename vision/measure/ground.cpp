#include "vision/measure/ground.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/core.hpp>

#include "base/units.h"
#include "vision/measure/line_fit.h"

namespace repose::vision {

namespace {

constexpr std::size_t kTrialPoints = 60;
constexpr double kBelowPenalty = 2;  // a point below the ground counts twice against it

constexpr int kBand = 4;         // px on either side of the line that are compared
constexpr int kStretches = 40;   // parts of the line that must each show a step
constexpr double kTails = 0.25;  // of the base's width: bare ground included on each side

constexpr double kMaxBelow = 0.15;  // of the points: a region that extends far below a line does
                                    // not stand on it

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
  // Neighbouring base points belong to one grain: every tenth counts as independent.
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
  if (static_cast<double>(below) > kMaxBelow * static_cast<double>(points.size())) {
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

namespace {

constexpr double kTailFraction = 0.12;  // of the frame's width that must be bare ground
constexpr double kTailTolerance = 1.6;  // px: bare ground is smooth, an apron of grains is not
constexpr int kTailDepth = 15;          // px of the ground that are compared with the heap
constexpr double kSameMaterial = 9;     // distance in L*a*b* and roughness
constexpr double kOtherColour = 6;      // distance in a*b* alone, which shadows do not change
constexpr double kHeapsOwn = 1.6;     // times closer in colour to the heap: not a reflection of it
constexpr double kNearer = 1.3;       // times closer in colour to the ground than to the heap
constexpr double kBesideBase = 0.15;  // of the base's width: ground on each side of it
constexpr std::size_t kFewestColumns = 8;
constexpr int kSkirtDepth = 6;          // px below the ground that may not show the heap
constexpr double kStraightBase = 0.04;  // bow of a base that is a line, as a fraction of its width
constexpr double kRaggedBase = 0.15;    // bow upwards: gaps in the base, but no arch
// Standard uncertainty of the tilt if the base is the frame's edge or a box: camera levelled by
// eye.
constexpr double kRoll_rad = 1 * kDegree;
constexpr int kFrameMargin = 3;         // px: anything ending this close to the frame is cut off
constexpr double kBaseTolerance = 3.0;  // px: grains touch the ground only here and there

constexpr double kEqualEvidence = 0.9;  // of the best line's: equally good
constexpr double kPlainEdge = 0.6;      // evidence above which a line lies on an edge
constexpr double kBetterEdge = 1.1;     // times the evidence: a search result worth accepting
constexpr double kFarthest = 6;         // px by which a search moves an end
constexpr double kFirstStep = 4;        // px by which the search moves the line's ends
constexpr double kLastStep = 0.5;
constexpr int kMaxMoves = 24;

std::vector<Point> points_of(const std::vector<int>& rows, double offset) {
  std::vector<Point> points;
  for (std::size_t col = 0; col < rows.size(); ++col) {
    if (rows[col] >= 0) points.push_back({static_cast<double>(col) + 0.5, rows[col] + offset});
  }
  return points;
}

/// Mean colour and roughness of a region, as one vector in L*a*b* units.
struct Material {
  cv::Vec4d sum;
  double count = 0;

  void add(const WorkingPicture& work, int row, int col) {
    const cv::Vec3f here = work.lab(row, col);
    const double step = row > 0 ? std::abs(here[0] - work.lab(row - 1, col)[0]) : 0;
    sum += cv::Vec4d(here[0], here[1], here[2], 2 * step);
    ++count;
  }
  cv::Vec4d mean() const { return sum / std::max(1.0, count); }
};

/// Whether the layer below a line through the outline's tails is made of the heap's own material:
/// if so, it is an apron of grains, not the ground.
bool tails_are_grains(const Spans& spans, const PictureLine& line, const WorkingPicture& work) {
  Material tail;
  Material heap;
  for (std::size_t i = 0; i < spans.top.size(); ++i) {
    if (spans.top[i] < 0) continue;
    const int col = static_cast<int>(i);
    const double ground = line.y(col + 0.5);
    const int level = static_cast<int>(std::lround(ground));
    if (std::abs(spans.top[i] - ground) <= kTailTolerance) {
      const int last = std::min({spans.bottom[i], level + kTailDepth, work.lab.rows - 1});
      for (int row = std::max(0, level + 2); row <= last; ++row) tail.add(work, row, col);
    } else if (spans.top[i] < ground - kTailDepth) {
      for (int row = spans.top[i] + 3; row < level - 2; row += 2) heap.add(work, row, col);
    }
  }
  return tail.count > 0 && heap.count > 0 && cv::norm(tail.mean() - heap.mean()) < kSameMaterial;
}

/// The colour part of a difference between two materials, without lightness and roughness.
double colour_of(const cv::Vec4d& difference) { return std::hypot(difference[1], difference[2]); }

/// Whether the heap's material extends below a line through the outline's tails, where the material
/// is a different one: if so, the line is an edge behind the heap (the table's far edge, seen from
/// slightly above), and the heap's foot is lower.
bool goes_on_below(const Spans& spans, const PictureLine& line, const WorkingPicture& work) {
  Material tail;
  Material above;
  Material below;
  for (std::size_t i = 0; i < spans.top.size(); ++i) {
    if (spans.top[i] < 0) continue;
    const int col = static_cast<int>(i);
    const double ground = line.y(col + 0.5);
    const int level = static_cast<int>(std::lround(ground));
    const bool is_tail = std::abs(spans.top[i] - ground) <= kTailTolerance;
    if (!is_tail && spans.top[i] >= ground - kTailDepth) continue;
    const int last = std::min(level + 2 + kSkirtDepth, work.lab.rows);
    for (int row = std::max(0, level + 2); row < last; ++row) {
      (is_tail ? tail : below).add(work, row, col);
    }
    const int first = std::max(0, level - 2 - kSkirtDepth);
    for (int row = first; !is_tail && row < level - 2; ++row) above.add(work, row, col);
  }
  if (tail.count == 0 || above.count == 0 || below.count == 0) return false;
  const cv::Vec4d from_heap = above.mean() - below.mean();
  const cv::Vec4d from_tail = tail.mean() - below.mean();
  if (cv::norm(from_tail) < kSameMaterial) return false;
  // Shaded grains have the heap's colour, but not its lightness.
  const bool is_shaded = colour_of(from_tail) >= kOtherColour &&
                         kHeapsOwn * colour_of(from_heap) < colour_of(from_tail);
  return cv::norm(from_heap) < kSameMaterial || is_shaded;
}

/// Whether the heap ends above a line through the lower outline: just above the line, the strip
/// below the heap has the colour of the strip beside it, not that of the heap. In that case the
/// region has run down over the ground to an edge in front of the heap.
bool ends_above(const Spans& spans, const PictureLine& line, const WorkingPicture& work) {
  const std::vector<Point> tops = points_of(spans.top, 0);
  if (tops.size() < kFewestColumns) return false;
  const double first = tops.front().x;
  const double last = tops.back().x;
  const double beside = kBesideBase * (last - first);
  Material heap;
  Material strip;
  Material ground;
  for (int col = std::max(work.frame.x, static_cast<int>(first - beside));
       col < std::min(work.frame.br().x, static_cast<int>(last + beside)); ++col) {
    const int level = static_cast<int>(std::lround(line.y(col + 0.5)));
    const int top = spans.top[static_cast<std::size_t>(col)];
    const bool is_heap = top >= 0 && top < level - kTailDepth;
    if (top >= 0 && !is_heap) continue;
    const int end = std::min(level - 2, work.lab.rows);
    for (int row = std::max(0, level - 2 - kSkirtDepth); row < end; ++row) {
      (is_heap ? strip : ground).add(work, row, col);
    }
    for (int row = top + 3; is_heap && row < (top + level) / 2; row += 2) heap.add(work, row, col);
  }
  if (heap.count == 0 || strip.count == 0 || ground.count == 0) return false;
  const double from_heap = colour_of(heap.mean() - strip.mean());
  return from_heap >= kOtherColour && kNearer * colour_of(ground.mean() - strip.mean()) < from_heap;
}

/// Bare ground left or right of the heap, if the segmentation included the ground: a smooth stretch
/// of the upper outline that reaches the frame, with everything else above it.
std::optional<Ground> ground_from_tails(const Spans& spans, const WorkingPicture& work) {
  const cv::Rect& frame = work.frame;
  const auto reaches = [&](int col) { return spans.top[static_cast<std::size_t>(col)] >= 0; };
  const bool left = reaches(frame.x + 2);
  const bool right = reaches(frame.br().x - 3);
  if (!left && !right) return std::nullopt;
  const std::vector<Point> tops = points_of(spans.top, 0);
  const auto line = support_line(tops, kTailTolerance);
  if (!line || line->fraction * static_cast<double>(tops.size()) < kTailFraction * frame.width ||
      tails_are_grains(spans, line->line, work)) {
    return std::nullopt;
  }
  Ground ground{line->line, line->deviation_rad, std::nullopt, false};
  ground.behind = goes_on_below(spans, line->line, work);
  return ground;
}

/// c of y = a + b x + c x^2 through the points, as the bow's depth over the width.
double bow_of(const std::vector<Point>& points) {
  if (points.size() < 8) return 0;
  const double middle = (points.front().x + points.back().x) / 2;
  const double reach = (points.back().x - points.front().x) / 2;
  cv::Matx33d normal = cv::Matx33d::zeros();
  cv::Vec3d right;
  for (const Point& p : points) {
    const double u = (p.x - middle) / reach;
    const cv::Vec3d terms(1, u, u * u);
    normal += terms * terms.t();
    right += terms * p.y;
  }
  const cv::Vec3d fit = normal.solve(right, cv::DECOMP_SVD);
  return -fit[2] / (2 * reach);
}

/// The axis of a reflection: half-way between the upper and the lower outline everywhere. The part
/// below must look different, since a reflection is weaker; otherwise this is one body seen from
/// above.
std::optional<Ground> ground_from_mirror(const Spans& spans, const WorkingPicture& work) {
  std::vector<Point> middles;
  for (std::size_t col = 0; col < spans.top.size(); ++col) {
    if (spans.top[col] < 0) continue;
    middles.push_back(
        {static_cast<double>(col) + 0.5, (spans.top[col] + spans.bottom[col] + 1) / 2.0});
  }
  const auto axis = support_line(middles, kBaseTolerance);
  if (!axis || axis->fraction <= 0.5) return std::nullopt;
  Material heap;
  Material image;
  for (std::size_t i = 0; i < spans.top.size(); ++i) {
    if (spans.top[i] < 0) continue;
    const int col = static_cast<int>(i);
    const int level = static_cast<int>(std::lround(axis->line.y(col + 0.5)));
    for (int row = spans.top[i] + 3; row < level - 2; row += 2) heap.add(work, row, col);
    for (int row = level + 3; row < spans.bottom[i] - 2; row += 2) image.add(work, row, col);
  }
  if (cv::norm(heap.mean() - image.mean()) < kSameMaterial) return std::nullopt;
  return Ground{axis->line, axis->deviation_rad, std::nullopt, true};
}

/// The lower outline where it is visible: where the region runs out of the frame or under an
/// excluded box, its end says nothing about the ground.
std::vector<Point> seen_bottoms(const Spans& spans, const WorkingPicture& work) {
  std::vector<Point> seen;
  for (std::size_t i = 0; i < spans.bottom.size(); ++i) {
    const int row = spans.bottom[i];
    if (row < 0 || row + kFrameMargin >= work.frame.br().y) continue;
    const int col = static_cast<int>(i);
    if (work.valid_mask(row + 1, col) == 0) continue;
    seen.push_back({col + 0.5, row + 1.0});
  }
  return seen;
}

/// The base of a heap that the segmentation separated from the ground.
std::optional<Ground> ground_from_base(const Spans& spans, const WorkingPicture& work) {
  const std::vector<Point> all = points_of(spans.bottom, 1);
  std::vector<Point> bottoms = seen_bottoms(spans, work);
  const bool hidden = 2 * bottoms.size() < all.size();
  if (hidden) bottoms = all;
  const double bow = bow_of(bottoms);
  std::optional<SupportLine> base;
  for (const double looser : {1.0, 2.0, 3.5}) {  // large grains leave large gaps at the ground
    base = support_line(bottoms, looser * kBaseTolerance);
    if (base && base->fraction > 0.5 && bow < kStraightBase && bow > -kRaggedBase) {
      if (!hidden) {
        Ground ground{base->line, base->deviation_rad, bow, false};
        ground.before = ends_above(spans, base->line, work);
        return ground;
      }
      return Ground{base->line, std::hypot(base->deviation_rad, kRoll_rad), std::nullopt, false};
    }
  }
  if (auto mirror = ground_from_mirror(spans, work)) return mirror;
  if (!base || bow < 0) return std::nullopt;
  // A bowed base: the heap stands on the line through its two ends.
  const Point& first = bottoms.front();
  const Point& last = bottoms.back();
  const double slope = (last.y - first.y) / std::max(1.0, last.x - first.x);
  if (std::abs(std::atan(slope)) > kMaxGroundTilt_rad) return std::nullopt;
  return Ground{{first.y - slope * first.x, slope}, base->deviation_rad, bow, false};
}

struct Edge {
  PictureLine line;
  double valid_mask = 0;
};

/// How a search may move the line's ends, in steps. A base that bows, seen from slightly above, is
/// not a line: turning the line towards either half would look better. It is only shifted.
std::vector<std::pair<int, int>> moves_of(const std::optional<double>& bow) {
  std::vector<std::pair<int, int>> moves = {{1, 1}, {-1, -1}};
  if (bow.value_or(0) <= kFlatBase) {
    moves.insert(moves.end(), {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, -1}, {-1, 1}});
  }
  return moves;
}

/// Whether both ends lie within the search's range of where it began: the next edge of a plate does
/// not.
bool is_near(const PictureLine& line, const PictureLine& start, const Base& base) {
  return std::abs(line.y(base.from) - start.y(base.from)) <= kFarthest &&
         std::abs(line.y(base.to) - start.y(base.to)) <= kFarthest;
}

/// Pattern search: moves the line's ends as long as the picture shows a better edge.
Edge edge_near(const Edge& start, const std::optional<double>& bow, const Base& base,
               const WorkingPicture& work) {
  const auto moves = moves_of(bow);
  const double width = std::max(1.0, base.to - base.from);
  Edge best = start;
  double step = kFirstStep;
  for (int move = 0; move < kMaxMoves && step >= kLastStep; ++move) {
    const Edge here = best;
    for (const auto& [left, right] : moves) {
      PictureLine line = here.line;
      line.slope += step * (right - left) / width;
      line.y_at_0 = here.line.y(base.from) + step * left - line.slope * base.from;
      if (std::abs(line.tilt_rad()) > kMaxGroundTilt_rad) continue;
      if (!is_near(line, start.line, base)) continue;
      const double valid_mask = ground_evidence(line, base, work);
      if (valid_mask > best.valid_mask) best = {line, valid_mask};
    }
    if (best.valid_mask <= here.valid_mask) step /= 2;
  }
  return best;
}

/// Instead of an edge in front of the heap, the best line at its foot, if there is one.
std::size_t best_foot_behind(const std::vector<Ground>& candidates,
                             const std::vector<double>& evidence, std::size_t best) {
  std::size_t foot = best;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].before || candidates[i].behind || candidates[i].mirrored) continue;
    if (foot == best || evidence[i] > evidence[foot]) foot = i;
  }
  return foot;
}

/// The candidate with the best evidence; but if the heap extends below it, the best of those at its
/// foot, if there are any.
std::size_t best_of(const std::vector<Ground>& candidates, const std::vector<double>& evidence,
                    const Base& base) {
  const auto best = static_cast<std::size_t>(std::max_element(evidence.begin(), evidence.end()) -
                                             evidence.begin());
  if (candidates.at(best).before) return best_foot_behind(candidates, evidence, best);
  if (!candidates.at(best).behind) return best;
  const double middle = (base.from + base.to) / 2;
  std::size_t foot = best;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (candidates[i].behind || candidates[i].mirrored) continue;
    if (candidates[i].y(middle) < candidates[best].y(middle) + kBaseTolerance) continue;
    if (foot == best || evidence[i] > evidence[foot]) foot = i;
  }
  return foot;
}

}  // namespace

Ground best_ground(const std::vector<Ground>& candidates, const Base& base,
                   const WorkingPicture& work) {
  std::vector<double> valid_mask;
  for (const Ground& ground : candidates) valid_mask.push_back(ground_evidence(ground, base, work));
  const std::size_t chosen = best_of(candidates, valid_mask, base);
  Ground best = candidates.at(chosen);
  double squares = 0;
  int rivals = 0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (i == chosen || valid_mask[i] < kEqualEvidence * valid_mask[chosen]) continue;
    const double away = candidates[i].tilt_rad() - best.tilt_rad();
    squares += away * away;
    ++rivals;
  }
  best.deviation_rad = std::hypot(best.deviation_rad, std::sqrt(squares / std::max(1, rivals)));
  if (valid_mask[chosen] >= kPlainEdge || best.mirrored) return best;
  // A search would find the edge behind the heap again.
  if (std::ranges::any_of(candidates, &Ground::behind)) return best;
  const Edge edge =
      edge_near({static_cast<const PictureLine&>(best), valid_mask[chosen]}, best.bow, base, work);
  if (edge.valid_mask < kBetterEdge * valid_mask[chosen]) return best;
  const double change = edge.line.tilt_rad() - best.tilt_rad();
  best.deviation_rad = std::hypot(best.deviation_rad, change / 2);
  static_cast<PictureLine&>(best) = edge.line;
  return best;
}

std::optional<Ground> find_ground(const Spans& region, const WorkingPicture& work) {
  if (auto tails = ground_from_tails(region, work)) return tails;
  return ground_from_base(region, work);
}

}  // namespace repose::vision
