#pragma once

namespace repose::vision {

/// True flank angle a from the one seen, a', by a far camera that looks down by `pitch_rad`.
///
///     tan a = sqrt((tan^2 a' + sin^2 e) / cos^2 e)     inverse of tan a' = sqrt(tan^2 a cos^2 e -
///     sin^2 e)
///
///     a   return value      rad   from the ground
///     a'  apparent_rad      rad   of the silhouette's side
///     e   pitch_rad         rad   0 is a level camera
///
/// The silhouette of a cone of slope a is bounded by the two tangents from the projected apex to
/// the projected base circle, an ellipse of axes r and r sin e; the formula follows from it. Holds
/// for a cone, seen from farther than about three base radii, and e < a. Proved by
/// tests/vision/camera_pitch_test.cpp against the tangents themselves.
double angle_without_pitch(double apparent_rad, double pitch_rad);

/// Pitch that bows a round base downwards, from the parabola y = a + b u + c u^2 fitted to it over
/// its width (u = -1 to 1); `bow` is -c over the width.
///
/// The rim's near half is the half ellipse y = r sin e sqrt(1 - u^2), whose least-squares parabola
/// has c = -(15 pi / 64) r sin e; so sin e = 2 bow * 64 / (15 pi).
/// Proved by tests/vision/camera_pitch_test.cpp and tests/vision/body_test.cpp.
double pitch_from_bow(double bow);

}  // namespace repose::vision
