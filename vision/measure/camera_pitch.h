#pragma once

namespace repose::vision {

/// True flank angle a from the apparent angle a', for a distant camera that looks down by
/// `pitch_rad`.
///
///     tan a = sqrt((tan^2 a' + sin^2 e) / cos^2 e)
///     inverse of tan a' = sqrt(tan^2 a cos^2 e - sin^2 e)
///
///     a   return value      rad   from the ground
///     a'  apparent_rad      rad   of the silhouette's side
///     e   pitch_rad         rad   0 is a level camera
///
/// The silhouette of a cone of slope a is bounded by the two tangents from the projected apex to
/// the projected base circle, an ellipse with axes r and r sin e; the formula follows from it.
/// Valid for a cone seen from farther than about three base radii, and e < a. Proved by
/// tests/vision/camera_pitch_test.cpp against the tangents themselves.
double angle_without_pitch(double apparent_rad, double pitch_rad);

/// The same for a camera at any distance that sees the apex in a direction `apex_pitch_rad` below
/// the horizon.
///
///     tan a = sqrt(tan^2 a' (cos e + sin e tan d)^2 + tan^2 d)
///
///     d   apex_pitch_rad    rad   e for a distant camera, e - atan(v/f) for an apex v above the
///                                 middle of a picture taken with focal length f
///
/// A plane z = h - tan a (x cos p + y sin p) touches the cone with its apex at height h. It is seen
/// as a line if it contains the eye, so sin p = tan d / tan a; where it meets the picture, tan a' =
/// tan a cos p / (cos e + sin e tan d). Eliminating p gives the formula. Valid for a cone whose
/// apex is seen above or below the picture's middle, not to the side; and |d| < a. Proved by
/// tests/vision/camera_pitch_test.cpp against a search for the outline.
double angle_without_pitch(double apparent_rad, double pitch_rad, double apex_pitch_rad);

/// The angle a that a heap would show on the lens's axis, from the apparent angle a' off the axis.
///
///     tan a = tan a' / cos s
///
///     s   aside_rad   rad   direction of the heap's crest, from the axis, along the ground
///
/// The picture stretches off-axis objects at the same distance from the eye: by 1 / cos^2 s along
/// the ground, by 1 / cos s upwards. Valid for heaps that are narrow compared with their distance.
/// Proved by tests/vision/sized_heap_test.cpp on a projected cone.
double angle_without_aside(double apparent_rad, double aside_rad);

/// Nearest camera that a corrected angle's interval allows for [base radii from the heap].
inline constexpr double kNearestCamera = 6;

/// Error [rad] of an angle that angle_without_pitch() corrected as for a distant camera, if the
/// camera is kNearestCamera away: the picture does not show the distance, and from close by the
/// apex is seen in another direction than the picture's middle.
///
/// `apex_rise` is the height of the apex above the picture's middle, in base radii of the picture;
/// from the distance D (also in base radii) it is seen atan(apex_rise / D) above the camera's axis.
double far_camera_error(double apparent_rad, double pitch_rad, double apex_rise);

/// Pitch at which a round base bows downwards, from the parabola y = a + b u + c u^2 fitted to it
/// over its width (u = -1 to 1); `bow` is -c over the width.
///
/// The rim's near half is the half ellipse y = r sin e sqrt(1 - u^2), whose least-squares parabola
/// has c = -(15 pi / 64) r sin e; so sin e = 2 bow * 64 / (15 pi).
/// Proved by tests/vision/camera_pitch_test.cpp and tests/vision/body_test.cpp.
double pitch_from_bow(double bow);

/// How far the measured angle may lie below the true one [rad] if no pitch was given and the camera
/// was assumed level: what angle_without_pitch() adds for `pitch_rad`, which is the pitch implied
/// by the bow of the base, or the largest to be expected if no base is seen.
///
/// Valid for a lens at or above the middle of the heap's height. At the distance D (base radii) and
/// the height z it sees the base bow like a distant camera of pitch z / (D - 1), and the apex, h
/// high, in the direction d = (z - h) / D below the horizon: with z >= h / 2, |d| is the smaller.
/// Proved by tests/vision/camera_pitch_test.cpp against a search for the outline.
double assumed_pitch_error(double apparent_rad, double pitch_rad);

}  // namespace repose::vision
