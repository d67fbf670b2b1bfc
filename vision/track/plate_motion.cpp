#include "vision/track/plate_motion.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "base/units.h"
#include "vision/film/film_reader.h"
#include "vision/measure/line_fit.h"
#include "vision/track/blobs.h"

namespace repose::vision {

namespace {

constexpr float kMinStep = 2;  ///< grey levels per pixel, across an edge

double at(const cv::Mat& grey, const cv::Point2d& p) {
  const int x = cvFloor(p.x), y = cvFloor(p.y);
  const double fx = p.x - x, fy = p.y - y;
  const auto* above = grey.ptr<float>(y);
  const auto* below = grey.ptr<float>(y + 1);
  return (1 - fy) * ((1 - fx) * above[x] + fx * above[x + 1]) +
         fy * ((1 - fx) * below[x] + fx * below[x + 1]);
}

/// Sums of the steps along all lines of one slope, one for each row in the middle column.
std::vector<double> sums_along(const cv::Mat& steps, double slope, double sign) {
  std::vector<double> sums(static_cast<std::size_t>(steps.rows));
  constexpr float kMaxStep = 10;  // so that a long faint edge counts for more than a short one
  for (int x = 0; x < steps.cols; ++x) {
    const int shift = cvRound(slope * (x - .5 * steps.cols));
    const int first = std::max(0, -shift), last = std::min(steps.rows, steps.rows - shift);
    for (int y = first; y < last; ++y) {
      const float step = static_cast<float>(sign) * steps.at<float>(y + shift, x);
      if (step > kMinStep) sums[static_cast<std::size_t>(y)] += std::min(step, kMaxStep);
    }
  }
  return sums;
}

/// The longest stretch in which the edge is visible, apart from gaps as wide as a row of grains.
void find_ends(const cv::Mat& steps, PlateEdge& edge) {
  constexpr double kGap = .3;
  const int gap = cvRound(kGap * steps.cols);
  int from = -1, last = -1;
  const auto close = [&] {
    if (from >= 0 && last - from > edge.to - edge.from) {
      edge.from = from;
      edge.to = last;
    }
  };
  for (int x = 0; x < steps.cols; ++x) {
    const int row = cvRound(edge.line.row_at(x));
    float step = 0;
    for (int y = std::max(0, row - 1); y <= std::min(steps.rows - 1, row + 1); ++y) {
      step = std::max(step, static_cast<float>(edge.step) * steps.at<float>(y, x));
    }
    if (step <= kMinStep) continue;
    if (from < 0 || x - last > gap) {
      close();
      from = x;
    }
    last = x;
  }
  close();
}

/// Distances of the edge from the expected line, one for each column where it is visible.
struct Offsets {
  std::vector<double> along, across;
  int looked = 0;
};

Offsets offsets_from(const cv::Mat& grey, const PlateEdge& edge, const EdgeLine& line) {
  constexpr int kReach_px = 7;
  constexpr double kLikely_px = 3.5;
  Offsets offsets;
  const cv::Point2d normal = line.normal();
  for (int x = edge.from; x <= edge.to; ++x) {
    const cv::Point2d foot(x, line.row_at(x));
    const double margin = kReach_px + 2;
    if (foot.y < margin || foot.y >= grey.rows - 1 - margin || foot.x < margin ||
        foot.x >= grey.cols - 1 - margin)
      continue;
    ++offsets.looked;
    std::array<double, 2 * kReach_px + 3> values{};
    for (int k = 0; k < static_cast<int>(values.size()); ++k) {
      values[static_cast<std::size_t>(k)] = at(grey, foot + (k - kReach_px - 1) * normal);
    }
    std::array<double, 2 * kReach_px + 1> steps{};
    std::size_t best = 0;
    double most = 0;
    for (std::size_t k = 0; k < steps.size(); ++k) {
      steps[k] = .5 * edge.step * (values[k + 2] - values[k]);
      const double off = (static_cast<double>(k) - kReach_px) / kLikely_px;
      const double weighed = steps[k] * std::exp(-.5 * off * off);
      if (weighed <= most) continue;
      most = weighed;
      best = k;
    }
    if (steps[best] < kMinStep || best == 0 || best + 1 == steps.size()) continue;
    const double before = steps[best - 1], after = steps[best + 1];
    const double bend = before - 2 * steps[best] + after;
    const double part = bend < 0 ? std::clamp(.5 * (before - after) / bend, -.5, .5) : 0;
    offsets.along.push_back((x - .5 * (edge.from + edge.to)) / std::cos(line.roll_rad));
    offsets.across.push_back(static_cast<double>(best) - kReach_px + part);
  }
  return offsets;
}

/// A straight line through offsets, excluding outliers: offset, slope, and the number of points on
/// it.
struct OffsetLine {
  double offset = 0, slope = 0;
  int on = 0;
};

OffsetLine line_through(const Offsets& offsets) {
  constexpr int kRounds = 12;
  constexpr double kFirst_px = 4, kLast_px = .5, kOn_px = 1;
  OffsetLine line;
  double scale = kFirst_px;
  for (int round = 0; round < kRounds; ++round, scale = std::max(kLast_px, .7 * scale)) {
    double w = 0, wx = 0, wxx = 0, wy = 0, wxy = 0;
    for (std::size_t k = 0; k < offsets.along.size(); ++k) {
      const double x = offsets.along[k], y = offsets.across[k];
      const double off = (y - line.offset - line.slope * x) / scale;
      const double weight = 1 / ((1 + off * off) * (1 + off * off));
      w += weight;
      wx += weight * x;
      wxx += weight * x * x;
      wy += weight * y;
      wxy += weight * x * y;
    }
    const double spread = w * wxx - wx * wx;
    if (!(spread > 0)) return {};
    line.slope = (w * wxy - wx * wy) / spread;
    line.offset = (wy - line.slope * wx) / w;
  }
  for (std::size_t k = 0; k < offsets.along.size(); ++k) {
    const double off = offsets.across[k] - line.offset - line.slope * offsets.along[k];
    line.on += std::abs(off) < kOn_px ? 1 : 0;
  }
  return line;
}

}  // namespace

cv::Point2d EdgeLine::along() const { return {std::cos(roll_rad), std::sin(roll_rad)}; }

cv::Point2d EdgeLine::normal() const { return {-std::sin(roll_rad), std::cos(roll_rad)}; }

double EdgeLine::row_at(double column) const {
  return (offset_px + column * std::sin(roll_rad)) / std::cos(roll_rad);
}

cv::Mat edge_picture(const cv::Mat& bgr) {
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  grey.convertTo(grey, CV_32F);
  cv::GaussianBlur(grey, grey, {5, 5}, 1);
  return grey;
}

std::vector<PlateEdge> level_edges(const cv::Mat& grey, const cv::Mat& moves) {
  constexpr double kMaxLean_deg = 8, kStep_deg = .5;
  constexpr int kApart_px = 4;
  constexpr std::size_t kMax = 16;
  constexpr double kMinLength = .2;
  cv::Mat steps, near;
  cv::Sobel(grey, steps, CV_32F, 0, 1, 3, 1. / 8);
  cv::dilate(moves, near, cv::Mat(), {-1, -1}, 3);
  steps.setTo(0, near == 0);
  struct Found {
    double sum = 0, lean_deg = 0, sign = 1;
    int row = 0;
  };
  std::vector<Found> found;
  for (const double sign : {1.0, -1.0}) {
    std::vector<Found> best(static_cast<std::size_t>(steps.rows));
    for (double lean = -kMaxLean_deg; lean <= kMaxLean_deg; lean += kStep_deg) {
      const std::vector<double> sums = sums_along(steps, std::tan(lean * kDegree), sign);
      for (std::size_t y = 0; y < sums.size(); ++y) {
        if (sums[y] > best[y].sum) best[y] = {sums[y], lean, sign, static_cast<int>(y)};
      }
    }
    found.insert(found.end(), best.begin(), best.end());
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Found& a, const Found& b) { return a.sum > b.sum; });
  std::vector<PlateEdge> edges;
  std::vector<Found> taken;
  for (const Found& one : found) {
    if (taken.size() == kMax || one.sum <= 0) break;
    const bool is_taken = std::any_of(taken.begin(), taken.end(), [&](const Found& other) {
      return other.sign == one.sign && std::abs(other.row - one.row) < kApart_px;
    });
    if (is_taken) continue;
    taken.push_back(one);
    PlateEdge edge{.line = {.roll_rad = one.lean_deg * kDegree},
                   .step = one.sign,
                   .from = 0,
                   .to = steps.cols - 1};
    edge.line.offset_px = edge.line.normal().dot(cv::Point2d(.5 * steps.cols, one.row));
    // Its ends are determined on the line itself, whose slope may differ by half a step or more.
    const double length = edge.to - edge.from;
    if (const auto seen = find_edge(grey, edge, edge.line)) edge.line = seen->line;
    edge.to = edge.from;
    find_ends(steps, edge);
    if (edge.to - edge.from > kMinLength * length) edges.push_back(edge);
  }
  return edges;
}

std::optional<SeenEdge> find_edge(const cv::Mat& grey, const PlateEdge& edge,
                                  const EdgeLine& expected) {
  constexpr int kFewest = 24;
  constexpr double kMinPart = .3;
  SeenEdge seen{.line = expected};
  // Repeated from where it was found, with the normals of the line found.
  for (int round = 0; round < 2; ++round) {
    const Offsets offsets = offsets_from(grey, edge, seen.line);
    if (offsets.looked < kFewest) return std::nullopt;
    const OffsetLine line = line_through(offsets);
    seen.seen_part = line.on / static_cast<double>(offsets.looked);
    if (seen.seen_part < kMinPart) return std::nullopt;
    const double middle = .5 * (edge.from + edge.to);
    const cv::Point2d on =
        cv::Point2d(middle, seen.line.row_at(middle)) + line.offset * seen.line.normal();
    seen.line.roll_rad += std::atan(line.slope);
    seen.line.offset_px = seen.line.normal().dot(on);
  }
  return seen;
}

namespace {

constexpr double kMinPlateTurn_rad = .3 * kDegree;

/// An edge being followed.
struct FollowedEdge {
  PlateEdge edge;
  std::vector<PlateSighting> seen = {};
  double parts = 0;  ///< sum of the visible fractions
  bool is_lost = false;
};

cv::Mat moves_in(const std::vector<cv::Mat>& samples, int reduction) {
  constexpr double kMoves = 12;
  cv::Mat moves;
  const cv::Mat first = reduced_frame(samples.front(), reduction);
  for (const cv::Mat& sample : samples) {
    cv::Mat differs, grey;
    cv::absdiff(reduced_frame(sample, reduction), first, differs);
    cv::cvtColor(differs, grey, cv::COLOR_BGR2GRAY);
    moves = moves.empty() ? cv::Mat(grey > kMoves) : cv::Mat(moves | (grey > kMoves));
  }
  return moves;
}

/// The edge's expected position if it continues to turn as before.
EdgeLine expected_line(const FollowedEdge& followed, double time_s) {
  if (followed.seen.empty()) return followed.edge.line;
  const PlateSighting& last = followed.seen.back();
  if (followed.seen.size() < 3) return last.line;
  const PlateSighting& before = followed.seen[followed.seen.size() - 3];
  const double ahead = (time_s - last.time_s) / (last.time_s - before.time_s);
  const double middle = .5 * (followed.edge.from + followed.edge.to);
  EdgeLine line{.roll_rad =
                    last.line.roll_rad + ahead * (last.line.roll_rad - before.line.roll_rad)};
  const double row = last.line.row_at(middle);
  line.offset_px =
      line.normal().dot(cv::Point2d(middle, row + ahead * (row - before.line.row_at(middle))));
  return line;
}

void follow(FollowedEdge& followed, const cv::Mat& grey, int frame, double time_s) {
  constexpr double kPatience_s = .4;
  if (followed.is_lost) return;
  const auto found = find_edge(grey, followed.edge, expected_line(followed, time_s));
  if (found) {
    followed.seen.push_back({frame, time_s, found->line});
    followed.parts += found->seen_part;
    return;
  }
  const double last_s = followed.seen.empty() ? 0 : followed.seen.back().time_s;
  followed.is_lost = time_s - last_s > kPatience_s;
}

/// Its slope before it turns, how long it keeps that, and the scatter of single frames.
void read_rest(PlateMotion& motion) {
  constexpr double kMinNoise_rad = 1e-5;
  constexpr double kStill_rad = .06 * kDegree, kSigmas = 5;
  constexpr std::size_t kFirst = 5;
  std::vector<double> first, steps;
  for (const PlateSighting& one : motion.seen) {
    if (first.size() < kFirst) first.push_back(one.line.roll_rad);
  }
  for (std::size_t k = 2; k < motion.seen.size(); ++k) {
    steps.push_back(std::abs(motion.seen[k].line.roll_rad - 2 * motion.seen[k - 1].line.roll_rad +
                             motion.seen[k - 2].line.roll_rad));
  }
  motion.noise_rad = std::max(kMinNoise_rad, kMadToSigma * median(steps) / std::sqrt(6));
  const double begin = median(first);
  std::vector<double> leans;
  for (const PlateSighting& one : motion.seen) {
    if (std::abs(one.line.roll_rad - begin) > std::max(kStill_rad, kSigmas * motion.noise_rad))
      break;
    leans.push_back(one.line.roll_rad);
    motion.rest_s = one.time_s - motion.seen.front().time_s;
  }
  motion.level_rad = leans.empty() ? begin : median(leans);
}

void read_turn(PlateMotion& motion) {
  double farthest = 0;
  for (const PlateSighting& one : motion.seen) {
    const double turned = one.line.roll_rad - motion.level_rad;
    if (std::abs(turned) > std::abs(farthest)) farthest = turned;
  }
  motion.sense = farthest < 0 ? -1 : 1;
  motion.turned_rad = std::abs(farthest);
}

/// For a line that turns about a point H at a distance h from it, the offset is n . H + h, with the
/// normal n: least squares for H and h. Tested by track_accuracy of tests/bench, which draws plates
/// with hinges inside and outside the picture.
void find_hinge(PlateMotion& motion) {
  // Counted from a point of the edge, so that the errors of slope and offset are independent.
  const double middle = .5 * (motion.edge.from + motion.edge.to);
  const cv::Point2d base(middle, motion.seen.front().line.row_at(middle));
  cv::Matx33d normal = cv::Matx33d::zeros();
  cv::Vec3d right(0, 0, 0);
  const auto terms_of = [](const PlateSighting& one) {
    const cv::Point2d n = one.line.normal();
    return cv::Vec3d(n.x, n.y, 1);
  };
  const auto offset_of = [&](const PlateSighting& one) {
    return one.line.offset_px - one.line.normal().dot(base);
  };
  for (const PlateSighting& one : motion.seen) {
    const cv::Vec3d terms = terms_of(one);
    normal += terms * terms.t();
    right += offset_of(one) * terms;
  }
  constexpr double kLeast = 1e-9;  // a plate that hardly turns leaves its hinge undetermined
  for (int k = 0; k < 3; ++k) normal(k, k) += kLeast * static_cast<double>(motion.seen.size());
  const cv::Vec3d solution = normal.solve(right, cv::DECOMP_CHOLESKY);
  motion.hinge = base + cv::Point2d(solution[0], solution[1]);
  motion.above_px = solution[2];
  double squares = 0;
  for (const PlateSighting& one : motion.seen) {
    const double off = offset_of(one) - terms_of(one).dot(solution);
    squares += off * off / static_cast<double>(motion.seen.size());
  }
  motion.wobble_px = std::sqrt(squares);
}

/// Once the plate has begun to turn, its line must lie where a line that turns about the hinge lay
/// at rest. If it jumps, it was partly another line: a table's edge behind the plate, which then
/// comes clear of it. A line that is displaced over part of its length is tilted by the jump over
/// that length.
void find_level_error(PlateMotion& motion) {
  constexpr double kFrom_rad = .5 * kDegree, kTo_rad = 2.5 * kDegree, kPart = .2;
  double rest = 0, turning = 0, at_rest = 0, in_turn = 0;
  const double rests_until_s = motion.seen.front().time_s + motion.rest_s;
  for (const PlateSighting& one : motion.seen) {
    const double off_px =
        one.line.offset_px - one.line.normal().dot(motion.hinge) - motion.above_px;
    const double turned_rad = motion.turned_at(one);
    if (one.time_s <= rests_until_s) rest += (off_px - rest) / ++at_rest;
    if (turned_rad > kFrom_rad && turned_rad < kTo_rad) turning += (off_px - turning) / ++in_turn;
  }
  if (at_rest == 0 || in_turn == 0) return;
  motion.level_error_rad = std::abs(turning - rest) / (kPart * (motion.edge.to - motion.edge.from));
}

std::optional<PlateMotion> motion_of(FollowedEdge& followed, int reduction) {
  constexpr std::size_t kFewest = 8;
  if (followed.seen.size() < kFewest) return std::nullopt;
  PlateMotion motion{
      .reduction = reduction, .edge = followed.edge, .seen = std::move(followed.seen)};
  motion.seen_part = followed.parts / static_cast<double>(motion.seen.size());
  read_rest(motion);
  read_turn(motion);
  if (motion.turned_rad < kMinPlateTurn_rad) return std::nullopt;
  find_hinge(motion);
  find_level_error(motion);
  return motion;
}

/// How likely an edge is to be a plate's.
double weight_of(const PlateMotion& motion) {
  constexpr double kEnough_rad = 8 * kDegree;
  return (motion.edge.to - motion.edge.from) * motion.seen_part *
         std::min(1.0, motion.turned_rad / kEnough_rad) * static_cast<double>(motion.seen.size()) /
         (1 + motion.wobble_px);
}

std::optional<PlateMotion> plate_among(std::vector<PlateMotion> motions) {
  if (motions.empty()) return std::nullopt;
  const auto best =
      std::max_element(motions.begin(), motions.end(),
                       [](const auto& a, const auto& b) { return weight_of(a) < weight_of(b); });
  // The same line may have been found twice, the second time only in part.
  constexpr double kAlike = .1, kMinWeight = .45, kSame_px = 1;
  const auto row = [column = .5 * (best->edge.from + best->edge.to)](const PlateMotion& motion) {
    return motion.seen.front().line.row_at(column);
  };
  const PlateMotion* upper = &*best;
  for (const PlateMotion& one : motions) {
    const bool turns_along =
        one.sense == best->sense &&
        std::abs(one.turned_rad - best->turned_rad) < kAlike * best->turned_rad;
    if (!turns_along || weight_of(one) < kMinWeight * weight_of(*best)) continue;
    if (row(one) < row(*upper) - kSame_px) upper = &one;
  }
  return *upper;
}

}  // namespace

std::optional<PlateMotion> plate_in_film(const FilmFile& file, const FilmSurvey& survey,
                                         const FilmProgress& progress) {
  const int reduction = reduction_for(survey.size);
  const cv::Mat moves = moves_in(survey.samples, reduction);
  FilmReader film(file, survey.times_s);
  FilmFrame frame;
  std::vector<FollowedEdge> all;
  const std::size_t count = survey.times_s.size();
  for (std::size_t number = 0; number < count && film.next(frame); ++number) {
    const cv::Mat grey = edge_picture(reduced_frame(frame.bgr, reduction));
    if (number == 0) {
      for (const PlateEdge& edge : level_edges(grey, moves)) all.push_back({.edge = edge});
      if (all.empty()) break;
    }
    for (FollowedEdge& one : all) follow(one, grey, static_cast<int>(number), frame.time_s);
    if (progress) progress(static_cast<double>(number + 1) / static_cast<double>(count));
  }
  std::vector<PlateMotion> motions;
  for (FollowedEdge& one : all) {
    if (auto motion = motion_of(one, reduction)) motions.push_back(std::move(*motion));
  }
  return plate_among(std::move(motions));
}

namespace {

/// Distance of the strip's last row above the edge, so that none of the plate is mixed in.
constexpr double kAbove_px = 1.5;

}  // namespace

double along_plate(const PlateMotion& motion, int column) {
  const EdgeLine& line = motion.seen.front().line;
  return (cv::Point2d(column, line.row_at(column)) - motion.origin(line)).dot(line.along());
}

PlateStrip strip_above(const PlateMotion& motion, const cv::Size& frame) {
  constexpr double kHeight = .3;
  // Something may hide the end of the edge that the grain stands on.
  constexpr double kBeyond = .08;
  const int beyond = cvRound(kBeyond * frame.width);
  const double from = along_plate(motion, std::max(0, motion.edge.from - beyond));
  const double to = along_plate(motion, std::min(frame.width - 1, motion.edge.to + beyond));
  return {.from_px = from,
          .size = {std::max(1, cvFloor(to - from)), cvRound(kHeight * frame.height)}};
}

cv::Point2d in_frame(const cv::Point2d& place, const PlateMotion& motion, const EdgeLine& line,
                     const PlateStrip& strip) {
  return motion.origin(line) + (strip.from_px + place.x) * line.along() -
         (kAbove_px + strip.size.height - 1 - place.y) * line.normal();
}

cv::Mat strip_picture(const cv::Mat& frame, const PlateMotion& motion, const EdgeLine& line,
                      const PlateStrip& strip) {
  const cv::Point2d corner = in_frame({0, 0}, motion, line, strip);
  const cv::Point2d along = line.along(), down = line.normal();
  const cv::Matx23d turn(along.x, down.x, corner.x, along.y, down.y, corner.y);
  cv::Mat picture;
  cv::warpAffine(frame, picture, turn, strip.size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
  return picture;
}

}  // namespace repose::vision
