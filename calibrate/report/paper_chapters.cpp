#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>

#include "calibrate/report/chapters.h"
#include "calibrate/report/figures.h"
#include "calibrate/report/wording.h"
#include "calibrate/statistics/regress/regression.h"

namespace repose::calibrate::report {
namespace {

/// Keys of a heap.
const std::array<std::string, 3> kCoefficients = {"restitution", "sliding_friction",
                                                  "rolling_friction"};

Chapter paper_answer(const StudyFolder& study, const HeapPictures& pictures) {
  Chapter chapter{.id = "answer", .title = "The answer", .blocks = {}};
  const JsonView verification = study.result["verification"];
  chapter.blocks.push_back(Paragraph{fmt::format(
      "Found the published way, one coefficient after the other: single points without intervals. "
      "With them the heap's angle is {}° (sd {}°); measured {}°.",
      shown(verification["mean_deg"].number()), shown(verification["sd_deg"].number()),
      shown(verification["measured_deg"].number()))});
  Table table{.name = "coefficients",
              .title = "Coefficients of contact",
              .data = {.columns = {{.name = "coefficient", .unit = {}},
                                   {.name = "value", .unit = {}, .decimals = 4}},
                       .rows = {}}};
  for (const auto& [name, value] : study.result["values"].members()) {
    table.data.add({label_of(name), cell(value.number())});
  }
  chapter.blocks.push_back(std::move(table));
  PictureRow row = heaps_side_by_side(pictures);
  if (!row.pictures.empty()) chapter.blocks.push_back(std::move(row));
  chapter.blocks.push_back(Remark{
      "What the measurements determine, and how well, this way does not say. repose calibrate "
      "--method joint does."});
  return chapter;
}

/// A parabola through runs of one factor; none where they are too few or too alike.
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
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

Chart sweep_chart(const JsonView& sweep) {
  const std::string parameter = sweep["parameter"].text(), observable = sweep["observable"].text();
  const std::string label = label_of(parameter);
  Chart chart = plane_chart(
      "sweep_" + parameter, "Sweep of " + label, {.name = label, .unit = {}},
      {.name = axis_of_observable(observable, unit_of_experiment(observable)), .unit = {}});
  const std::vector<double> levels = sweep["levels"].numbers(),
                            results = sweep["results"].numbers();
  for (std::size_t k = 0; k < std::min(levels.size(), results.size()); ++k) {
    add_point(chart, "simulated runs", Look::runs, cell(levels[k]), cell(results[k]));
  }
  if (levels.empty()) return chart;
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
  if (const auto measured = sweep["measured"].number()) {
    add_level(chart, "measured", Look::measured, {*low, *high}, *measured, *measured, *measured);
    add_point(chart, "found", Look::best, cell(sweep["value"].number()), *measured);
  }
  chart.caption =
      fmt::format("Solved for the measured value: {} (R² {}){}", shown(sweep["value"].number()),
                  shown(sweep["r2"].number(), 3),
                  sweep["reached"].is_true() ? "." : "; the parabola does not reach it.");
  return chart;
}

Chapter sweeps_chapter(const StudyFolder& study) {
  Chapter chapter{.id = "sweeps", .title = "Sweeps against the wall", .blocks = {}};
  ChartRow row;
  for (const JsonView& sweep : study.result["sweeps"].items()) {
    row.charts.push_back(sweep_chart(sweep));
  }
  if (!row.charts.empty()) chapter.blocks.push_back(std::move(row));
  return chapter;
}

Table heaps_table(const JsonView& heaps, const std::string& name, const std::string& title) {
  Table table{.name = name, .title = title, .data = {}};
  table.data.columns = {{.name = "heap", .unit = {}, .decimals = 0}};
  for (const std::string& coefficient : kCoefficients) {
    table.data.columns.push_back({.name = label_of(coefficient), .unit = {}});
  }
  table.data.columns.push_back({.name = "angle", .unit = "°", .decimals = 2});
  table.data.columns.push_back({.name = "error", .unit = "%", .decimals = 2});
  double number = 0;
  for (const JsonView& heap : heaps.items()) {
    std::vector<Cell> row = {++number};
    for (const std::string& coefficient : kCoefficients) {
      row.push_back(cell(heap[coefficient].number()));
    }
    row.push_back(cell(heap["angle_deg"].number()));
    row.push_back(cell(heap["error_percent"].number()));
    table.data.add(std::move(row));
  }
  return table;
}

Chart heaps_chart(const StudyFolder& study, const JsonView& heaps, const std::string& name,
                  const std::string& title, Look look) {
  Chart chart = plane_chart(name, title, {.name = "heap", .unit = {}},
                            {.name = "angle of repose", .unit = "°"});
  chart.has_whole_x = true;
  const auto all = heaps.items();
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (const auto angle = all[k]["angle_deg"].number()) {
      add_point(chart, "simulated", look, static_cast<double>(k + 1), *angle);
    }
  }
  if (const auto measured = study.result["verification"]["measured_deg"].number()) {
    add_level(chart, "measured", Look::measured,
              {1, static_cast<double>(std::max<std::size_t>(all.size(), 2))}, *measured, *measured,
              *measured);
  }
  chart.caption = "Each marker is one heap.";
  return chart;
}

Chapter grains_chapter(const StudyFolder& study) {
  Chapter chapter{.id = "grains", .title = "Between the grains", .blocks = {}};
  struct Stage {
    const char* name = nullptr;
    const char* title = nullptr;
    Look look = Look::points;  ///< steps follow each other, others do not
    JsonView heaps;
  };
  const std::array<Stage, 3> stages = {
      {{"steepest_ascent", "Steepest ascent", Look::points, study.result["steepest_ascent"]},
       {"composite", "Central composite design", Look::dots, study.result["composite"]},
       {"verification", "The result, simulated again", Look::dots,
        study.result["verification"]["heaps"]}}};
  for (const Stage& stage : stages) {
    if (stage.heaps.items().empty()) continue;
    chapter.blocks.push_back(Heading{stage.title});
    chapter.blocks.push_back(ChartRow{{heaps_chart(
        study, stage.heaps, std::string("chart_") + stage.name, stage.title, stage.look)}});
    chapter.blocks.push_back(heaps_table(stage.heaps, stage.name, ""));
  }
  if (const JsonView surface = study.result["error_surface"]; surface.exists()) {
    chapter.blocks.push_back(Heading{"Surface of the error"});
    add_regression(surface, "composite", chapter.blocks);
    chapter.blocks.push_back(
        Paragraph{fmt::format("Least error on the surface, in the design's box: {} %.",
                              shown(study.result["least_error_percent"].number()))});
  }
  return chapter;
}

}  // namespace

std::vector<Chapter> paper_chapters(const StudyFolder& study, const HeapPictures& pictures) {
  return {paper_answer(study, pictures), heap_chapter(pictures), sweeps_chapter(study),
          grains_chapter(study)};
}

}  // namespace repose::calibrate::report
