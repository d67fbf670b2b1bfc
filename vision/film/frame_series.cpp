#include "vision/film/frame_series.h"

#include <cmath>
#include <utility>

#include "vision/film/film_reader.h"
#include "vision/picture/mat_of_picture.h"

namespace repose::vision {
namespace {

/// Whether a multiple of the step is nearest to this frame, the earlier of two as near.
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

  /// The frame of this number, which is none that was passed.
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
