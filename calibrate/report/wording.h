#pragma once

#include <limits>
#include <optional>
#include <string>

#include "calibrate/report/document.h"
#include "calibrate/result/result.h"

/// How a report writes numbers and names.
namespace repose::calibrate::report {

/// Four significant digits, or the given number of decimals; "–" for std::nullopt and non-finite
/// values.
std::string shown(std::optional<double> value, std::optional<int> decimals = std::nullopt);
std::string shown(const Cell& cell, const Column& column);

/// Cuts out the middle of texts longer than `most` characters. UTF-8 characters stay whole.
std::string shortened(const std::string& text, std::size_t most = 80);

/// "restitution, particle–wall" for "contact.particle_wall.restitution"; other names unchanged.
std::string label_of(const std::string& parameter);

/// "tube diameter" for "tube_diameter".
std::string spaced(std::string name);

/// "mm" for "drop"; empty for unknown names.
std::string unit_of_experiment(const std::string& name);

/// "°" for "deg".
std::string unit_shown(const std::string& unit);

/// "rebound height [mm]" for an observable called "drop" in mm.
std::string axis_of_observable(const std::string& name, const std::string& unit);

/// Whether the study has heaps at all.
bool has_heap(const StudyResult& result);

/// With a capital letter.
std::string titled(std::string text);

/// label_of() with a capital letter, unless it is a name of the user's own.
std::string title_of_parameter(const std::string& name);

/// A file name: letters, digits and _, not too long, without the "contact." of coefficients.
std::string file_stem(const std::string& text);

/// Half-width of the 95 % interval for a standard uncertainty with `df` degrees of freedom: the
/// meaning of ± on a page.
double half_width_95(double standard_uncertainty,
                     double df = std::numeric_limits<double>::infinity());

/// The nearest value that can physically be measured in this unit.
double readable(double value, const std::string& unit);

Cell cell(std::optional<double> value);
Cell cell(const std::string& text);

}  // namespace repose::calibrate::report
