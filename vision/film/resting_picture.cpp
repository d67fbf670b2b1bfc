#include "vision/film/resting_picture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "vision/film/film_reader.h"
#include "vision/film/rest_finder.h"
#include "vision/film/rest_verdict.h"
#include "vision/film/scene_change.h"
#include "vision/film/shot_verdict.h"
#include "vision/picture/mat_of_picture.h"

namespace repose::vision {
namespace {

Picture picture_of(const cv::Mat& bgr) {
  Picture picture = blank_picture(bgr.cols, bgr.rows);
  bgr.copyTo(mat_of(picture));
  return picture;
}

FilmProgress part_of(const FilmProgress& progress, double from, double length) {
  return [=, &progress](double done) {
    if (progress) progress(from + length * done);
  };
}

cv::Rect rect_of(const Box& box) { return {box.x, box.y, box.width, box.height}; }

/// 255 where movement may be the heap's.
/// @param writing  see writing_in()
cv::Mat places_that_count(const FilmSurvey& survey, const MeasureOptions& options,
                          const cv::Mat& writing) {
  const cv::Rect whole({0, 0}, survey.size);
  cv::Mat counts(survey.size, CV_8U, cv::Scalar(options.hints.heap ? 0 : 255));
  if (options.hints.heap) counts(rect_of(*options.hints.heap) & whole).setTo(255);
  for (const Box& box : options.excluded) counts(rect_of(box) & whole).setTo(0);
  if (!writing.empty()) {
    cv::Mat large;
    cv::resize(writing, large, survey.size, 0, 0, cv::INTER_NEAREST);
    counts.setTo(0, large);
  }
  return counts;
}

/// Looks for the rest, and keeps the film's last frame that it looked at.
RestFinder find_rest(const FilmFile& file, const FilmSurvey& survey, cv::Mat counts,
                     const FilmProgress& progress) {
  RestFinder finder(std::move(counts));
  FilmReader film(file, survey.times_s);
  FilmFrame frame;
  const std::size_t count = survey.times_s.size();
  for (std::size_t k = 0; k < count; ++k) {
    // The last one is always seen: what moves there is no rest.
    const bool looks = k + 1 == count || finder.wants(survey.times_s[k]);
    if (!(looks ? film.next(frame) : film.skip(frame))) break;
    if (looks) finder.look(frame.bgr, frame.time_s);
    progress(static_cast<double>(k + 1) / static_cast<double>(count));
  }
  return finder;
}

/// The mean of a stretch's frames, or of as many as are worth it, evenly spread.
std::pair<Picture, FilmStretch> mean_picture(const FilmFile& file, const FilmSurvey& survey,
                                             const RestFinder::Stretch& rest,
                                             const FilmProgress& progress) {
  constexpr double kMost = 60, kRounding_s = 1e-6;
  const auto is_in = [&](double time_s) {
    return time_s > rest.from_s - kRounding_s && time_s < rest.to_s + kRounding_s;
  };
  const auto all = std::count_if(survey.times_s.begin(), survey.times_s.end(), is_in);
  const int stride = static_cast<int>(std::ceil(static_cast<double>(all) / kMost));
  FilmStretch stretch{.from_s = rest.from_s, .to_s = rest.to_s};
  cv::Mat sum = cv::Mat::zeros(survey.size, CV_32FC3);
  FilmReader film(file);
  FilmFrame frame;
  int number = 0;
  for (const double time_s : survey.times_s) {
    if (time_s > rest.to_s + kRounding_s) break;
    const bool is_taken = is_in(time_s) && number++ % stride == 0;
    if (!(is_taken ? film.next(frame) : film.skip(frame))) break;
    if (is_taken) {
      cv::accumulate(frame.bgr, sum);
      ++stretch.frames;
    }
    progress(time_s / rest.to_s);
  }
  cv::Mat mean;
  sum.convertTo(mean, CV_8UC3, 1. / std::max(1, stretch.frames));
  return {picture_of(mean), stretch};
}

/// Looks at the whole film and says why there is no rest, or takes the picture out of it.
std::string take_rest(const FilmFile& file, const MeasureOptions& options,
                      const FilmProgress& progress, RestingPicture& result) {
  constexpr double kSurveyed = .35, kRest = .35;
  FilmSurvey survey = survey_film(file, part_of(progress, 0, kSurveyed));
  result.film = facts_of(survey);
  result.times_s = survey.times_s;
  if (!survey.samples.empty()) result.picture = picture_of(survey.samples.back());
  std::string fault = fault_of_shot(survey, 0);
  if (fault.empty()) fault = fault_of_rate(survey);
  if (!fault.empty()) return fault;
  const cv::Mat writing = writing_in(survey.samples);
  const RestFinder finder = find_rest(file, survey, places_that_count(survey, options, writing),
                                      part_of(progress, kSurveyed, kRest));
  fault = fault_of_rest(finder, survey);
  if (!fault.empty()) return fault;
  survey.samples.clear();
  auto [picture, stretch] = mean_picture(
      file, survey, *finder.rest(), part_of(progress, kSurveyed + kRest, 1 - kSurveyed - kRest));
  result.picture = std::move(picture);
  result.stretch = stretch;
  result.is_doubtful = warn_of_rest(survey, stretch, writing, result.warnings);
  return {};
}

}  // namespace

RestingPicture resting_picture(const FilmFile& file, const MeasureOptions& options,
                               const FilmProgress& progress) {
  RestingPicture result;
  result.reason = take_rest(file, options, progress, result);
  return result;
}

}  // namespace repose::vision
