#include "vision/film/film_angle.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>

#include "base/input_error.h"
#include "vision/film/resting_picture.h"

namespace repose::vision {
namespace {

SizedHeap refusal(const MeasureOptions& options, std::string reason) {
  SizedHeap heap;
  heap.options = options;
  ReposeAngle& angle = heap.angle;
  angle.reason = std::move(reason);
  angle.window = {options.window_from, options.window_to};
  angle.method = options.method;
  angle.camera_pitch_rad = options.camera_pitch_rad;
  return heap;
}

}  // namespace

bool has_film_ending(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return std::find(kFilmEndings.begin(), kFilmEndings.end(), ending) != kFilmEndings.end();
}

FilmAngle measure_film(const FilmFile& file, const MeasureOptions& options,
                       const ScaleOptions& scale, const std::function<void(double)>& progress) {
  RestingPicture rest = resting_picture(file, options, progress);
  FilmAngle result{.heap = refusal(options, base::with_names(rest.reason, options.names)),
                   .picture = std::move(rest.picture),
                   .stretch = rest.stretch,
                   .film = rest.film,
                   .times_s = std::move(rest.times_s)};
  if (!result.stretch) return result;
  result.heap = measure_sized_heap(result.picture, options, scale);
  ReposeAngle& angle = result.heap.angle;
  std::vector<Warning>& warnings = angle.warnings;
  warnings.insert(warnings.end(), rest.warnings.begin(), rest.warnings.end());
  if (rest.is_doubtful && angle.status == MeasureStatus::ok) angle.status = MeasureStatus::flagged;
  return result;
}

}  // namespace repose::vision
