#include "vision/track/film_scale.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "base/input_error.h"
#include "vision/picture/opencv.h"

namespace repose::vision {

namespace {

std::vector<SeenCorner> corners_in(const cv::Mat& scene) {
  Picture picture = blank_picture(scene.cols, scene.rows);
  scene.copyTo(mat_of(picture));
  return find_board(picture);
}

}  // namespace

FilmScale::FilmScale(const TrackOptions& options, const cv::Mat& scene,
                     const std::optional<Lens>& lens)
    : asks_for_board_(options.board.has_value()), has_lens_(lens.has_value()) {
  if (scene.empty()) return;
  std::optional<Lens> here;
  if (lens) here = lens_for(*lens, scene.cols, scene.rows);
  if (options.scale) {
    if (auto fault = problem_in(*options.scale, scene.cols, scene.rows)) {
      throw base::InputError(*std::move(fault));
    }
    bar_ = vision::mm_per_px(here ? corrected_bar(*options.scale, *here) : *options.scale);
  }
  if (!options.board) return;
  const std::vector<SeenCorner> corners = corners_in(scene);
  if (corners.empty()) return;
  constexpr double kSquare_rad = 10 * CV_PI / 180;
  const BoardPose pose = fit_pose(corners, here, scene.cols, scene.rows,
                                  here ? std::nullopt : std::optional(kSquare_rad));
  board_.emplace(pose, *options.board);
  outline_ = sheet_outline(pose, corners);
}

Estimate FilmScale::mm_per_px(const cv::Point2d& place, const cv::Point2d& along) const {
  if (bar_) return *bar_;
  Estimate scale = board_->estimate([&](const HeapView& view) {
    return mm_per_px_along(view, {place.x, place.y}, {along.x, along.y});
  });
  const double print_and_lens = std::hypot(kPrinted, has_lens_ ? 0 : kNoLens);
  scale.uncertainty = std::hypot(scale.uncertainty, print_and_lens * scale.value);
  return scale;
}

std::string fault_of(const FilmGrains& film) {
  std::string fault = fault_of_shot(film.survey, farthest_shift_px(film));
  if (fault.empty()) fault = fault_of_fields(film.survey);
  if (!fault.empty()) return fault;
  if (film.paths.empty()) {
    return "nothing moves before a scene at rest. Fix: film from the side, with a backdrop of "
           "another colour than the grain, and fix exposure and focus.";
  }
  return {};
}

bool warn_of_film(const FilmGrains& film, std::vector<Warning>& warnings) {
  if (film.repeated.count > 0) {
    const auto left_out =
        std::count(film.repeated.is_repeat.begin(), film.repeated.is_repeat.end(), true);
    warnings.push_back(
        {.code = "repeated_frames",
         .message = fmt::format(
             "{} of its frames only repeat the one before them{}: they were "
             "left out",
             left_out, film.repeated.taken_at ? ", in a pattern of another frame rate" : "")});
  }
  return warn_of_film(film.survey, farthest_shift_px(film), warnings);
}

}  // namespace repose::vision
