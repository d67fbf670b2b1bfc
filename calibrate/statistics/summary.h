#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

/// Several readings of the same thing: their mean, scatter, the uncertainty of the mean, and
/// outliers.
namespace repose::calibrate {

/// All in the unit of the values.
struct Summary {
  int n = 0;
  double mean = 0;
  /// Sample standard deviation, divided by n - 1; undefined for a single value.
  std::optional<double> sd;
  /// Half-width of the 95 % interval of the mean.
  std::optional<double> mean_uncertainty;
};

/// Mean, standard deviation and Student's interval of independent values from one normal
/// distribution.
///
///     half-width = t(0.975; n - 1) s / sqrt(n)
///
/// Source: JCGM 100:2008 (GUM), 4.2.1 to 4.2.3 and G.3.2. Checked by
/// tests/calibrate/summary_test.cpp.
/// @throws base::InputError  there are no values.
Summary summarise(std::span<const double> values);

/// Indices of outliers, in ascending order: the generalised extreme Studentised deviate test of
/// Rosner (1983, Technometrics 25, 165). The i-th step removes the value farthest from the mean of
/// those left; the last one whose distance, in standard deviations of those left, is more than
///
///     lambda_i = (n - i) t / sqrt((n - i - 1 + t^2)(n - i + 1)),
///
/// t the quantile 1 - alpha / 2(n - i + 1) of Student's distribution with n - i - 1 degrees of
/// freedom, and all before it, are outliers. At most a third of the values are, and at most 20. For
/// normal values it finds any in a fraction `alpha` of all samples; the approximation is good from
/// 15 values on, and fewer than 5 have none. Checked by tests/calibrate/summary_test.cpp on
/// Rosner's own example.
std::vector<std::size_t> outliers_of(std::span<const double> values, double alpha);

}  // namespace repose::calibrate
