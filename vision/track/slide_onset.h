#pragma once

#include <optional>
#include <vector>

namespace repose::vision {

/// Distance slid at a given time.
struct SlidAt {
  double time_s = 0;
  double slid_px = 0;
  double turned_rad = 0;  ///< by the plate
};

/// When an object at rest began to slide.
struct SlideOnset {
  double time_s = 0;
  double earliest_s = 0;  ///< of its 95 % interval
  double latest_s = 0;
  double unseen_s = 0;       ///< duration without sightings around the onset, if frames are missing
  double rms_px = 0;         ///< of the places about the fit
  double rest_noise_px = 0;  ///< standard deviation of a place at rest
  /// Before the onset, apart from the apparent motion caused by a misplaced hinge.
  double crept_px = 0;
};

/// Traces a slide back to its onset t0. On a plate that turns at a constant rate w, the excess of
/// weight over friction jumps to a step a, as friction falls when the slide begins, and then grows
/// about linearly with time. Even an object at rest appears to move as the plate turns by A, if the
/// hinge is found in a slightly wrong place or the light from a fixed source moves over a shaded
/// grain:
///
///     s(t) = c + d A(t) + a (t - t0)^2 / 2 + j (t - t0)^3 / 6
///
///     s   way down the plate         px
///     c   initial place              px
///     d   apparent motion            px/rad
///     a   g (sin A - m cos A)        px/s^2   >= 0; A: angle of the onset, m: friction in motion
///     j   g w (cos A + m sin A)      px/s^3   >= 0; w in rad/s
///
/// The last two apply from t0 on. Derived: Newton's second law with Coulomb friction on a slope A +
/// w (t - t0), to third order; the sheet of `repose simulate tilt` is evaluated by the same law
/// without the step. A hinge that is off by h px makes an object at rest appear to move by h (cos A
/// - 1) along the plate and by h sin A; d A is the change of these within a few degrees. Valid for
/// slides during which the plate turns by a few degrees. t0 is the least-squares value, with c, d,
/// a and j fitted for each t0; its interval is that of the profile likelihood (errors of
/// neighbouring places are correlated). Checked by SlideOnset.* of
/// tests/vision/slide_onset_test.cpp.
/// @param most_px  places beyond are ignored
/// @return std::nullopt if it never gets `least_px` far, or too few places show its rest or slide
std::optional<SlideOnset> slide_onset(const std::vector<SlidAt>& places, double least_px,
                                      double most_px);

}  // namespace repose::vision
