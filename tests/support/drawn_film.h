#pragma once

#include <functional>

#include <opencv2/core.hpp>

#include "vision/picture/picture.h"

/// Shared by all drawn films of grains. Frames are drawn in floating point.
namespace repose::testing {

inline constexpr double kGravity_mm_s2 = 9806.65;
inline constexpr double kFloorPart = .88;  ///< row where the floor begins / the picture's height

/// A wall with a soft pattern and a floor of another colour.
cv::Mat drawn_scene(const cv::Size& size, unsigned seed, bool is_other = false);

/// A printed board that faces the camera, its middle at a place of the picture.
/// @param square_px  side of a square
void draw_film_board(cv::Mat& scene, const cv::Point2d& middle, double square_px);

/// Blends a disc of one colour, lit from the upper left, into the picture.
void draw_ball(cv::Mat& scene, const cv::Point2d& centre, double radius, const cv::Vec3f& colour);

void draw_shadow(cv::Mat& scene, const cv::Point2d& at, double width, double depth);

/// The mean of the scene as drawn at `parts` moments while the shutter is open.
cv::Mat exposed(const cv::Mat& scene, int parts,
                const std::function<void(cv::Mat& now, int part)>& draw);

/// The picture that a camera records of it.
/// @param noise  standard deviation of a grey level
vision::Picture noisy_picture(cv::Mat drawn, double noise, unsigned seed);

}  // namespace repose::testing
