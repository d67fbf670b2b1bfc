#include "vision/film/resting_picture.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "vision/film/film_angle.h"
#include "vision/film/film_reader.h"
#include "vision/film/film_survey.h"
#include "vision/film/scene_change.h"
#include "vision/picture/opencv.h"

/// The picture of a heap at rest, and errors of its film.

namespace repose::vision {

namespace {

/// Finds the last stretch of a film in which nothing changes.
///
/// Each look is compared with the previous one, which reveals movement, and with the first of its
/// stretch, up to a second earlier, which reveals creep.
class RestFinder {
 public:
  /// A rest lasts at least kMin_s; at most kWhole_s of it are used.
  static constexpr double kMin_s = .5, kWhole_s = 1;

  struct Stretch {
    double from_s = 0;
    double to_s = 0;
  };

  /// @param counts  0 where changes are not the heap's; of the frames' size or smaller; empty: they
  ///   count everywhere
  explicit RestFinder(cv::Mat counts) : counts_(std::move(counts)) {}

  /// Whether to look at the frame at this time: looks are a minimum interval apart.
  bool wants(double time_s) const;
  void look(const cv::Mat& frame, double time_s);

  /// The last rest; std::nullopt if there was none.
  const std::optional<Stretch>& rest() const { return rest_; }
  /// Where something moved after it, or at the end of a film without rest, as fractions of the
  /// picture's width and height; empty: nowhere.
  cv::Rect2d moved_part() const;
  /// Whether everything that moved after it came in from the left, the right or below.
  bool only_came_in() const;

 private:
  struct Look {
    double time_s = 0;
    cv::Mat picture;
  };

  cv::Mat changes(const cv::Mat& look, const cv::Mat& earlier) const;
  void find_rest();

  cv::Mat counts_;
  std::deque<Look> still_;  ///< since the last movement, within the last second
  cv::Mat at_rest_;         ///< the last look of the rest
  cv::Mat moved_;           ///< after it
  std::optional<Stretch> rest_;
};

bool RestFinder::wants(double time_s) const {
  constexpr double kBetween_s = .079;
  return still_.empty() || time_s >= still_.back().time_s + kBetween_s;
}

cv::Mat RestFinder::changes(const cv::Mat& look, const cv::Mat& earlier) const {
  cv::Mat places = changed_places(look, earlier);
  if (counts_.empty()) return places;
  cv::Mat counts;
  cv::resize(counts_, counts, places.size(), 0, 0, cv::INTER_NEAREST);
  return places & counts;
}

void RestFinder::look(const cv::Mat& frame, double time_s) {
  const Look now{.time_s = time_s, .picture = reduced_look(frame)};
  cv::Mat moved;
  if (!still_.empty()) moved = changes(now.picture, still_.back().picture);
  const bool has_moved = !moved.empty() && cv::countNonZero(moved) > 0;
  if (has_moved) still_.clear();
  still_.push_back(now);
  // Looks older than a stretch may last are dropped.
  constexpr double kRounding_s = 1e-6;
  while (time_s - still_.front().time_s > kWhole_s + kRounding_s) still_.pop_front();
  const double before_s = rest_ ? rest_->to_s : -1;
  find_rest();
  if (rest_ && rest_->to_s > before_s) return;
  if (!rest_) {
    if (has_moved) moved_ = moved;
    return;
  }
  const cv::Mat since = changes(now.picture, at_rest_);
  moved_ = moved_.empty() ? since : cv::Mat(moved_ | since);
}

void RestFinder::find_rest() {
  const Look& now = still_.back();
  for (const Look& first : still_) {
    if (now.time_s - first.time_s < kMin_s) return;
    if (cv::countNonZero(changes(now.picture, first.picture)) > 0) continue;
    rest_ = {.from_s = first.time_s, .to_s = now.time_s};
    at_rest_ = now.picture;
    moved_.release();
    return;
  }
}

cv::Rect2d RestFinder::moved_part() const {
  if (moved_.empty() || cv::countNonZero(moved_) == 0) return {};
  const cv::Rect box = cv::boundingRect(moved_);
  return {1. * box.x / moved_.cols, 1. * box.y / moved_.rows, 1. * box.width / moved_.cols,
          1. * box.height / moved_.rows};
}

bool RestFinder::only_came_in() const {
  if (moved_.empty()) return true;
  cv::Mat joined, labels, stats, centres;
  cv::dilate(moved_, joined, cv::Mat());
  const int count = cv::connectedComponentsWithStats(joined, labels, stats, centres);
  for (int label = 1; label < count; ++label) {
    const int left = stats.at<int>(label, cv::CC_STAT_LEFT);
    const int top = stats.at<int>(label, cv::CC_STAT_TOP);
    const bool is_at_side =
        left == 0 || left + stats.at<int>(label, cv::CC_STAT_WIDTH) == joined.cols;
    const bool is_at_foot = top + stats.at<int>(label, cv::CC_STAT_HEIGHT) == joined.rows;
    if (!is_at_side && !is_at_foot) return false;
  }
  return true;
}

constexpr double kStill_s = .2;  ///< less time after the rest is not judged

/// How far the camera moved, relative to its position at the film's end.
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

/// Why the film has no usable rest; empty if it has.
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

/// Adds warnings about the film and about the stretch that was used.
/// @param writing  see writing_in()
/// @returns whether the user must check something first
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

/// At too low a frame rate no rest can be detected.
std::string fault_of_rate(const FilmSurvey& survey) {
  constexpr double kFewest_s = 4;
  if (survey.interval_s * kFewest_s <= 1) return {};
  return fmt::format(
      "the film has {:.2g} frames per second. Rule: {:.0f} or more. Fix: take one picture of the "
      "heap at rest out of it, and measure that.",
      1 / survey.interval_s, kFewest_s);
}

}  // namespace

FilmFacts facts_of(const FilmSurvey& survey) {
  return {.width = survey.size.width,
          .height = survey.size.height,
          .frames = static_cast<int>(survey.times_s.size()),
          .frames_per_s = survey.interval_s > 0 ? 1 / survey.interval_s : 0,
          .length_s = survey.times_s.empty() ? 0 : survey.times_s.back(),
          .dropped_frames = survey.dropped_frames};
}

std::string fault_of_shot(const FilmSurvey& survey, double moved_px) {
  if (survey.times_s.size() < kFewestFrames) {
    return fmt::format(
        "the film has {} frames. Rule: {} or more. Fix: begin the film "
        "earlier, and end it when all lies still.",
        survey.times_s.size(), kFewestFrames);
  }
  if (survey.cut) {
    return fmt::format(
        "another scene begins with frame {}. Rule: one shot. Fix: cut the film to one "
        "experiment, from a camera that stands still.",
        *survey.cut + 1);
  }
  const double most_px = std::max(4.0, .004 * survey.size.width);
  if (moved_px > most_px) {
    return fmt::format(
        "the camera moves: the scene shifts by {:.1f} pixels. Rule: at most {:.1f}. Fix: put the "
        "camera on a stand, start it with a remote, and keep its zoom.",
        moved_px, most_px);
  }
  return {};
}

std::string fault_of_fields(const FilmSurvey& survey) {
  if (!survey.is_interlaced) return {};
  return "the film is interlaced: every other row of a frame was taken half a frame later, and "
         "what moves is combed. Rule: whole frames. Fix: film in a progressive mode (p, not i), "
         "or make frames of its fields: ffmpeg -i FILM -vf bwdif=mode=send_field -crf 12 NEW.mp4.";
}

bool warn_of_film(const FilmSurvey& survey, double moved_px, std::vector<Warning>& warnings) {
  const auto frames = static_cast<int>(survey.times_s.size());
  const bool is_cut_short = survey.claimed_frames > frames + 2 + frames / 50;
  if (is_cut_short) {
    warnings.push_back({.code = "cut_short",
                        .message = fmt::format(
                            "the film ends after {} of the {} frames that it says it has: it is "
                            "damaged, and what follows is not seen",
                            frames, survey.claimed_frames)});
  }
  if (survey.has_variable_rate) {
    warnings.push_back({.code = "variable_rate",
                        .message = "its frames do not follow evenly: their time stamps were used"});
  }
  if (survey.dropped_frames > 0) {
    warnings.push_back(
        {.code = "dropped_frames",
         .message = fmt::format("{} frames are missing by the time stamps, which were used",
                                survey.dropped_frames)});
  }
  constexpr double kMoved_px = .8;
  if (moved_px > kMoved_px) {
    warnings.push_back(
        {.code = "camera_moves",
         .message = fmt::format("the camera moves by up to {:.1f} pixels, which was taken out",
                                moved_px)});
  }
  return is_cut_short;
}

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

/// Searches the whole film for the rest.
RestFinder find_rest(const FilmFile& file, const FilmSurvey& survey, cv::Mat counts,
                     const FilmProgress& progress) {
  RestFinder finder(std::move(counts));
  FilmReader film(file, survey.times_s);
  FilmFrame frame;
  const std::size_t count = survey.times_s.size();
  for (std::size_t k = 0; k < count; ++k) {
    // The last frame is always checked: movement there means no rest.
    const bool looks = k + 1 == count || finder.wants(survey.times_s[k]);
    if (!(looks ? film.next(frame) : film.skip(frame))) break;
    if (looks) finder.look(frame.bgr, frame.time_s);
    progress(static_cast<double>(k + 1) / static_cast<double>(count));
  }
  return finder;
}

/// The mean of a stretch's frames, or of a limited number of them, evenly spread.
std::pair<Picture, FilmStretch> mean_picture(const FilmFile& file, const FilmSurvey& survey,
                                             const RestFinder::Stretch& rest,
                                             const FilmProgress& progress) {
  constexpr double kMax = 60, kRounding_s = 1e-6;
  const auto is_in = [&](double time_s) {
    return time_s > rest.from_s - kRounding_s && time_s < rest.to_s + kRounding_s;
  };
  const auto all = std::count_if(survey.times_s.begin(), survey.times_s.end(), is_in);
  const int stride = static_cast<int>(std::ceil(static_cast<double>(all) / kMax));
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

/// Sets the picture of the heap at rest, or returns why there is none.
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
