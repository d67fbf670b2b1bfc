#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "vision/compare/heap_comparison.h"

/// Compares two sets of heaps, such as measured and simulated ones: their mean angles and mean
/// outlines. The verdict is about the grains, not about single heaps: the interval includes the
/// scatter between heaps of one kind.
///
/// Differences are the first set minus the second. Outlines are aligned by their axes, as described
/// in vision/compare/heap_comparison.h.

namespace repose::vision {

/// One heap, seen in one picture or in several from around it.
struct SeenHeap {
  std::vector<ReposeAngle> views;
  std::optional<double> m_per_px;  ///< the same in all its views
};

/// Outlines of a set, at positions common to both sets.
struct MeanOutline {
  std::vector<OutlinePoint> mean;  ///< of the heaps, each the mean of its views
  /// 80 % of the pictures lie between these at each position; empty for a single picture.
  std::vector<OutlinePoint> low, high;
  int pictures = 0;
};

/// A set of heaps. A heap's angle is the mean over its views with an angle; it has none if those
/// are less than half of its views.
struct SetOfHeaps {
  std::vector<std::optional<double>> angle_rad;  ///< of each heap
  int counted = 0;                               ///< heaps with an angle
  std::optional<double> mean_rad;
  std::optional<double> sd_rad;           ///< of single heaps; needs at least two
  std::optional<double> uncertainty_rad;  ///< half-width of the mean's 95 % interval (Student)
  MeanOutline outline;
};

struct SetComparison {
  std::array<SetOfHeaps, 2> sets;
  /// std::nullopt if a set has no angle, or both have only one.
  std::optional<AngleDifference> angle;
  /// If the verdict is cannot_tell: heaps needed in each set to decide, if the difference and the
  /// scatter stay the same.
  std::optional<int> heaps_to_tell;

  LengthUnit unit = LengthUnit::root_area;
  std::optional<double> iou;           ///< of the mean outlines, 0 to 1
  std::optional<double> profile_rmse;  ///< of their heights, over the wider base, in `unit`
  std::optional<double> profile_mean;  ///< ... mean difference; std::nullopt if areas were made
                                       ///< equal
  std::vector<Warning> warnings;
};

/// Difference of the means of two sets of heaps.
///
///     d = m1 - m2,   half-width = t(.975; f) sqrt(s1^2 / n1 + s2^2 / n2)
///
///     m, s, n  mean, standard deviation and number of a set's heaps
///     f        Welch and Satterthwaite's degrees of freedom
///
/// A set of one heap has no s of its own: that of the other set is used for both, with its n - 1
/// degrees of freedom. Source: Welch (1947), Biometrika 34, 28. Verdict as in AngleDifference.
/// Errors common to all pictures of a set (lens, camera, definition) are not in the scatter of its
/// heaps. Proved by tests/vision/compare_sets_test.cpp.
/// @throws base::InputError  the margin is not above 0, a set has no heaps, or a heap no views.
SetComparison compare_sets(const std::vector<SeenHeap>& first, const std::vector<SeenHeap>& second,
                           double margin_rad);

}  // namespace repose::vision
