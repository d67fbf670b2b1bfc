#pragma once

#include <optional>
#include <span>

/// Several pictures of the same thing: their mean, scatter, and how sure the mean is.
namespace repose::calibrate {

/// All in the unit of the values.
struct Summary {
  int n = 0;
  double mean = 0;
  /// Sample standard deviation, divided by n - 1; a single value has none.
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
/// @throws base::InputError  there is no value.
Summary summarise(std::span<const double> values);

}  // namespace repose::calibrate
