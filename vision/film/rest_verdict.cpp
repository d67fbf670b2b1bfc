#include "vision/film/rest_verdict.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "vision/film/scene_shift.h"
#include "vision/film/shot_verdict.h"

namespace repose::vision {
namespace {

constexpr double kStill_s = .2;  ///< less after the rest tells nothing

/// How far the camera moved from where it stood at the film's end.
double moved_px(const FilmSurvey& survey) {
  const SceneShift shift(survey.samples.back());
  double most_px = 0;
  for (const cv::Mat& sample : survey.samples) {
    const cv::Point2d one = shift.of(sample);
    most_px = std::max(most_px, std::hypot(one.x, one.y));
  }
  return most_px;
}

std::string box_text(const cv::Rect2d& part, const cv::Size& size) {
  return fmt::format("{:.0f},{:.0f},{:.0f},{:.0f}", part.x * size.width, part.y * size.height,
                     part.width * size.width, part.height * size.height);
}

}  // namespace

std::string fault_of_rest(const RestFinder& finder, const FilmSurvey& survey) {
  const std::string fix =
      "Rule: the scene is still for 0.5 s or more, and the heap does not change after that. Fix: "
      "film at least 1 s after the last grain has stopped, with the camera on a stand. If what "
      "moves is not the heap, give it as an " +
      base::field("excluded box") + '.';
  const std::string where = box_text(finder.moved_part(), survey.size);
  if (!finder.rest()) {
    std::string shaken = fault_of_shot(survey, moved_px(survey));
    if (!shaken.empty()) return shaken;
    return fmt::format("nothing in the film is at rest: at last it moved within {}. {}", where,
                       fix);
  }
  const double after_s = survey.times_s.back() - finder.rest()->to_s;
  if (after_s < kStill_s || finder.only_came_in()) return {};
  return fmt::format(
      "the film's end still moves: after a rest until {:.2f} s the scene changed within {}. {}",
      finder.rest()->to_s, where, fix);
}

bool warn_of_rest(const FilmSurvey& survey, const FilmStretch& stretch, const cv::Mat& writing,
                  std::vector<Warning>& warnings) {
  bool is_doubtful = warn_of_film(survey, 0, warnings);
  constexpr double kShort = .85;
  const double rest_s = stretch.to_s - stretch.from_s;
  if (rest_s < kShort * RestFinder::kWhole_s) {
    warnings.push_back(
        {.code = "short_rest",
         .message = fmt::format("Only {:.2f} s at rest are seen: whether the heap has stopped "
                                "growing is not sure. Film at least 1 s after the last grain "
                                "has stopped.",
                                rest_s)});
    is_doubtful = true;
  }
  const double after_s = survey.times_s.back() - stretch.to_s;
  if (after_s > kStill_s) {
    warnings.push_back(
        {.code = "moves_after",
         .message = fmt::format("Something comes into the picture {:.2f} s before the film's end: "
                                "the heap before that was measured.",
                                after_s)});
  }
  if (!writing.empty() && cv::countNonZero(writing) > 0) {
    const cv::Rect box = cv::boundingRect(writing);
    const cv::Rect2d part(1. * box.x / writing.cols, 1. * box.y / writing.rows,
                          1. * box.width / writing.cols, 1. * box.height / writing.rows);
    warnings.push_back(
        {.code = "writing",
         .message = fmt::format("What changes all through the film within {}, like a timer, was "
                                "taken for writing and not for movement.",
                                box_text(part, survey.size))});
  }
  return is_doubtful;
}

std::string fault_of_rate(const FilmSurvey& survey) {
  constexpr double kFewest_s = 4;
  if (survey.interval_s * kFewest_s <= 1) return {};
  return fmt::format(
      "the film has {:.2g} frames per second. Rule: {:.0f} or more. Fix: take one picture of the "
      "heap at rest out of it, and measure that.",
      1 / survey.interval_s, kFewest_s);
}

}  // namespace repose::vision
