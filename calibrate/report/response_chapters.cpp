#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "calibrate/report/chapters.h"
#include "calibrate/report/document.h"
#include "calibrate/report/wording.h"

namespace repose::calibrate::report {
namespace {

constexpr const char* kRuns = "simulated runs";
constexpr const char* kCoarseRuns = "coarse runs (larger grains)";
constexpr const char* kMeasured = "measured, 95 %";
constexpr const char* kBest = "best fit";

void add_measured(Chart& chart, const MeasuredNumber& measured, std::array<double, 2> x_range) {
  if (!measured.measured) return;
  const double half = half_width_95(measured.uncertainty.value_or(0));
  add_level(chart, kMeasured, Look::measured, x_range, *measured.measured,
            readable(*measured.measured - half, measured.unit),
            readable(*measured.measured + half, measured.unit));
}

/// Returns the coefficient's range in the runs.
std::array<double, 2> add_runs(Chart& chart, const ReportedStudy& study,
                               const MeasuredNumber& measured, const std::string& parameter) {
  std::array<double, 2> span = {std::numeric_limits<double>::infinity(),
                                -std::numeric_limits<double>::infinity()};
  for (const SavedRun& run : study.runs) {
    if (run.experiment != measured.experiment || !run.failure.empty()) continue;
    const auto x = run.values.find(parameter);
    const auto y = run.readings.find(measured.reading);
    if (x == run.values.end() || y == run.readings.end()) continue;
    add_point(chart, run.is_coarse ? kCoarseRuns : kRuns, run.is_coarse ? Look::dots : Look::runs,
              x->second, readable(y->second, measured.unit));
    span = {std::min(span[0], x->second), std::max(span[1], x->second)};
  }
  return span;
}

Chart response_chart(const MeasuredNumber& measured, const std::string& parameter) {
  const std::string label = label_of(parameter);
  return plane_chart(
      "response_" + measured.name + '_' + parameter,
      fmt::format("{} against {}", titled(axis_of_observable(measured.name, "")), label),
      {.name = label, .unit = {}},
      {.name = axis_of_observable(measured.name, ""), .unit = unit_shown(measured.unit)});
}

Chart curve_chart(const ReportedStudy& study, const JointResult& joint,
                  const ResponseCurve& curve) {
  const MeasuredNumber& measured = study.measured[curve.observable];
  const ResultParameter& parameter = joint.parameters[curve.parameter];
  Chart chart = response_chart(measured, parameter.name);
  const std::vector<double>&x = curve.values, &fit = curve.simulated;
  const auto read = [&](double value) { return cell(readable(value, measured.unit)); };
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double half = half_width_95(curve.uncertainty[k]);
    add_point(chart, "95 % interval of the fit", Look::band, x[k], {}, read(fit[k] - half),
              read(fit[k] + half));
  }
  for (std::size_t k = 0; k < x.size(); ++k) {
    add_point(chart, "scatter of single runs: ±1 sd", Look::scatter, x[k], {},
              read(fit[k] - curve.scatter[k]), read(fit[k] + curve.scatter[k]));
  }
  add_runs(chart, study, measured, parameter.name);
  for (std::size_t k = 0; k < x.size(); ++k) {
    add_point(chart, "fit", Look::fit, x[k], read(fit[k]));
  }
  add_measured(chart, measured, {x.front(), x.back()});
  const Interval& interval = parameter.interval;
  add_point(chart, kBest, Look::best, cell(parameter.value),
            cell(joint.observables[curve.observable].simulated), cell(interval.low),
            cell(interval.high));
  chart.caption = fmt::format("Best at {}, 95 % interval {} … {}.", shown(parameter.value, 3),
                              shown(interval.low, 3), shown(interval.high, 3));
  return chart;
}

Chart surface_chart(const ReportedStudy& study, const JointResult& joint,
                    const ResponseSurface& surface) {
  const MeasuredNumber& measured = study.measured[surface.observable];
  const ResultParameter& along_x = joint.parameters[surface.x_parameter];
  const ResultParameter& along_y = joint.parameters[surface.y_parameter];
  const std::string &x_name = along_x.name, &y_name = along_y.name;
  const std::string what = axis_of_observable(measured.name, measured.unit);
  Chart chart{
      .name = file_stem("surface_" + measured.name + '_' + x_name + '_' + y_name),
      .kind = ChartKind::contour,
      .title = fmt::format("{} against {} and {}", titled(axis_of_observable(measured.name, "")),
                           label_of(x_name), label_of(y_name)),
      .caption = fmt::format("Contours of equal {}.", what),
      .x_title = label_of(x_name),
      .y_title = label_of(y_name),
      .z_title = what};
  chart.data.columns = {
      {.name = "series", .unit = {}},
      {.name = label_of(x_name), .unit = {}},
      {.name = label_of(y_name), .unit = {}},
      {.name = axis_of_observable(measured.name, ""), .unit = unit_shown(measured.unit)}};
  const std::vector<double>&x = surface.x, &y = surface.y;
  chart.layers.push_back({.series = "fit", .look = Look::grid});
  for (std::size_t row = 0; row < y.size(); ++row) {
    for (std::size_t column = 0; column < x.size(); ++column) {
      chart.data.add({std::string("fit"), cell(x[column]), cell(y[row]),
                      cell(readable(surface.simulated[row][column], measured.unit))});
    }
  }
  const auto add = [&](const std::string& series, Look look, const Cell& at_x, const Cell& at_y,
                       const Cell& z) {
    if (chart.layers.back().series != series) {
      chart.layers.push_back({.series = series, .look = look});
    }
    chart.data.add({series, at_x, at_y, z});
  };
  if (measured.measured) {
    const auto ridge = ridge_of(x, y, surface.simulated, *measured.measured);
    for (const auto& [at_x, at_y] : ridge) {
      add(fmt::format("as measured: {} {}", shown(measured.measured), unit_shown(measured.unit)),
          Look::ridge, at_x, at_y, *measured.measured);
    }
    chart.caption += ridge.empty() ? " The surface does not reach the measured value."
                                   : " The thick contour is the measured value.";
  }
  add(kBest, Look::best, cell(along_x.value), cell(along_y.value),
      cell(joint.observables[surface.observable].simulated));
  return chart;
}

}  // namespace

std::vector<Chart> run_charts(const ReportedStudy& study, const MeasuredNumber& measured) {
  std::vector<std::string> parameters;
  for (const SavedRun& run : study.runs) {
    if (run.experiment != measured.experiment) continue;
    for (const auto& [name, value] : run.values) parameters.push_back(name);
    break;
  }
  std::vector<Chart> charts;
  for (const std::string& parameter : parameters) {
    Chart chart = response_chart(measured, parameter);
    const auto span = add_runs(chart, study, measured, parameter);
    if (!(span[0] < span[1])) continue;
    add_measured(chart, measured, span);
    chart.caption = "Each circle is a run; the other coefficients vary too.";
    charts.push_back(std::move(chart));
  }
  return charts;
}

namespace {

constexpr const char* kCurvesText =
    "The line is the fit with the other coefficients at their best values, the band its "
    "uncertainty, "
    "the dotted lines the scatter of single runs; the dashed line is the bench measurement. "
    "Circles "
    "are the simulated runs, which lie off the line because each has its own values of the other "
    "coefficients.";

/// Change of an experiment's reading over a coefficient's bounds, in units of its uncertainty.
double effect_of(const JointResult& joint, const ResponseCurve& curve) {
  const auto [low, high] = std::minmax_element(curve.simulated.begin(), curve.simulated.end());
  const ResultObservable& observable = joint.observables[curve.observable];
  const double sigma =
      std::hypot(observable.measured_uncertainty, observable.simulated_uncertainty);
  return low == curve.simulated.end() ? 0 : (*high - *low) / sigma;
}

/// Whether this experiment responds most to the coefficient; among equals, the first.
bool is_telling(const JointResult& joint, const ResponseCurve& curve) {
  for (const ResponseCurve& other : joint.responses) {
    if (other.parameter != curve.parameter || &other == &curve) continue;
    const double here = effect_of(joint, curve), there = effect_of(joint, other);
    if (there > here || (there == here && &other < &curve)) return false;
  }
  return true;
}

}  // namespace

Chapter sensitivity_chapter(const ReportedStudy& study, const JointResult& joint) {
  Chapter chapter{.id = "telling", .title = "What determines each coefficient", .blocks = {}};
  ChartRow row;
  for (const ResponseCurve& curve : joint.responses) {
    if (is_telling(joint, curve)) row.charts.push_back(curve_chart(study, joint, curve));
  }
  if (row.charts.empty()) return chapter;
  chapter.blocks.push_back(
      Paragraph{std::string("For each coefficient, the experiment that is most sensitive to it. ") +
                kCurvesText});
  chapter.blocks.push_back(std::move(row));
  return chapter;
}

Chapter curves_chapter(const ReportedStudy& study, const JointResult& joint) {
  Chapter chapter{.id = "curves", .title = "Response curves", .blocks = {}};
  for (std::size_t k = 0; k < joint.observables.size(); ++k) {
    ChartRow row;
    for (const ResponseCurve& curve : joint.responses) {
      if (curve.observable != k || is_telling(joint, curve)) continue;
      row.charts.push_back(curve_chart(study, joint, curve));
    }
    if (row.charts.empty()) continue;
    chapter.blocks.push_back(Heading{titled(axis_of_observable(joint.observables[k].name, ""))});
    chapter.blocks.push_back(std::move(row));
  }
  if (chapter.blocks.empty()) return chapter;
  const Block lead = Paragraph{
      "The other curves, of every experiment against every coefficient that it depends on, drawn "
      "as "
      "above."};
  chapter.blocks.insert(chapter.blocks.begin(), lead);
  return chapter;
}

Chapter surfaces_chapter(const ReportedStudy& study, const JointResult& joint) {
  Chapter chapter{.id = "surfaces", .title = "Response surfaces", .blocks = {}};
  for (std::size_t k = 0; k < joint.observables.size(); ++k) {
    ChartRow row;
    for (const ResponseSurface& surface : joint.surfaces) {
      if (surface.observable == k) row.charts.push_back(surface_chart(study, joint, surface));
    }
    if (row.charts.empty()) continue;
    chapter.blocks.push_back(Heading{titled(axis_of_observable(joint.observables[k].name, ""))});
    chapter.blocks.push_back(std::move(row));
  }
  if (chapter.blocks.empty()) return chapter;
  const std::vector<Block> lead = {
      Paragraph{
          "The fitted response to two coefficients at a time, with the others at their best "
          "values. The thick black line is the ridge of solutions: every pair on it reproduces the "
          "measured value, so a single experiment cannot separate the two. Where the ridges of "
          "several experiments cross, the coefficients are determined."},
      SurfaceViewer{"One of the surfaces below; drag to rotate. The black dots mark the "
                    "measured value."}};
  chapter.blocks.insert(chapter.blocks.begin(), lead.begin(), lead.end());
  return chapter;
}

}  // namespace repose::calibrate::report
