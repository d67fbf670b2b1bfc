#include "vision/track/film_grains.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "vision/film/film_reader.h"
#include "vision/film/frame_times.h"
#include "vision/picture/opencv.h"

namespace repose::vision {

namespace {

constexpr double kNotYet = std::numeric_limits<double>::infinity();

double length(const cv::Point2d& v) { return std::hypot(v.x, v.y); }

/// Diameter of a disc of its area.
double width_px(const Blob& blob) { return 2 * std::sqrt(blob.area_px / CV_PI); }

}  // namespace

double PathFinder::cost(const GrainPath& path, double time_s, const Blob& blob) const {
  const Sighting& last = path.back();
  const double ratio = std::abs(std::log(blob.area_px / last.blob.area_px));
  const double colours = cv::norm(blob.colour - last.blob.colour);
  constexpr double kMaxRatio = 1.0, kMaxColours = 90;
  if (ratio > kMaxRatio || colours > kMaxColours) return kNotYet;
  const double waited_s = time_s - last.time_s;
  cv::Point2d moved(0, 0);
  if (path.size() > 1) {
    const Sighting& before = path[path.size() - 2];
    moved = (last.blob.centre - before.blob.centre) * (waited_s / (last.time_s - before.time_s));
  }
  const cv::Point2d gone = blob.centre - last.blob.centre;
  // Flown on, at rest, or bounced back.
  const double off = std::min({length(gone - moved), .5 * length(gone) + .25 * length(moved),
                               length(gone - cv::Point2d(moved.x, -.6 * moved.y))});
  const double reach = 2 * width_px(last.blob) + .5 * length(moved) + 8;
  if (off > reach) return kNotYet;
  return off / reach + ratio / kMaxRatio + colours / kMaxColours;
}

void PathFinder::note_gap(double time_s) {
  constexpr double kGap = 1.6;
  if (last_s_ && time_s - *last_s_ > kGap * interval_s_) {
    gaps_.push_back({*last_s_, time_s - *last_s_ - interval_s_});
  }
  last_s_ = time_s;
}

double PathFinder::unseen_s(double since_s) const {
  double unseen_s = 0;
  for (const Gap& gap : gaps_) unseen_s += gap.begins_s >= since_s ? gap.lasts_s : 0;
  return unseen_s;
}

void PathFinder::forget_lost(double time_s) {
  constexpr double kLongest_s = .07;
  constexpr double kFrames = 3.5;
  const double patience_s = std::max(kLongest_s, kFrames * interval_s_);
  const auto lost = std::stable_partition(open_.begin(), open_.end(), [&](const GrainPath& path) {
    return time_s - path.back().time_s - unseen_s(path.back().time_s) <= patience_s;
  });
  std::move(lost, open_.end(), std::back_inserter(closed_));
  open_.erase(lost, open_.end());
  // Flicker leaves many paths of a frame or two.
  std::erase_if(closed_, [](const GrainPath& path) { return path.size() < 4; });
}

void PathFinder::add(int frame, double time_s, const std::vector<Blob>& blobs) {
  note_gap(time_s);
  forget_lost(time_s);
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t path = 0; path < open_.size(); ++path) {
    for (std::size_t blob = 0; blob < blobs.size(); ++blob) {
      const double off = cost(open_[path], time_s, blobs[blob]);
      if (off < kNotYet) pairs.emplace_back(off, path, blob);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> has_path(open_.size()), is_taken(blobs.size());
  for (const auto& [off, path, blob] : pairs) {
    if (has_path[path] || is_taken[blob]) continue;
    has_path[path] = is_taken[blob] = true;
    open_[path].push_back({frame, time_s, blobs[blob]});
  }
  for (std::size_t blob = 0; blob < blobs.size(); ++blob) {
    if (!is_taken[blob]) open_.push_back({{frame, time_s, blobs[blob]}});
  }
}

std::vector<GrainPath> PathFinder::paths() && {
  forget_lost(kNotYet);
  std::vector<GrainPath> moved;
  for (GrainPath& path : closed_) {
    if (way_px(path) > std::max(4.0, .2 * width_px(path.front().blob)))
      moved.push_back(std::move(path));
  }
  std::stable_sort(moved.begin(), moved.end(),
                   [](const auto& a, const auto& b) { return way_px(a) > way_px(b); });
  return moved;
}

double way_px(const GrainPath& path) {
  constexpr double kStep_px = 2;
  double way = 0;
  cv::Point2d at = path.front().blob.centre;
  for (const Sighting& sighting : path) {
    const double step = length(sighting.blob.centre - at);
    if (step < kStep_px) continue;
    way += step;
    at = sighting.blob.centre;
  }
  return way;
}

namespace {

/// Removes the scene's own movement from the grain's, if it is significant.
void take_out_shifts(FilmGrains& grains) {
  constexpr double kStandsOut_px = .4;
  if (farthest_shift_px(grains) < kStandsOut_px) return;
  for (GrainPath& path : grains.paths) {
    for (Sighting& one : path) {
      const cv::Point2d& shift = grains.shifts[static_cast<std::size_t>(one.frame)];
      one.blob.centre -= shift;
      one.blob.crest_px -= shift.y;
    }
  }
}

/// Median interval between frames that are not repeats.
void read_interval(FilmGrains& grains) {
  std::vector<double> steps;
  std::optional<double> last_s;
  for (std::size_t k = 0; k < grains.survey.times_s.size(); ++k) {
    if (k < grains.repeated.is_repeat.size() && grains.repeated.is_repeat[k]) continue;
    const double time_s = grains.survey.times_s[k];
    if (last_s) steps.push_back(time_s - *last_s);
    last_s = time_s;
  }
  if (steps.empty()) return;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  grains.survey.interval_s = *middle;
}

std::vector<double> at_steps(const std::vector<double>& steps, double step_s) {
  std::vector<double> times_s;
  for (const double step : steps) times_s.push_back((step - steps.front()) * step_s);
  return times_s;
}

/// Finds repeated frames, and when the others may have been taken if not at their time stamps.
void find_times(const RepeatFinder& finder, FilmGrains& grains) {
  // Deviation of the stamps, as a fraction of a step: rounded stamps deviate less than the first,
  // those of an unsteady camera more than the second.
  constexpr double kEven = .02, kSteady = .25;
  const auto grid = grid_of(grains.survey.times_s);
  const bool is_steady = grid && grid->off < kSteady;
  grains.repeated = finder.repeats(is_steady ? std::optional(grid->steps) : std::nullopt);
  grains.repeated.is_repeat.resize(grains.survey.times_s.size());
  if (grains.repeated.taken_at) {
    grains.other_times_s.push_back(at_steps(*grains.repeated.taken_at, grid->step_s));
  }
  if (is_steady && grid->off > kEven) {
    grains.other_times_s.push_back(at_steps(grid->steps, grid->step_s));
  }
  if (grains.repeated.count > 0) read_interval(grains);
}

}  // namespace

double farthest_shift_px(const FilmGrains& film) {
  double moved_px = 0;
  for (const cv::Point2d& shift : film.shifts) {
    moved_px = std::max(moved_px, std::hypot(shift.x, shift.y));
  }
  return moved_px;
}

FilmGrains grains_in_film(const FilmFile& file, const FilmProgress& progress) {
  constexpr double kSurveyPart = .4;
  const auto part = [&](double from, double length) -> FilmProgress {
    return [=, &progress](double done) {
      if (progress) progress(from + length * done);
    };
  };
  FilmGrains grains{.survey = survey_film(file, part(0, kSurveyPart))};
  if (grains.survey.cut || grains.survey.times_s.size() < kFewestFrames) return grains;
  const BlobFinder finder(background_of(std::exchange(grains.survey.samples, {})));
  const FilmProgress report = part(kSurveyPart, 1 - kSurveyPart);
  FilmReader film(file);
  RepeatFinder repeats;
  std::vector<std::vector<Blob>> seen;
  const std::size_t count = grains.survey.times_s.size();
  for (FilmFrame frame; seen.size() < count && film.next(frame);) {
    Look look = finder.look(frame.bgr);
    repeats.look(frame.bgr);
    seen.push_back(std::move(look.blobs));
    grains.shifts.push_back(look.shift);
    report(static_cast<double>(seen.size()) / static_cast<double>(count));
  }
  find_times(repeats, grains);
  PathFinder paths(grains.survey.interval_s);
  for (std::size_t number = 0; number < seen.size(); ++number) {
    if (grains.repeated.is_repeat[number]) continue;
    paths.add(static_cast<int>(number), grains.survey.times_s[number], seen[number]);
  }
  grains.paths = std::move(paths).paths();
  grains.scene = finder.scene();
  take_out_shifts(grains);
  return grains;
}

FilmGrains retimed(const FilmGrains& film, const std::vector<double>& times_s) {
  FilmGrains other = film;
  other.survey.times_s = times_s;
  for (GrainPath& path : other.paths) {
    for (Sighting& one : path) one.time_s = times_s[static_cast<std::size_t>(one.frame)];
  }
  read_interval(other);
  return other;
}

namespace {

/// Blobs to show, by frame number.
std::map<int, Blob> shown_blobs(const GrainPath& path) {
  std::map<int, Blob> shown;
  cv::Point2d last;
  for (const Sighting& sighting : path) {
    const cv::Point2d off = sighting.blob.centre - last;
    const double width = 2 * std::sqrt(sighting.blob.area_px / CV_PI);
    if (!shown.empty() && std::hypot(off.x, off.y) < .9 * width) continue;
    shown[sighting.frame] = sighting.blob;
    last = sighting.blob.centre;
  }
  return shown;
}

/// Draws the part of a frame that the grain covers.
void show(const cv::Mat& frame, const cv::Mat& scene, const Blob& blob, cv::Mat& strobe) {
  for (int row = blob.box.y; row < blob.box.y + blob.box.height; ++row) {
    for (int k = blob.box.x; k < blob.box.x + blob.box.width; ++k) {
      const auto& seen = frame.at<cv::Vec3b>(row, k);
      const double cover = cover_of(seen, scene.at<cv::Vec3b>(row, k), blob.colour);
      auto& drawn = strobe.at<cv::Vec3b>(row, k);
      drawn = cv::Vec3b(cover * cv::Vec3d(seen) + (1 - cover) * cv::Vec3d(drawn));
    }
  }
}

}  // namespace

Picture strobe_picture(const FilmFile& file, const cv::Mat& scene, const GrainPath& path) {
  Picture picture = blank_picture(scene.cols, scene.rows);
  cv::Mat strobe = mat_of(picture);
  scene.copyTo(strobe);
  const std::map<int, Blob> blobs = shown_blobs(path);
  FilmReader film(file);
  FilmFrame frame;
  const int last = blobs.empty() ? -1 : blobs.rbegin()->first;
  for (int number = 0; number <= last; ++number) {
    const auto blob = blobs.find(number);
    if (!(blob == blobs.end() ? film.skip(frame) : film.next(frame))) break;
    if (blob != blobs.end()) show(frame.bgr, scene, blob->second, strobe);
  }
  return picture;
}

}  // namespace repose::vision
