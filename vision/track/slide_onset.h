#pragma once

#include <optional>
#include <vector>

namespace repose::vision {

/// How far something has slid at a time.
struct SlidAt {
  double time_s = 0;
  double slid_px = 0;
  double turned_rad = 0;  ///< by the plate
};

/// When something that lay at rest began to slide.
struct SlideOnset {
  double time_s = 0;
  double earliest_s = 0;  ///< of its 95 % interval
  double latest_s = 0;
  double unseen_s = 0;       ///< how long nothing is seen about the onset, where frames are missing
  double rms_px = 0;         ///< of the places from what was fitted
  double rest_noise_px = 0;  ///< standard deviation of a place at rest
  /// Before the onset, beside what a hinge off its place lets all that lies still seem to move.
  double crept_px = 0;
};

/// Traces a slide back to its onset t0. On a plate that turns at a steady rate w the excess of
/// weight over friction grows from a step a, where friction falls when the slide begins, and then
/// about linearly with time. What lies still seems to move too, as the plate turns by A, where the
/// hinge is found beside its place, and where a fixed light wanders over a shaded grain:
///
///     s(t) = c + d A(t) + a (t - t0)^2 / 2 + j (t - t0)^3 / 6
///
///     s   way down the plate         px
///     c   where it lay               px
///     d   seeming motion             px/rad
///     a   g (sin A - m cos A)        px/s^2   >= 0; A: angle of the onset, m: friction in motion
///     j   g w (cos A + m sin A)      px/s^3   >= 0; w in rad/s
///
/// the last two from t0 on. Derived: Newton's second law with Coulomb's friction on a slope
/// A + w (t - t0), to third order; the sheet of `repose simulate tilt` is read by the same law
/// without the step. A hinge off by h px lets what lies still move by h (cos A - 1) along the plate
/// and h sin A, of which d A is what changes within some degrees. Holds for slides in which the
/// plate turns by some degrees. t0 is that of the least squares, with c, d, a and j fitted at each
/// t0; its interval is that of the profile likelihood (neighbouring places err alike).
/// Checked by SlideOnset.* of tests/vision/slide_onset_test.cpp.
/// @param most_px  places beyond are left out
/// @return none where it never gets `least_px` far
std::optional<SlideOnset> slide_onset(const std::vector<SlidAt>& places, double least_px,
                                      double most_px);

}  // namespace repose::vision
