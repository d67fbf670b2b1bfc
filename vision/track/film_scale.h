#pragma once

#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/camera/board_view.h"
#include "vision/film/resting_picture.h"
#include "vision/track/film_grains.h"
#include "vision/track/track.h"

/// What is wrong with a film of grains.

namespace repose::vision {

/// What gives a film millimetres in the plane in which its grain moves: two points, or a board.
class FilmScale {
 public:
  /// @param scene  the film's background
  /// @param lens  that its distortion was taken out by
  FilmScale(const TrackOptions& options, const cv::Mat& scene, const std::optional<Lens>& lens);

  bool exists() const { return bar_ || board_; }
  /// A board was asked for, and none is seen.
  bool misses_board() const { return asks_for_board_ && !board_; }
  /// The corners of the board's sheet in the picture; none without one.
  const std::vector<Point>& board() const { return outline_; }

  /// At a place of the picture and in a direction there; where it exists.
  Estimate mm_per_px(const cv::Point2d& place, const cv::Point2d& along) const;

 private:
  bool asks_for_board_ = false;
  bool has_lens_ = false;
  std::optional<Estimate> bar_;
  std::optional<BoardView> board_;
  std::vector<Point> outline_;
};

/// What is wrong with a film whose board is not seen, and what to do about it.
inline constexpr const char* kNoBoardSeen =
    "no board was found. Rule: it faces the camera, sharp and evenly lit, at least 10 pixels a "
    "square, and nothing hides it. Fix: put it up beside the grain's way, or give a scale.";

/// What is wrong with the shot, or that nothing moves in it.
std::string fault_of(const FilmGrains& film);

/// Adds what is to be known of it.
/// @returns whether a person must look at something first
bool warn_of_film(const FilmGrains& film, std::vector<Warning>& warnings);

}  // namespace repose::vision
