#include "vision/measure/definitions.h"

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/angle_definition.h"

namespace repose::vision {
namespace {

constexpr std::array kSides{Side::left, Side::right};

/// The least-squares line of another window, with equal weights.
FlankFit window_fit(const FittedEdge& edge, Side side, const std::array<double, 2>& window) {
  FlankFit fit = fit_flank(edge.profile, side,
                           {.window_from = window[0],
                            .window_to = window[1],
                            .leave_apron_out = false,
                            .is_robust = false,
                            .grain = edge.grain});
  fit.window_spread_rad = 0;
  return fit;
}

/// The line from the crest to the foot; truncated if the frame hides the foot.
/// @param grain  as used for the default line
FlankFit chord_fit(const FittedEdge& edge, Side side, double grain) {
  const Profile& profile = edge.profile;
  FlankFit fit = window_fit(edge, side, {0, 1});
  if (fit.status != FlankStatus::ok) return fit;
  if (side == Side::left ? profile.leaves_frame_left : profile.leaves_frame_right) {
    fit.status = FlankStatus::truncated;
    return fit;
  }
  const double end = side == Side::left ? profile.along.front() : profile.along.back();
  const double run = std::abs(end - profile.along[profile.crest]);
  fit.shown = LineFit{.intercept = profile.crest_height,
                      .slope = -profile.crest_height / run,
                      .r2 = fit.least_squares.r2};
  fit.angle_rad = std::atan2(profile.crest_height, run);
  fit.fit_error_rad = grain / std::sqrt(12.0) * std::cos(fit.angle_rad) / run;
  fit.degrees_of_freedom = 1e6;  // known, not estimated
  return fit;
}

/// @param fit  function that fits a side
template <class Fit>
std::optional<DefinedFlanks> flanks_by(const base::AngleDefinition& definition,
                                       const FittedEdge& edge, Fit fit) {
  DefinedFlanks flanks;
  flanks.definition = &definition;
  bool is_any = false;
  for (const Side side : kSides) {
    const FlankFit& usual = side == Side::left ? edge.left : edge.right;
    FlankFit& mine = side == Side::left ? flanks.left : flanks.right;
    if (usual.status != FlankStatus::ok) {
      mine.status = usual.status;
      mine.reason = usual.reason;
      continue;
    }
    mine = fit(side);
    if (mine.status != FlankStatus::ok) return std::nullopt;
    is_any = true;
  }
  return is_any ? std::optional(std::move(flanks)) : std::nullopt;
}

}  // namespace

std::vector<DefinedFlanks> other_flanks(const FittedEdge& edge) {
  std::vector<DefinedFlanks> all;
  const auto add = [&](std::optional<DefinedFlanks> flanks) {
    if (flanks) all.push_back(std::move(*flanks));
  };
  for (const base::AngleDefinition& definition : base::kAngleDefinitions) {
    if (base::is_usual_definition(definition.name)) continue;
    const bool is_chord = definition.name == "height_over_base";
    add(flanks_by(definition, edge, [&](Side side) {
      const FlankFit& usual = side == Side::left ? edge.left : edge.right;
      return is_chord ? chord_fit(edge, side, usual.grain)
                      : window_fit(edge, side, definition.window);
    }));
  }
  return all;
}

std::vector<NamedAngle> other_definitions(const FittedEdge& edge) {
  std::vector<NamedAngle> all;
  for (const DefinedFlanks& flanks : other_flanks(edge)) {
    all.push_back({.name = std::string(flanks.definition->name),
                   .description = std::string(flanks.definition->description),
                   .angle_rad = flanks.angle_rad()});
  }
  return all;
}

}  // namespace repose::vision
