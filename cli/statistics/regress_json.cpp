#include "cli/statistics/regress_json.h"

#include <nlohmann/json.hpp>

namespace repose::cli {
namespace {

using Json = nlohmann::ordered_json;

Json number(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json variance_json(const calibrate::Variance& variance) {
  return {{"sum_of_squares", variance.sum_of_squares},
          {"df", variance.df},
          {"mean_square", variance.df > 0 ? Json(variance.mean_square()) : Json(nullptr)},
          {"f", number(variance.f)},
          {"p", number(variance.p)}};
}

Json variance_json(const std::optional<calibrate::Variance>& variance) {
  return variance ? variance_json(*variance) : Json(nullptr);
}

Json factors_json(const calibrate::Regression& fit) {
  Json factors = Json::array();
  for (std::size_t i = 0; i < fit.factors.size(); ++i) {
    const calibrate::Factor& factor = fit.factors[i];
    factors.push_back({{"name", factor.name},
                       {"coded_minus_1", factor.low},
                       {"coded_plus_1", factor.high},
                       {"box", {factor.natural(fit.box[i][0]), factor.natural(fit.box[i][1])}},
                       {"all_terms", variance_json(fit.of_factor[i])}});
  }
  return factors;
}

Json coefficients_json(const calibrate::Regression& fit) {
  Json coefficients = Json::array();
  for (const calibrate::Coefficient& coefficient : fit.coefficients) {
    coefficients.push_back({{"term", name_of(coefficient.term, fit.factors)},
                            {"value", coefficient.value},
                            {"standard_error", coefficient.standard_error},
                            {"t", number(coefficient.t)},
                            {"p", number(coefficient.p)},
                            {"interval", coefficient.interval},
                            {"partial_sum_of_squares", coefficient.partial.sum_of_squares},
                            {"natural", coefficient.natural}});
  }
  return coefficients;
}

Json levels_json(const calibrate::Regression& fit, const std::vector<double>& levels) {
  Json json;
  for (std::size_t i = 0; i < levels.size(); ++i) json[fit.factors[i].name] = levels[i];
  return json;
}

Json point_json(const calibrate::Regression& fit, const calibrate::SurfacePoint& point) {
  return {{"levels", levels_json(fit, point.natural)},
          {"coded", levels_json(fit, point.coded)},
          {"value", point.value},
          {"uncertainty", point.uncertainty}};
}

Json canonical_json(const SurfaceReport& report) {
  if (!report.form) return nullptr;
  Json axes = Json::array();
  for (const calibrate::CanonicalAxis& axis : report.form->axes) {
    axes.push_back({{"curvature", axis.curvature},
                    {"uncertainty", axis.uncertainty},
                    {"direction", levels_json(report.fit, axis.direction)}});
  }
  return {
      {"shape", name_of(report.form->shape)},
      {"stationary_point",
       report.form->stationary ? point_json(report.fit, *report.form->stationary) : Json(nullptr)},
      {"inside_box", report.form->is_inside},
      {"axes", std::move(axes)}};
}

Json crossings_json(const calibrate::Regression& fit,
                    const std::vector<calibrate::Crossing>& crossings) {
  Json json = Json::array();
  for (const calibrate::Crossing& crossing : crossings) {
    json.push_back({{"along", fit.factors[crossing.factor].name},
                    {"levels", levels_json(fit, crossing.point.natural)},
                    {"uncertainty", number(crossing.natural_uncertainty)}});
  }
  return json;
}

Json target_json(const SurfaceReport& report) {
  if (!report.target) return nullptr;
  const calibrate::Regression& fit = report.fit;
  Json ranges = Json::object();
  for (std::size_t i = 0; i < report.target->ranges.size(); ++i) {
    Json intervals = Json::array();
    for (const auto& [low, high] : report.target->ranges[i]) {
      intervals.push_back({fit.factors[i].natural(low), fit.factors[i].natural(high)});
    }
    ranges[fit.factors[i].name] = std::move(intervals);
  }
  return {{"value", report.target->target},
          {"reached", report.target->is_reached},
          {"ranges", std::move(ranges)},
          {"through_centre", crossings_json(fit, report.target->through_centre)},
          {"points", crossings_json(fit, report.target->grid)}};
}

Json runs_json(const calibrate::Regression& fit) {
  Json runs = Json::array();
  for (const calibrate::FittedRun& run : fit.runs) {
    runs.push_back({{"coded", run.coded},
                    {"response", run.response},
                    {"fitted", run.fitted},
                    {"residual", run.response - run.fitted},
                    {"leverage", run.leverage}});
  }
  return runs;
}

}  // namespace

std::string regress_json(const SurfaceReport& report) {
  const calibrate::Regression& fit = report.fit;
  Json warnings = Json::array();
  for (const calibrate::SurfaceDiagnostic& diagnostic : report.diagnostics) {
    warnings.push_back({{"code", diagnostic.code}, {"message", diagnostic.message}});
  }
  const Json json{{"response", fit.response_name},
                  {"model", name_of(fit.model)},
                  {"factors", factors_json(fit)},
                  {"coefficients", coefficients_json(fit)},
                  {"anova",
                   {{"model", variance_json(fit.explained)},
                    {"residual", variance_json(fit.residual)},
                    {"lack_of_fit", variance_json(fit.lack_of_fit)},
                    {"pure_error", variance_json(fit.pure_error)},
                    {"total", variance_json(fit.total)}}},
                  {"residual_sd", fit.residual_sd},
                  {"r2", fit.r2},
                  {"r2_adjusted", fit.r2_adjusted},
                  {"r2_predicted", number(fit.r2_predicted)},
                  {"press", number(fit.press)},
                  {"canonical", canonical_json(report)},
                  {"lowest_in_box", point_json(fit, report.extremes.least)},
                  {"highest_in_box", point_json(fit, report.extremes.greatest)},
                  {"target", target_json(report)},
                  {"runs", runs_json(fit)},
                  {"warnings", std::move(warnings)}};
  constexpr int kIndent = 2;
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace repose::cli
