#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/input_error.h"
#include "calibrate/report/chapters.h"
#include "calibrate/report/document.h"
#include "calibrate/report/wording.h"
#include "calibrate/statistics/regress/regression.h"

namespace repose::calibrate::report {
namespace {

/// Of a heap.
const std::array<std::string, 3> kCoefficients = {"restitution", "sliding_friction",
                                                  "rolling_friction"};

Chapter paper_answer(const PublishedResult& published, const HeapPictures& pictures) {
  Chapter chapter{.id = "answer", .title = "The answer", .blocks = {}};
  const PublishedVerification& verification = published.verification;
  chapter.blocks.push_back(Paragraph{fmt::format(
      "Calibrated by the published method, one coefficient after the other: point estimates "
      "without "
      "intervals. They give a heap angle of {}° (sd {}°); measured {}°.",
      shown(verification.mean_deg), shown(verification.sd_deg), shown(verification.measured_deg))});
  Table table{.name = "coefficients",
              .title = "Contact coefficients",
              .data = {.columns = {{.name = "coefficient", .unit = {}},
                                   {.name = "value", .unit = {}, .decimals = 4}},
                       .rows = {}}};
  for (const auto& [name, value] : published.values) {
    table.data.add({label_of(name), cell(value)});
  }
  chapter.blocks.push_back(std::move(table));
  PictureRow row = heaps_side_by_side(pictures);
  if (!row.pictures.empty()) chapter.blocks.push_back(std::move(row));
  chapter.blocks.push_back(Remark{
      "This method does not show what the measurements determine, or how well. repose calibrate "
      "--method joint does."});
  return chapter;
}

/// A parabola through runs of one factor; std::nullopt if they are too few or too similar.
std::optional<Regression> regression_of(const std::string& name, const std::vector<Factor>& factors,
                                        const std::vector<std::vector<double>>& levels,
                                        const std::vector<double>& responses) {
  try {
    return regress({.name = name,
                    .factors = factors,
                    .levels = levels,
                    .response_name = name,
                    .responses = responses},
                   SurfaceModel::quadratic);
  } catch (const base::InputError&) {
    return std::nullopt;
  }
}

Chart sweep_chart(const PublishedSweep& sweep) {
  const std::string label = label_of(sweep.parameter);
  const std::vector<double>&levels = sweep.levels, &results = sweep.results;
  Chart chart = plane_chart(
      "sweep_" + sweep.parameter, "Sweep of " + label, {.name = label, .unit = {}},
      {.name = axis_of_observable(sweep.observable, unit_of_experiment(sweep.observable)),
       .unit = {}});
  for (std::size_t k = 0; k < levels.size(); ++k) {
    add_point(chart, "simulated runs", Look::runs, cell(levels[k]), cell(results[k]));
  }
  const auto [low, high] = std::minmax_element(levels.begin(), levels.end());
  const Factor factor{.name = "level", .low = *low, .high = *high};
  if (const auto parabola = regression_of("sweep", {factor}, {levels}, results)) {
    constexpr int kPoints = 41;
    for (int k = 0; k < kPoints; ++k) {
      const double coded = -1 + 2.0 * k / (kPoints - 1);
      add_point(chart, "parabola", Look::fit, factor.natural(coded),
                parabola->predicted(std::array{coded}));
    }
  }
  add_level(chart, "measured", Look::measured, {*low, *high}, sweep.measured, sweep.measured,
            sweep.measured);
  add_point(chart, "found", Look::best, cell(sweep.value), sweep.measured);
  chart.caption =
      fmt::format("Solved for the measured value: {} (R² {}){}", shown(sweep.value),
                  shown(sweep.r2, 3), sweep.is_reached ? "." : "; the parabola does not reach it.");
  return chart;
}

Chapter sweeps_chapter(const PublishedResult& published) {
  Chapter chapter{.id = "sweeps", .title = "Particle–wall sweeps", .blocks = {}};
  ChartRow row;
  for (const PublishedSweep& sweep : published.sweeps) {
    row.charts.push_back(sweep_chart(sweep));
  }
  if (!row.charts.empty()) chapter.blocks.push_back(std::move(row));
  return chapter;
}

Table heaps_table(const std::vector<PublishedHeap>& heaps, const std::string& name,
                  const std::string& title) {
  Table table{.name = name, .title = title, .data = {}};
  table.data.columns = {{.name = "heap", .unit = {}, .decimals = 0}};
  for (const std::string& coefficient : kCoefficients) {
    table.data.columns.push_back({.name = label_of(coefficient), .unit = {}});
  }
  table.data.columns.push_back({.name = "angle", .unit = "°", .decimals = 2});
  table.data.columns.push_back({.name = "error", .unit = "%", .decimals = 2});
  double number = 0;
  for (const PublishedHeap& heap : heaps) {
    std::vector<Cell> row = {++number};
    for (const double coefficient : heap.coefficients) row.push_back(cell(coefficient));
    row.push_back(cell(heap.angle_deg));
    row.push_back(cell(heap.error_percent));
    table.data.add(std::move(row));
  }
  return table;
}

Chart heaps_chart(double measured_deg, const std::vector<PublishedHeap>& heaps,
                  const std::string& name, const std::string& title, Look look) {
  Chart chart = plane_chart(name, title, {.name = "heap", .unit = {}},
                            {.name = "angle of repose", .unit = "°"});
  chart.has_whole_x = true;
  for (std::size_t k = 0; k < heaps.size(); ++k) {
    if (const auto angle = heaps[k].angle_deg) {
      add_point(chart, "simulated", look, static_cast<double>(k + 1), *angle);
    }
  }
  add_level(chart, "measured", Look::measured,
            {1, static_cast<double>(std::max<std::size_t>(heaps.size(), 2))}, measured_deg,
            measured_deg, measured_deg);
  chart.caption = "Each marker is one heap.";
  return chart;
}

Chapter grains_chapter(const PublishedResult& published) {
  Chapter chapter{.id = "grains", .title = "Particle–particle coefficients", .blocks = {}};
  struct Stage {
    const char* name = nullptr;
    const char* title = nullptr;
    Look look = Look::points;  ///< points are joined for steps, not for others
    const std::vector<PublishedHeap>* heaps = nullptr;
  };
  const std::array<Stage, 3> stages = {
      {{"steepest_ascent", "Steepest ascent", Look::points, &published.steepest_ascent},
       {"composite", "Central composite design", Look::dots, &published.composite},
       {"verification", "Verification of the result", Look::dots, &published.verification.heaps}}};
  for (const Stage& stage : stages) {
    if (stage.heaps->empty()) continue;
    chapter.blocks.push_back(Heading{stage.title});
    chapter.blocks.push_back(
        ChartRow{{heaps_chart(published.verification.measured_deg, *stage.heaps,
                              std::string("chart_") + stage.name, stage.title, stage.look)}});
    chapter.blocks.push_back(heaps_table(*stage.heaps, stage.name, ""));
  }
  chapter.blocks.push_back(Heading{"Error surface"});
  add_regression(published.error_surface, "composite", chapter.blocks);
  chapter.blocks.push_back(
      Paragraph{fmt::format("Minimum of the error surface within the design's box: {} %.",
                            shown(published.least_error_percent))});
  return chapter;
}

}  // namespace

std::vector<Chapter> paper_chapters(const PublishedResult& published,
                                    const HeapPictures& pictures) {
  return {paper_answer(published, pictures), heap_chapter(pictures), sweeps_chapter(published),
          grains_chapter(published)};
}

}  // namespace repose::calibrate::report
