#pragma once

#include <functional>

#include <opencv2/core.hpp>

#include "vision/picture/picture.h"

/// What drawn films of grains have in common. Frames are drawn in floating point.
namespace repose::testing {

inline constexpr double kGravity_mm_s2 = 9806.65;
inline constexpr double kFloorPart = .88;  ///< of the picture's height, where the floor begins

/// A wall with a soft pattern and a floor of another colour.
cv::Mat drawn_scene(const cv::Size& size, unsigned seed, bool is_other = false);

/// A printed board that faces the camera, its middle at a place of the picture.
/// @param square_px  side of a square
void draw_film_board(cv::Mat& scene, const cv::Point2d& middle, double square_px);

/// Mixes a disc of one colour, lit from the upper left, into the picture.
void draw_ball(cv::Mat& scene, const cv::Point2d& centre, double radius, const cv::Vec3f& colour);

void draw_shadow(cv::Mat& scene, const cv::Point2d& at, double width, double depth);

/// The mean of what is drawn onto a scene at `parts` moments while the shutter is open.
cv::Mat exposed(const cv::Mat& scene, int parts,
                const std::function<void(cv::Mat& now, int part)>& draw);

/// What a camera makes of it.
/// @param noise  standard deviation of a grey level
vision::Picture noisy_picture(cv::Mat drawn, double noise, unsigned seed);

}  // namespace repose::testing
