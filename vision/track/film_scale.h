#pragma once

#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/camera/board_view.h"
#include "vision/film/resting_picture.h"
#include "vision/track/film_grains.h"
#include "vision/track/track.h"

/// Scale of a video of grains, and what is wrong with the video.

namespace repose::vision {

/// The scale in the plane in which the grain moves: from two points, or a board.
class FilmScale {
 public:
  /// @param scene  the video's background
  /// @param lens  the lens whose distortion was removed
  FilmScale(const TrackOptions& options, const cv::Mat& scene, const std::optional<Lens>& lens);

  bool exists() const { return bar_ || board_; }
  /// A board was requested, but none is seen.
  bool misses_board() const { return asks_for_board_ && !board_; }
  /// Corners of the board's sheet in the picture; empty without one.
  const std::vector<Point>& board() const { return outline_; }

  /// At a place of the picture and in a direction there; only if a scale exists.
  Estimate mm_per_px(const cv::Point2d& place, const cv::Point2d& along) const;

 private:
  bool asks_for_board_ = false;
  bool has_lens_ = false;
  std::optional<Estimate> bar_;
  std::optional<BoardView> board_;
  std::vector<Point> outline_;
};

/// What is wrong with a video whose board is not seen, and what to do about it.
inline constexpr const char* kNoBoardSeen =
    "no board was found. Rule: it faces the camera, sharp and evenly lit, at least 10 pixels a "
    "square, and nothing hides it. Fix: put it up beside the grain's way, or give a scale.";

/// What is wrong with the shot, or that nothing moves in it; empty if nothing.
std::string fault_of(const FilmGrains& film);

/// Adds the warnings for the video.
/// @returns whether the user must check something first
bool warn_of_film(const FilmGrains& film, std::vector<Warning>& warnings);

}  // namespace repose::vision
