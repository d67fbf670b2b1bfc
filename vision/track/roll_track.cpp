#include "vision/track/roll_track.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "base/distributions.h"
#include "base/units.h"
#include "vision/track/film_grains.h"
#include "vision/track/film_scale.h"

namespace repose::vision {

namespace {

/// A straight line by least squares of the perpendicular distances.
struct PathLine {
  cv::Point2d middle;
  cv::Point2d along;           ///< unit vector in the direction of motion
  double offset_error_px = 0;  ///< standard error across the line, at its middle
  double angle_error_rad = 0;
};

/// Two successive straight lines: down an incline, out on a flat.
struct BentPath {
  PathLine incline;
  PathLine flat;
  double rms_px = 0;           ///< of the places about their lines
  double left_out = 0;         ///< fraction of the places on neither line, as where a grain hops
  double bend_rad = 0;         ///< between the lines, above 0
  double bend_error_rad = 0;   ///< standard error
  cv::Point2d corner;          ///< where the lines meet
  double corner_error_px = 0;  ///< standard error along the flat
};

constexpr std::size_t kFewestInLine = 5;

/// Errors of neighbouring places are correlated: this many count as one.
constexpr double kPlacesAlike = 3;

/// Running sums over places.
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
  /// Sum of the squared positions along the line.
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

/// Sums over the places on one line, excluding outliers, as where a grain hops at the bend: starts
/// with the `sure` ones, which are farthest from the bend.
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

/// Standard error across the line, at a place on it.
double error_at(const PathLine& line, const cv::Point2d& p) {
  return std::hypot(line.offset_error_px, line.angle_error_rad * (p - line.middle).dot(line.along));
}

/// Index of the first place on the second line.
std::size_t bend_of(const std::vector<cv::Point2d>& path) {
  const std::vector<double> before = deviations(path);
  const std::vector<double> after = deviations({path.rbegin(), path.rend()});
  std::size_t bend = kFewestInLine;
  for (std::size_t k = kFewestInLine; k + kFewestInLine <= path.size(); ++k) {
    if (before[k] + after[path.size() - k] < before[bend] + after[path.size() - bend]) bend = k;
  }
  return bend;
}

/// The two best-fitting lines; std::nullopt if there are too few places on one of them, or both
/// have the same direction.
/// @param path  in order, without places at rest
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
  constexpr double kMinSine = 1e-3;
  if (sine < kMinSine) return std::nullopt;
  found.bend_rad = std::atan2(sine, a.along.dot(b.along));
  found.bend_error_rad = std::hypot(a.angle_error_rad, b.angle_error_rad);
  found.corner =
      b.middle + b.along * ((a.middle - b.middle).cross(a.along) / b.along.cross(a.along));
  found.corner_error_px =
      std::hypot(error_at(a, found.corner), error_at(b, found.corner) * std::cos(found.bend_rad)) /
      sine;
  return found;
}

constexpr double kRollStill_s = .3;
/// Bends outside these limits are not a foot.
constexpr double kGentlest_rad = 3 * kDegree, kSteepestRoll_rad = 70 * kDegree;
constexpr double kLevel_rad = 12 * kDegree;
constexpr double kRollLean_rad = 2 * kDegree;

/// A grain's path with the two lines followed by its upper edge.
struct Roll {
  const GrainPath* path = nullptr;
  BentPath bent;
};

/// The grain at rest, at the beginning or the end.
struct Rest {
  cv::Point2d crest;
  double lasts_s = 0;
  double begins_s = 0;
  bool touches_edge = false;
};

/// The top of the grain, which a shadow beneath does not shift.
cv::Point2d crest_of(const Blob& blob) { return {blob.centre.x, blob.crest_px}; }

std::vector<cv::Point2d> moving_places(const GrainPath& path) {
  constexpr double kStep_px = 1;  // places closer to each other count once
  std::vector<cv::Point2d> places;
  for (const Sighting& one : path) {
    if (one.blob.touches_edge) continue;
    if (!places.empty() && cv::norm(crest_of(one.blob) - places.back()) < kStep_px) continue;
    places.push_back(crest_of(one.blob));
  }
  return places;
}

double width_px(const GrainPath& path) {
  std::vector<double> areas;
  for (const Sighting& one : path) areas.push_back(one.blob.area_px);
  const auto middle = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2);
  std::nth_element(areas.begin(), middle, areas.end());
  return 2 * std::sqrt(*middle / CV_PI);
}

/// Slope of a direction, from the horizontal.
double slope_rad(const cv::Point2d& along) { return std::atan2(along.y, std::abs(along.x)); }

/// Whether the path runs down one line and on along another, nearly level one.
bool is_roll(const BentPath& bent, double width_px) {
  constexpr double kStraight = .15;  // of the grain's width
  constexpr double kMaxLeftOut = .3;
  return bent.bend_rad > kGentlest_rad && bent.bend_rad < kSteepestRoll_rad &&
         slope_rad(bent.incline.along) > slope_rad(bent.flat.along) &&
         std::abs(slope_rad(bent.flat.along)) < kLevel_rad &&
         bent.incline.along.x * bent.flat.along.x > 0 && bent.left_out < kMaxLeftOut &&
         bent.rms_px < std::max(1.0, kStraight * width_px);
}

double contrast_of(const GrainPath& path) { return path[path.size() / 2].blob.contrast; }

std::optional<Roll> roll_in(const FilmGrains& film) {
  std::optional<Roll> best;
  double clearest = 0;
  for (const GrainPath& path : film.paths) {
    const auto bent = bent_path_through(moving_places(path));
    if (!bent || !is_roll(*bent, width_px(path))) continue;
    // A shadow rolls along, but is less clearly visible.
    const double clear = way_px(path) * contrast_of(path);
    if (clear <= clearest) continue;
    clearest = clear;
    best = Roll{&path, *bent};
  }
  return best;
}

/// The rest at the beginning of a path, or at its end with reversed iterators.
template <typename Sightings>
Rest rest_at(const Sightings& begin, const Sightings& end) {
  constexpr double kStill_px = 1;  // a grain at rest moves less
  Rest rest{.crest = {}, .begins_s = begin->time_s};
  double count = 0;
  for (auto one = begin; one != end; ++one) {
    if (cv::norm(crest_of(one->blob) - crest_of(begin->blob)) > kStill_px) break;
    rest.crest += (crest_of(one->blob) - rest.crest) / ++count;
    rest.lasts_s = std::abs(one->time_s - begin->time_s);
    rest.begins_s = one->time_s;
    rest.touches_edge = rest.touches_edge || one->blob.touches_edge;
  }
  return rest;
}

Rest first_rest(const GrainPath& path) { return rest_at(path.begin(), path.end()); }
Rest last_rest(const GrainPath& path) { return rest_at(path.rbegin(), path.rend()); }

/// Why the rest position is unknown; empty if it is known.
std::string fault_of_end(const GrainPath& path, const Rest& rest, const FilmGrains& film) {
  const Blob& last = path.back().blob;
  if (last.touches_edge || rest.touches_edge) {
    return "the grain rolls to the edge of the picture. Rule: it comes to rest within it. Fix: "
           "show all of the flat, or let go of the grain lower on the incline.";
  }
  if (rest.lasts_s >= kRollStill_s) return {};
  constexpr int kFrames = 3;
  if (path.back().frame + kFrames < static_cast<int>(film.survey.times_s.size())) {
    return fmt::format(
        "the grain is lost at {:.0f}, {:.0f} before it lies still. Rule: in sight until it has "
        "been at rest for {:g} s. Fix: show all of the flat before a backdrop of another colour, "
        "with nothing in front of the grain.",
        last.centre.x, last.centre.y, kRollStill_s);
  }
  return fmt::format(
      "the grain still moves when the film ends. Rule: at rest for {:g} s. Fix: film on until it "
      "lies still.",
      kRollStill_s);
}

/// Distances from the foot, in pixels, with standard errors.
struct PathLengths {
  double stopped_px = 0;
  double released_px = 0;
  double foot_error_px = 0;  ///< of both: it makes one shorter and the other longer
  double end_error_px = 0;   ///< of each, independently
};

/// With a scale in the picture.
void measure_by(const Estimate& scale, const PathLengths& ways, RollTrack& track) {
  const double error_px = base::kNormal95 * std::hypot(ways.foot_error_px, ways.end_error_px);
  const auto length_mm = [&](double px) {
    return Estimate{px * scale.value, std::hypot(error_px * scale.value, px * scale.uncertainty)};
  };
  track.has_scale = true;
  track.mm_per_px = scale.value;
  track.stopped_mm = length_mm(ways.stopped_px);
  track.released_mm = length_mm(ways.released_px);
}

/// With the known distance up the incline.
void measure_by(double released_mm, const PathLengths& ways, RollTrack& track) {
  track.mm_per_px = released_mm / ways.released_px;
  const double value = ways.stopped_px * track.mm_per_px;
  const double per_stopped = 1 / std::abs(ways.stopped_px), per_released = 1 / ways.released_px;
  const double error = std::hypot(ways.foot_error_px * (per_stopped + per_released),
                                  ways.end_error_px * std::hypot(per_stopped, per_released));
  track.stopped_mm = {value, base::kNormal95 * std::abs(value) * error};
  track.released_mm = {released_mm, 0};
}

Point point_of(const cv::Point2d& p) { return {p.x, p.y}; }

void read_roll(const Roll& roll, const FilmScale& scale, const TrackOptions& options,
               RollTrack& track) {
  const BentPath& bent = roll.bent;
  const Rest first = first_rest(*roll.path), last = last_rest(*roll.path);
  // The planes lie half a width below the lines of the centre, so the foot is before the path's
  // corner. The height at which a non-spherical grain rolls is unknown.
  constexpr double kShape = .15, kEnd_px = .3;
  const double radius = .5 * track.grain_px;
  const double before = radius * std::tan(.5 * bent.bend_rad);
  const PathLengths ways{
      .stopped_px = (last.crest - bent.corner).dot(bent.flat.along) + before,
      .released_px = (bent.corner - first.crest).dot(bent.incline.along) + before,
      .foot_error_px = std::hypot(bent.corner_error_px, kShape * before),
      .end_error_px = kEnd_px};
  if (scale.exists()) {
    const cv::Point2d middle = .5 * (bent.corner + last.crest);
    measure_by(scale.mm_per_px(middle, bent.flat.along), ways, track);
    track.board = scale.board();
  } else {
    measure_by(options.released_mm.value(), ways, track);
  }
  track.incline_deg = {bent.bend_rad / kDegree, base::kNormal95 * bent.bend_error_rad / kDegree};
  track.stopped_s = last.begins_s;
  track.noise_px = bent.rms_px;
  cv::Point2d down(-bent.flat.along.y, bent.flat.along.x);
  if (down.y < 0) down = -down;
  const cv::Point2d to_centre = radius * down;
  track.foot = point_of(bent.corner - before * bent.flat.along + 2 * to_centre);
  track.corner = point_of(bent.corner + to_centre);
  track.released = point_of(first.crest + to_centre);
  track.stopped = point_of(last.crest + to_centre);
  track.has_reading = true;
}

/// Number of frames in which both are visible, well apart.
int frames_apart(const GrainPath& path, const GrainPath& other, double least_px) {
  int frames = 0;
  auto one = path.begin();
  for (const Sighting& seen : other) {
    while (one != path.end() && one->frame < seen.frame) ++one;
    if (one == path.end()) break;
    const bool is_apart = cv::norm(one->blob.centre - seen.blob.centre) > least_px;
    frames += one->frame == seen.frame && is_apart ? 1 : 0;
  }
  return frames;
}

/// Whether something else of similar size moves at the same time, as clearly visible: a shadow is
/// less clear, a hand larger.
bool has_another(const FilmGrains& film, const GrainPath& path) {
  constexpr double kAbout = .6, kWidths = 2;
  constexpr int kFrames = 5;
  const double width = width_px(path);
  return std::any_of(film.paths.begin(), film.paths.end(), [&](const GrainPath& other) {
    const double like = width_px(other) / width;
    return &other != &path && like > kAbout && like < 1 / kAbout &&
           contrast_of(other) > kAbout * contrast_of(path) && way_px(other) > kWidths * width &&
           frames_apart(path, other, kWidths * width) >= kFrames;
  });
}

/// Evaluates the roll, or returns why it cannot.
std::string read(const FilmGrains& film, const std::optional<Roll>& roll, const FilmScale& scale,
                 const TrackOptions& options, RollTrack& track) {
  const std::string fault = fault_of(film);
  if (!fault.empty()) return fault;
  if (!roll) {
    return fmt::format(
        "nothing is seen to roll down a straight incline and on along a level flat: there is no "
        "foot. Rule: a bend of {:.0f} to {:.0f} degrees with places on both sides of it. Fix: film "
        "level and from the side, with incline and flat in the picture, from before the grain is "
        "let go until it lies still.",
        kGentlest_rad / kDegree, kSteepestRoll_rad / kDegree);
  }
  if (has_another(film, *roll->path)) {
    return "several things move that may be grains. Rule: one grain in a film. Fix: film each roll "
           "by "
           "itself.";
  }
  if (scale.misses_board()) return kNoBoardSeen;
  track.grain_px = width_px(*roll->path);
  const Rest last = last_rest(*roll->path);
  const std::string end = fault_of_end(*roll->path, last, film);
  if (!end.empty()) return end;
  constexpr double kHeld_s = .1;
  if (!scale.exists() && first_rest(*roll->path).lasts_s < kHeld_s) {
    return "it is not seen where the grain was let go, from which the millimetres come. Rule: at "
           "rest and in sight before. Fix: film from before, hold the grain by a card or a thread "
           "and not within a hand, or give --scale.";
  }
  read_roll(*roll, scale, options, track);
  return {};
}

void warn_of_roll(const Roll& roll, RollTrack& track) {
  const double roll_rad = slope_rad(roll.bent.flat.along);
  if (std::abs(roll_rad) > kRollLean_rad) {
    track.warnings.push_back(
        {"leaning", fmt::format("the flat leans by {:.1f} degrees in the picture, and was "
                                "followed: level the camera; the flat counts as level",
                                std::abs(roll_rad) / kDegree)});
  }
  constexpr double kFewHops = .05;
  if (roll.bent.left_out > kFewHops) {
    track.warnings.push_back(
        {"hops", fmt::format("the grain leaves the straight lines in {:.0f} % of its way: it hops, "
                             "or incline and flat are not straight",
                             100 * roll.bent.left_out)});
  }
}

}  // namespace

RollTrack track_roll(const FilmFile& file, const TrackOptions& options) {
  const FilmGrains film = grains_in_film(file, options.progress);
  RollTrack track{.film = facts_of(film.survey)};
  const std::optional<Roll> roll = roll_in(film);
  const FilmScale scale(options, film.scene, file.lens);
  track.reason = read(film, roll, scale, options, track);
  if (roll) {
    for (const Sighting& one : *roll->path) {
      track.places.push_back({one.time_s, point_of(one.blob.centre)});
    }
  }
  if (track.reason.empty()) {
    const bool is_doubtful = warn_of_film(film, track.warnings);
    warn_of_roll(*roll, track);
    track.status = is_doubtful ? MeasureStatus::flagged : MeasureStatus::ok;
  }
  if (options.draws_strobe && !film.scene.empty()) {
    track.strobe = strobe_picture(file, film.scene, roll ? *roll->path : GrainPath{});
  }
  return track;
}

}  // namespace repose::vision
