#include "vision/track/film_grains.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "vision/film/film_reader.h"

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
  PathFinder paths(grains.survey.interval_s);
  const std::size_t count = grains.survey.times_s.size();
  for (FilmFrame frame; grains.shifts.size() < count && film.next(frame);) {
    const auto number = static_cast<int>(grains.shifts.size());
    const Look look = finder.look(frame.bgr);
    paths.add(number, frame.time_s, look.blobs);
    grains.shifts.push_back(look.shift);
    report(static_cast<double>(number + 1) / static_cast<double>(count));
  }
  grains.paths = std::move(paths).paths();
  grains.scene = finder.scene();
  take_out_shifts(grains);
  return grains;
}

}  // namespace repose::vision
