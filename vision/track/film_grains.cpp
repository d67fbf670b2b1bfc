#include "vision/track/film_grains.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "vision/film/film_reader.h"
#include "vision/film/frame_times.h"

namespace repose::vision {
namespace {

/// The scene's own movement is taken out of the grain's where it stands out.
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

/// Between frames that are no repeats, in the median.
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

/// Which frames are repeats, and when the others may have been taken if not at their time stamps.
void find_times(const RepeatFinder& finder, FilmGrains& grains) {
  // Of a step, that stamps are off: rounded ones less, those of an unsteady camera more than which.
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

}  // namespace repose::vision
