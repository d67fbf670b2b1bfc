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

/// The same for a camera at any distance, which sees the apex in a direction `apex_pitch_rad`
/// below the horizon.
///
///     tan a = sqrt(tan^2 a' (cos e + sin e tan d)^2 + tan^2 d)
///
///     d   apex_pitch_rad    rad   e for a far camera, e - atan(v/f) for an apex v above the
///                                 middle of a picture taken with the focal length f
///
/// A plane z = h - tan a (x cos p + y sin p) touches the cone whose apex lies at height h. It is
/// seen as a line if it contains the eye, so sin p = tan d / tan a; where it meets the picture,
/// tan a' = tan a cos p / (cos e + sin e tan d). Eliminating p gives the formula. Holds for a cone
/// whose apex is seen above the picture's middle or below it, not aside; and |d| < a. Proved by
/// tests/vision/camera_pitch_test.cpp against a search for the outline.
double angle_without_pitch(double apparent_rad, double pitch_rad, double apex_pitch_rad);

/// The angle a that a heap would show on the lens's axis, from the one seen, a', aside of it.
///
///     tan a = tan a' / cos s
///
///     s   aside_rad   rad   direction of the heap's crest, from the axis, along the ground
///
/// The picture stretches what is aside: along the ground by 1 / cos^2 s, upwards by 1 / cos s, of
/// what lies at the same distance from the eye. Holds for heaps that are narrow beside their
/// distance. Proved by tests/vision/sized_heap_test.cpp on a projected cone.
double angle_without_aside(double apparent_rad, double aside_rad);

/// Nearest camera that a corrected angle's interval allows for: base radii from the heap.
inline constexpr double kNearestCamera = 6;

/// How far off an angle is, rad, that angle_without_pitch has corrected as a far camera's, when the
/// camera is kNearestCamera away: the picture does not tell, and then the apex is seen in another
/// direction than the picture's middle.
///
/// `apex_rise` is how far the apex lies above the picture's middle, in base radii of the picture;
/// at the distance D (in them, too) it is seen atan(apex_rise / D) above the camera's axis.
double far_camera_error(double apparent_rad, double pitch_rad, double apex_rise);

/// Pitch that bows a round base downwards, from the parabola y = a + b u + c u^2 fitted to it over
/// its width (u = -1 to 1); `bow` is -c over the width.
///
/// The rim's near half is the half ellipse y = r sin e sqrt(1 - u^2), whose least-squares parabola
/// has c = -(15 pi / 64) r sin e; so sin e = 2 bow * 64 / (15 pi).
/// Proved by tests/vision/camera_pitch_test.cpp and tests/vision/body_test.cpp.
double pitch_from_bow(double bow);

/// How far an angle may lie below the heap's, rad, when the pitch was not told and the camera was
/// taken for level: by what angle_without_pitch adds for `pitch_rad`, the pitch that the base's bow
/// gives away, or the largest to be expected where no base is seen.
///
/// Holds for a lens in the middle of the heap's height or above it. At the distance D (base radii)
/// and the height z it sees the base bow as a far camera of pitch z / (D - 1) does, and the apex,
/// h high, in the direction d = (z - h) / D below the horizon: with z >= h / 2, |d| is the smaller.
/// Proved by tests/vision/camera_pitch_test.cpp against a search for the outline.
double assumed_pitch_error(double apparent_rad, double pitch_rad);

}  // namespace repose::vision
