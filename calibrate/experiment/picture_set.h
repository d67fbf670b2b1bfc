#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/statistics/summary.h"
#include "vision/measure/repose_angle.h"

/// The pictures of a bench's heaps as a set: several photographs of one heap count as one heap,
/// camera errors common to all are not random, and a wrong object is not a heap.
namespace repose::calibrate {

/// The measurement of one picture from the bench.
struct SetPicture {
  vision::MeasureStatus status = vision::MeasureStatus::refused;
  std::optional<double> angle_deg;
  double own_deg = 0;     ///< half-width of its 95 % interval, without the camera's contribution
  double camera_deg = 0;  ///< likewise, the part common to pictures taken alike
  std::string heap = {};  ///< pictures with the same name are of one heap; empty: a heap of its own
};

/// By its name in JSON: "flagged"; refused for any other name.
vision::MeasureStatus picture_status_named(std::string_view name);

SetPicture set_picture_of(const vision::ReposeAngle& measured, const std::string& heap = {});

/// A picture that is far from the others of its set.
struct OutlyingPicture {
  std::size_t place = 0;  ///< index among the set's pictures
  double score = 0;       ///< distance from the median, divided by the scatter of the others
  bool is_counted = false;
};

/// A heap of a set by its pictures.
struct HeapOfSet {
  std::string name;  ///< empty: the picture names none
  int pictures = 0;
  double angle_deg = 0;              ///< their mean
  std::optional<double> sd_deg;      ///< of single pictures; needs at least two
  std::optional<double> within_deg;  ///< half-width of the mean's 95 % interval; see PictureSet
};

struct PictureSet {
  /// Over heaps, each with the mean of its pictures: all measurable ones except flagged outliers.
  /// std::nullopt if there are none.
  std::optional<Summary> heaps_deg;
  std::optional<Summary> all_deg;  ///< over heaps, of all measurable pictures
  std::optional<Summary> ok_deg;   ///< over heaps, of pictures with the status ok
  std::vector<HeapOfSet> heaps;    ///< included in heaps_deg
  int pictures = 0;                ///< included in heaps_deg
  int flagged = 0;                 ///< of these
  int refused = 0;                 ///< or without an angle by the definition
  /// Of pictures of one heap, pooled over the heaps; std::nullopt if each heap has one picture.
  std::optional<double> within_sd_deg;
  /// Of the heaps themselves, without the scatter of their pictures; needs two heaps, one of them
  /// with several pictures.
  std::optional<double> between_sd_deg;
  /// Half-widths of 95 % intervals: root mean square of those of a heap's mean due to its own
  /// pictures, and that of the overall mean due to the camera.
  double own_deg = 0;
  double camera_deg = 0;
  double median_deg = 0;                  ///< of all measurable pictures
  std::vector<OutlyingPicture> outliers;  ///< in the order of the pictures
};

/// Outliers are those whose modified z-score is above 3.5,
///
///     M = |x - m| / max(1.4826 MAD, u)
///
///     m    median of the pictures' angles      MAD  median of |x - m|
///     u    median of their own standard uncertainties, the least scatter of similar pictures
///
/// if there are three pictures or more. Source: Iglewicz and Hoaglin (1993), How to Detect and
/// Handle Outliers, ASQC Basic References in Quality Control 16, where M is .6745 (x - m) / MAD,
/// without u. A flagged outlier is left out of the mean: both the picture itself and the others
/// indicate an error. One with status ok counts. Simulated views cannot show wrong objects, so
/// their means include all (heap_angle.h). The mean of fully correlated errors has the mean of
/// their uncertainties: JCGM 100:2008 (GUM), 5.2.2, note 1.
///
/// A heap's angle is the mean over the sides it is seen from. The scatter of its pictures is
/// assumed equal for all heaps and pooled, after JCGM 100:2008 (GUM), H.5.2:
///
///     w^2 = sum (x - x_k)^2 / f          f = sum (m_k - 1)
///     a heap's half-width = t(.975; f) w / sqrt(m_k) + camera, no less than by its pictures' own
///     b^2 = s^2 - w^2 mean(1 / m_k)      at least 0
///
///     x_k, m_k  mean and number of a heap's pictures      s  standard deviation of the x_k
///     w, b      standard deviations within and between heaps
///
/// The camera's contribution is added linearly, as for a single picture. Proved by PictureSet.* in
/// tests/calibrate.
PictureSet set_of_pictures(std::span<const SetPicture> pictures);

/// "51.20° is an outlier: the median of these 4 pictures is 22.45°, ...".
std::string text_of(const OutlyingPicture& outlier, const PictureSet& set, double angle_deg);

}  // namespace repose::calibrate
