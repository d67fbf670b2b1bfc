#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "vision/compare/heap_comparison.h"

/// Two sets of heaps compared, such as the heaps of a bench and simulated ones: the mean of their
/// angles, and their mean outlines. The verdict is about the grains, not about single heaps: how
/// much heaps of one kind differ from each other is in its interval.
///
/// Differences are the first set minus the second. Outlines are aligned by their axes, as
/// vision/compare/heap_comparison.h says.

namespace repose::vision {

/// One heap, seen in a picture or in several from around it.
struct SeenHeap {
  std::vector<ReposeAngle> views;
  std::optional<double> m_per_px;  ///< the same in all its views
};

/// Outlines of a set, at places that are the same for both sets.
struct MeanOutline {
  std::vector<OutlinePoint> mean;  ///< of the heaps, each being the mean of its views
  /// Between these lie 80 % of the pictures at each place; empty for a single picture.
  std::vector<OutlinePoint> low, high;
  int pictures = 0;
};

/// A set of heaps. A heap's angle is the mean of its views that have one; it has none where that is
/// less than half of them.
struct SetOfHeaps {
  std::vector<std::optional<double>> angle_rad;  ///< of each heap
  int counted = 0;                               ///< heaps that have one
  std::optional<double> mean_rad;
  std::optional<double> sd_rad;           ///< of single heaps; needs two
  std::optional<double> uncertainty_rad;  ///< half-width of the mean's 95 % interval (Student)
  MeanOutline outline;
};

struct SetComparison {
  std::array<SetOfHeaps, 2> sets;
  /// Empty when a set has no angle, or both have but one.
  std::optional<AngleDifference> angle;
  /// Where the verdict is that one cannot tell: the heaps in each set that would decide it, if the
  /// difference stays as it is and heaps scatter as these do.
  std::optional<int> heaps_to_tell;

  LengthUnit unit = LengthUnit::root_area;
  std::optional<double> iou;           ///< of the mean outlines, 0 to 1
  std::optional<double> profile_rmse;  ///< of their heights, over the wider base, in `unit`
  std::optional<double> profile_mean;  ///< ... mean difference; empty when areas were made equal
  std::vector<Warning> warnings;
};

/// Difference of the means of two sets of heaps.
///
///     d = m1 - m2,   half-width = t(.975; f) sqrt(s1^2 / n1 + s2^2 / n2)
///
///     m, s, n  mean, standard deviation and number of a set's heaps
///     f        Welch and Satterthwaite's degrees of freedom
///
/// A set of one heap has no s of its own: that of the other set is taken for both, with its n - 1
/// degrees of freedom. Source: Welch (1947), Biometrika 34, 28. The verdict as of AngleDifference.
/// What all pictures of a set share (lens, camera, definition) is not in the scatter of its heaps.
/// Proved by tests/vision/compare_sets_test.cpp.
/// @throws base::InputError  the margin is not above 0, a set has no heap, or a heap no view.
SetComparison compare_sets(const std::vector<SeenHeap>& first, const std::vector<SeenHeap>& second,
                           double margin_rad);

}  // namespace repose::vision
