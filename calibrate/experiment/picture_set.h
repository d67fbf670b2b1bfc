#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/statistics/summary.h"
#include "vision/measure/repose_angle.h"

/// The pictures of a bench's heaps as a set: several photographs of one heap are one heap, what the
/// camera does to all of them is no chance, and a wrong object is no heap.
namespace repose::calibrate {

/// What one picture of a bench gave.
struct SetPicture {
  vision::MeasureStatus status = vision::MeasureStatus::refused;
  std::optional<double> angle_deg;
  double own_deg = 0;     ///< half-width of its 95 % interval, without the camera's part
  double camera_deg = 0;  ///< likewise, what pictures taken alike have in common
  std::string heap = {};  ///< pictures of one name are of one heap; empty: of a heap of its own
};

/// By its name in JSON: "flagged"; of any other name, refused.
vision::MeasureStatus picture_status_named(std::string_view name);

SetPicture set_picture_of(const vision::ReposeAngle& measured, const std::string& heap = {});

/// A picture that is far from the others of its set.
struct OutlyingPicture {
  std::size_t place = 0;  ///< among the set's pictures
  double score = 0;       ///< distance from the median, by the scatter of the others
  bool is_counted = false;
};

/// A heap of a set by its pictures.
struct HeapOfSet {
  std::string name;  ///< empty: of a picture that names none
  int pictures = 0;
  double angle_deg = 0;              ///< their mean
  std::optional<double> sd_deg;      ///< of single pictures; needs two
  std::optional<double> within_deg;  ///< half-width of the mean's 95 % interval; see PictureSet
};

struct PictureSet {
  /// Heaps, each with the mean of its pictures: all that could be measured, but for flagged ones
  /// that are outliers. None where there are none.
  std::optional<Summary> heaps_deg;
  std::optional<Summary> all_deg;  ///< heaps of all that could be measured
  std::optional<Summary> ok_deg;   ///< heaps of those with the status ok
  std::vector<HeapOfSet> heaps;    ///< that heaps_deg is of
  int pictures = 0;                ///< that heaps_deg is of
  int flagged = 0;                 ///< of these
  int refused = 0;                 ///< or without an angle by the definition
  /// Of pictures of one heap, pooled over the heaps; none where each has one picture.
  std::optional<double> within_sd_deg;
  /// Of the heaps themselves, without what their pictures scatter by; needs two heaps, and one of
  /// them several pictures.
  std::optional<double> between_sd_deg;
  /// Half-widths of 95 % intervals: of a heap's mean by its own pictures, in the root mean square,
  /// and of the mean of all by the camera.
  double own_deg = 0;
  double camera_deg = 0;
  double median_deg = 0;                  ///< of all pictures that could be measured
  std::vector<OutlyingPicture> outliers;  ///< in the order of the pictures
};

/// Outliers are those whose modified z-score is above 3.5,
///
///     M = |x - m| / max(1.4826 MAD, u)
///
///     m    median of the pictures' angles      MAD  median of |x - m|
///     u    median of their own standard uncertainties, which alike pictures scatter by at least
///
/// of three pictures or more. Source: Iglewicz and Hoaglin (1993), How to Detect and Handle
/// Outliers, ASQC Basic References in Quality Control 16, where M is .6745 (x - m) / MAD and u is
/// not. An outlier that is flagged is left out of the mean: the picture itself says that something
/// is wrong with it, and the others, what. One that is ok counts. Simulated views have no wrong
/// objects, and are means of all (heap_angle.h). Fully correlated errors have the mean of their
/// uncertainties: JCGM 100:2008 (GUM), 5.2.2, note 1.
///
/// A heap's angle is the mean over the sides it is seen from. What its pictures scatter by is taken
/// to be alike for all heaps and pooled, after JCGM 100:2008 (GUM), H.5.2:
///
///     w^2 = sum (x - x_k)^2 / f          f = sum (m_k - 1)
///     a heap's half-width = t(.975; f) w / sqrt(m_k) + camera, no less than by its pictures' own
///     b^2 = s^2 - w^2 mean(1 / m_k)      at least 0
///
///     x_k, m_k  mean and number of a heap's pictures      s  standard deviation of the x_k
///     w, b      standard deviations within and between heaps
///
/// The camera's part is added, as to a picture's own. Proved by PictureSet.* in tests/calibrate.
PictureSet set_of_pictures(std::span<const SetPicture> pictures);

/// "51.20° is an outlier: the median of these 4 pictures is 22.45°, ...".
std::string text_of(const OutlyingPicture& outlier, const PictureSet& set, double angle_deg);

}  // namespace repose::calibrate
