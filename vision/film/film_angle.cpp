#include "vision/film/film_angle.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <utility>

#include "base/input_error.h"
#include "vision/film/film_reader.h"
#include "vision/film/resting_picture.h"
#include "vision/picture/opencv.h"

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

namespace {

/// Whether some multiple of the step is nearest to this frame; of two equally near, the earlier.
bool is_nearest_to_one(const std::vector<double>& times_s, std::size_t frame, double step_s) {
  if (frame == 0) return true;
  constexpr double kRounding_s = 1e-9;
  const double from_s = (times_s[frame - 1] + times_s[frame]) / 2 + kRounding_s;
  const bool is_last = frame + 1 == times_s.size();
  const double to_s =
      (is_last ? times_s[frame] : (times_s[frame] + times_s[frame + 1]) / 2) + kRounding_s;
  return step_s <= to_s - from_s || std::floor(to_s / step_s) * step_s > from_s;
}

}  // namespace

class FrameSeries::Decoder {
 public:
  explicit Decoder(const FilmFile& file) : film_(file) {}

  /// The frame with this number, which must not have been passed yet.
  std::optional<Picture> decode(std::size_t number) {
    for (; next_ < number; ++next_) {
      if (!film_.skip(frame_)) return std::nullopt;
    }
    if (!film_.next(frame_)) return std::nullopt;
    ++next_;
    Picture picture = blank_picture(frame_.bgr.cols, frame_.bgr.rows);
    frame_.bgr.copyTo(mat_of(picture));
    return picture;
  }

 private:
  FilmReader film_;
  FilmFrame frame_;
  std::size_t next_ = 0;
};

FrameSeries::FrameSeries(const FilmFile& file, const std::vector<double>& times_s, double step_s)
    : decoder_(std::make_unique<Decoder>(file)) {
  for (std::size_t k = 0; k < times_s.size(); ++k) {
    if (!is_nearest_to_one(times_s, k, step_s)) continue;
    taken_.push_back(k);
    taken_s_.push_back(times_s[k]);
  }
}

FrameSeries::~FrameSeries() = default;

std::optional<TimedPicture> FrameSeries::next() {
  if (done_ == taken_.size()) return std::nullopt;
  auto picture = decoder_->decode(taken_[done_]);
  if (!picture) return std::nullopt;
  return TimedPicture{.time_s = taken_s_[done_++], .picture = std::move(*picture)};
}

}  // namespace repose::vision
