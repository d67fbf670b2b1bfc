#include "vision/film/film_survey.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "vision/film/film_reader.h"
#include "vision/film/frame_times.h"

namespace repose::vision {

namespace {

/// Detects interlaced films: every other row of a frame was taken half a frame later, so that
/// moving edges are combed. Counts alternating rows where something has moved since the previous
/// frame.
class CombFinder {
 public:
  /// Frames in order; some may be left out.
  void look(const cv::Mat& bgr);

  /// Whether enough of the frames with movement are combed.
  bool is_interlaced() const;

 private:
  cv::Mat before_;
  int combed_frames_ = 0;
  int moving_frames_ = 0;
};

constexpr int kMoved = 24;  ///< grey levels between two frames

constexpr int kRowStep = 14;  ///< between rows of a comb; noise alternates over fewer rows

/// Whether five rows, starting with this one, alternate up and down.
bool is_comb(const cv::Mat& grey, int row, int column) {
  int before = 0;
  for (int k = 0; k < 4; ++k) {
    const int step = grey.at<uchar>(row + k + 1, column) - grey.at<uchar>(row + k, column);
    if (std::abs(step) < kRowStep || step * before > 0) return false;
    before = step;
  }
  return true;
}

void CombFinder::look(const cv::Mat& bgr) {
  constexpr int kRows = 5, kFewestMoved_px = 60;
  constexpr double kCombedPart = .08;
  cv::Mat grey;
  cv::cvtColor(bgr, grey, cv::COLOR_BGR2GRAY);
  cv::swap(grey, before_);  // from here on `grey` is the previous frame
  if (grey.size() != before_.size()) return;
  int moved = 0, combed = 0;
  for (int row = 0; row + kRows <= before_.rows; ++row) {
    const uchar* now = before_.ptr<uchar>(row + kRows / 2);
    const uchar* then = grey.ptr<uchar>(row + kRows / 2);
    for (int column = 0; column < before_.cols; ++column) {
      if (std::abs(now[column] - then[column]) < kMoved) continue;
      ++moved;
      combed += is_comb(before_, row, column) ? 1 : 0;
    }
  }
  if (moved < kFewestMoved_px) return;
  ++moving_frames_;
  combed_frames_ += combed > kCombedPart * moved ? 1 : 0;
}

bool CombFinder::is_interlaced() const {
  constexpr int kFewest = 3;
  constexpr double kPart = .3;  // of the frames with movement; slow movement shows no comb
  return combed_frames_ >= kFewest && combed_frames_ >= kPart * moving_frames_;
}

/// Keeps every frame, then every second, every fourth ... so that the number stays within a limit.
class Samples {
 public:
  void add(const cv::Mat& frame) {
    if (most_ == 0) most_ = most_of(frame);
    if (seen_++ % stride_ != 0) return;
    if (kept_.size() == most_) {
      for (std::size_t k = 0; 2 * k < kept_.size(); ++k) std::swap(kept_[k], kept_[2 * k]);
      kept_.resize((kept_.size() + 1) / 2);
      stride_ *= 2;
      if ((seen_ - 1) % stride_ != 0) return;
    }
    kept_.push_back(frame.clone());
  }
  std::vector<cv::Mat> take() { return std::move(kept_); }

 private:
  static std::size_t most_of(const cv::Mat& frame) {
    constexpr double kMemory = 160e6;
    constexpr double kFewest = 14, kMax = 30;
    const double bytes = static_cast<double>(frame.total() * frame.elemSize());
    return 2 * static_cast<std::size_t>(std::clamp(kMemory / bytes, kFewest, kMax) / 2);
  }

  std::vector<cv::Mat> kept_;
  std::size_t most_ = 0;
  std::size_t stride_ = 1;
  std::size_t seen_ = 0;
};

/// Whether nearly everything changed at once.
class CutFinder {
 public:
  bool is_cut(const cv::Mat& frame) {
    constexpr int kSide_px = 64;
    constexpr double kChanged = 24;
    constexpr double kPart = .6;
    cv::Mat small, grey;
    cv::resize(frame, small, {kSide_px, kSide_px}, 0, 0, cv::INTER_NEAREST);
    cv::cvtColor(small, grey, cv::COLOR_BGR2GRAY);
    double part = 0;
    if (!before_.empty()) {
      cv::Mat difference;
      cv::absdiff(grey, before_, difference);
      part = cv::countNonZero(difference > kChanged) / static_cast<double>(difference.total());
    }
    before_ = grey;
    return part > kPart;
  }

 private:
  cv::Mat before_;
};

void read_rate(FilmSurvey& survey) {
  const std::vector<double>& times = survey.times_s;
  if (times.size() < 2) return;
  std::vector<double> steps;
  for (std::size_t k = 1; k < times.size(); ++k) steps.push_back(times[k] - times[k - 1]);
  std::vector<double> sorted = steps;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                   sorted.end());
  survey.interval_s = sorted[sorted.size() / 2];
  constexpr double kGap = 1.6, kUneven = .2, kUnevenPart = .1;
  double uneven = 0;
  for (const double step : steps) {
    const double ratio = step / survey.interval_s;
    if (ratio > kGap) {
      survey.dropped_frames += static_cast<int>(std::lround(ratio)) - 1;
    } else if (std::abs(ratio - 1) > kUneven) {
      uneven += 1;
    }
  }
  survey.has_variable_rate = uneven > kUnevenPart * static_cast<double>(steps.size());
}

}  // namespace

FilmSurvey survey_film(const FilmFile& file, const FilmProgress& progress) {
  FilmReader film(file);
  FilmSurvey survey;
  survey.claimed_frames = film.claimed_frames();
  Samples samples;
  CutFinder cuts;
  CombFinder combs;
  // In a long film, every fourth frame is enough.
  constexpr int kLooks = 60, kMaxStep = 4;
  const int step = std::clamp(film.claimed_frames() / kLooks, 1, kMaxStep);
  FilmFrame frame;
  for (int number = 0;; ++number) {
    const bool looks = number % step == 0;
    if (!(looks ? film.next(frame) : film.skip(frame))) break;
    if (looks) {
      survey.size = frame.bgr.size();
      if (cuts.is_cut(frame.bgr) && !survey.cut) survey.cut = number;
      combs.look(frame.bgr);
      samples.add(frame.bgr);
    }
    survey.times_s.push_back(frame.time_s);
    const auto done = static_cast<double>(survey.times_s.size());
    if (progress) progress(done / std::max({1.0, done, 1.0 * survey.claimed_frames}));
  }
  survey.samples = samples.take();
  survey.times_s = unrounded_times(std::move(survey.times_s), film.time_unit_s());
  survey.is_interlaced = combs.is_interlaced();
  read_rate(survey);
  return survey;
}

}  // namespace repose::vision
