#pragma once

#include "calibrate/experiment/json_fields.h"
#include "calibrate/result/surface_summary.h"

/// Names of a fitted surface's fields in files.
namespace repose::calibrate {

inline constexpr const auto& names_for(SurfaceModel) { return kSurfaceModelNames; }
inline constexpr const auto& names_for(SurfaceShape) { return kSurfaceShapeNames; }

template <typename Io>
void fields(Io& io, Held<Io, Variance>& variance) {
  io("sum_of_squares", variance.sum_of_squares);
  io("df", variance.df);
  io.derived("mean_square", variance.df > 0 ? std::optional(variance.mean_square()) : std::nullopt);
  io("f", variance.f);
  io("p", variance.p);
}

template <typename Io>
void fields(Io& io, Held<Io, SurfaceFactor>& factor) {
  io("name", factor.name);
  io("coded_minus_1", factor.low);
  io("coded_plus_1", factor.high);
  io("box", factor.box);
  io("all_terms", factor.all_terms);
}

template <typename Io>
void fields(Io& io, Held<Io, SurfaceTerm>& term) {
  io("term", term.term);
  io("value", term.value);
  io("standard_error", term.standard_error);
  io("t", term.t);
  io("p", term.p);
  io("interval", term.interval);
  io("partial_sum_of_squares", term.partial_sum_of_squares);
  io("natural", term.natural);
}

template <typename Io>
void fields(Io& io, Held<Io, BlockEffect>& effect) {
  io("block", effect.label);
  io("runs", effect.runs);
  io("value", effect.value);
  io("standard_error", effect.standard_error);
}

template <typename Io>
void fields(Io& io, Held<Io, SurfaceBlocks>& blocks) {
  io("column", blocks.column);
  io("effects", blocks.effects);
}

template <typename Io>
void fields(Io& io, Held<Io, SurfaceVariances>& anova) {
  if (io.has("blocks", anova.blocks.has_value())) io("blocks", anova.blocks);
  io("model", anova.model);
  io("residual", anova.residual);
  io("lack_of_fit", anova.lack_of_fit);
  io("pure_error", anova.pure_error);
  io("total", anova.total);
}

template <typename Io>
void fields(Io& io, Held<Io, SurfacePoint>& point) {
  by_name(io, "levels", io.names().factors, point.natural);
  by_name(io, "coded", io.names().factors, point.coded);
  io("value", point.value);
  io("uncertainty", point.uncertainty);
}

template <typename Io>
void fields(Io& io, Held<Io, CanonicalAxis>& axis) {
  io("curvature", axis.curvature);
  io("uncertainty", axis.uncertainty);
  by_name(io, "direction", io.names().factors, axis.direction);
}

template <typename Io>
void fields(Io& io, Held<Io, StationaryRegion>& region) {
  io("in_box", region.is_in_box);
  if (io.has("extent", region.is_in_box)) {
    by_name(io, "extent", io.names().factors, region.ranges);
  }
}

template <typename Io>
void fields(Io& io, Held<Io, CanonicalForm>& form) {
  io("shape", form.shape);
  io("stationary_point", form.stationary);
  io("inside_box", form.is_inside);
  io("stationary_region", form.region);
  io("axes", form.axes);
}

template <typename Io>
void fields(Io& io, Held<Io, SurfaceCrossing>& crossing) {
  io.place("along", io.names().factors, crossing.factor);
  by_name(io, "levels", io.names().factors, crossing.levels);
  io("interval", crossing.interval);
}

template <typename Io>
void fields(Io& io, Held<Io, SurfaceTarget>& target) {
  io("value", target.value);
  io("uncertainty", target.uncertainty);
  io("reached", target.is_reached);
  // If the surface does not reach the target: an empty object.
  const std::vector<std::string> none;
  by_name(io, "ranges", target.is_reached ? io.names().factors : none, target.ranges);
  io("through_centre", target.through_centre);
  io("points", target.points);
}

template <typename Io>
void fields(Io& io, Held<Io, FittedRun>& run) {
  io("coded", run.coded);
  io("response", run.response);
  io("fitted", run.fitted);
  io.derived("residual", run.response - run.fitted);
  io("leverage", run.leverage);
  if (io.has("block", !run.block.empty())) io("block", run.block);
}

template <typename Io>
void fields(Io& io, Held<Io, SurfaceDiagnostic>& diagnostic) {
  io("code", diagnostic.code);
  io("message", diagnostic.message);
}

template <typename Io>
void fields(Io& io, Held<Io, LeftOut>& left_out) {
  io("what", left_out.what);
  io("why", left_out.why);
}

template <typename Io>
void fields(Io& io, Held<Io, SurfaceSummary>& surface) {
  io("response", surface.response);
  io("model", surface.model);
  io("factors", surface.factors);
  io.names().factors.clear();
  for (const SurfaceFactor& factor : surface.factors) io.names().factors.push_back(factor.name);
  io("coefficients", surface.coefficients);
  if (io.has("blocks", surface.blocks.has_value())) io("blocks", surface.blocks);
  io("anova", surface.anova);
  io("residual_sd", surface.residual_sd);
  io("r2", surface.r2);
  io("r2_adjusted", surface.r2_adjusted);
  io("r2_predicted", surface.r2_predicted);
  io("press", surface.press);
  io("canonical", surface.canonical);
  io("lowest_in_box", surface.extremes.least);
  io("highest_in_box", surface.extremes.greatest);
  io("target", surface.target);
  if (io.has("runs", !surface.runs.empty())) io("runs", surface.runs);
  io("warnings", surface.warnings);
  if (io.has("left_out", !surface.left_out.empty())) io("left_out", surface.left_out);
  if (io.has("notes", !surface.notes.empty())) io("notes", surface.notes);
}

}  // namespace repose::calibrate
