#include "vision/track/plate_motion.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "base/units.h"
#include "vision/film/film_reader.h"
#include "vision/measure/line_fit.h"
#include "vision/track/blobs.h"

namespace repose::vision {
namespace {

constexpr double kLeastPlateTurn_rad = .3 * kDegree;

/// An edge that is followed.
struct FollowedEdge {
  PlateEdge edge;
  std::vector<PlateSighting> seen = {};
  double parts = 0;  ///< sum of the parts seen
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

/// Where the edge will be when it turns on as it did.
EdgeLine expected_line(const FollowedEdge& followed, double time_s) {
  if (followed.seen.empty()) return followed.edge.line;
  const PlateSighting& last = followed.seen.back();
  if (followed.seen.size() < 3) return last.line;
  const PlateSighting& before = followed.seen[followed.seen.size() - 3];
  const double ahead = (time_s - last.time_s) / (last.time_s - before.time_s);
  const double middle = .5 * (followed.edge.from + followed.edge.to);
  EdgeLine line{.lean_rad =
                    last.line.lean_rad + ahead * (last.line.lean_rad - before.line.lean_rad)};
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

/// Its lean before it turns, how long it has that, and how much single frames scatter.
void read_rest(PlateMotion& motion) {
  constexpr double kLeastNoise_rad = 1e-5;
  constexpr double kStill_rad = .06 * kDegree, kSigmas = 5;
  constexpr std::size_t kFirst = 5;
  std::vector<double> first, steps;
  for (const PlateSighting& one : motion.seen) {
    if (first.size() < kFirst) first.push_back(one.line.lean_rad);
  }
  for (std::size_t k = 2; k < motion.seen.size(); ++k) {
    steps.push_back(std::abs(motion.seen[k].line.lean_rad - 2 * motion.seen[k - 1].line.lean_rad +
                             motion.seen[k - 2].line.lean_rad));
  }
  motion.noise_rad = std::max(kLeastNoise_rad, kMadToSigma * median(steps) / std::sqrt(6));
  const double begin = median(first);
  std::vector<double> leans;
  for (const PlateSighting& one : motion.seen) {
    if (std::abs(one.line.lean_rad - begin) > std::max(kStill_rad, kSigmas * motion.noise_rad))
      break;
    leans.push_back(one.line.lean_rad);
    motion.rest_s = one.time_s - motion.seen.front().time_s;
  }
  motion.level_rad = leans.empty() ? begin : median(leans);
}

void read_turn(PlateMotion& motion) {
  double farthest = 0;
  for (const PlateSighting& one : motion.seen) {
    const double turned = one.line.lean_rad - motion.level_rad;
    if (std::abs(turned) > std::abs(farthest)) farthest = turned;
  }
  motion.sense = farthest < 0 ? -1 : 1;
  motion.turned_rad = std::abs(farthest);
}

/// Of a line that turns about a point H at a distance h from it, the offset is n . H + h, with the
/// normal n: least squares for H and h. Tested by track_accuracy of tests/bench, which draws plates
/// with hinges in and out of the picture.
void find_hinge(PlateMotion& motion) {
  // Counted from a point of the edge, so that lean and offset err independently of each other.
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
  constexpr double kLeast = 1e-9;  // a plate that hardly turns leaves its hinge open
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

/// Once the plate has begun to turn, its line must lie where one that turns about the hinge lay at
/// rest. Where it jumps, it was another one in part: a table's edge behind the plate, of which it
/// gets clear. A line that leaves its place over some part of its length leans by the jump over
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
  if (motion.turned_rad < kLeastPlateTurn_rad) return std::nullopt;
  find_hinge(motion);
  find_level_error(motion);
  return motion;
}

/// How sure an edge is that of a plate.
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
  // The same line may have been found twice, a second time with a part of its length.
  constexpr double kAlike = .1, kLeastWeight = .45, kSame_px = 1;
  const auto row = [column = .5 * (best->edge.from + best->edge.to)](const PlateMotion& motion) {
    return motion.seen.front().line.row_at(column);
  };
  const PlateMotion* upper = &*best;
  for (const PlateMotion& one : motions) {
    const bool turns_along =
        one.sense == best->sense &&
        std::abs(one.turned_rad - best->turned_rad) < kAlike * best->turned_rad;
    if (!turns_along || weight_of(one) < kLeastWeight * weight_of(*best)) continue;
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

}  // namespace repose::vision
