#include "vision/measure/definitions.h"

#include <cmath>
#include <optional>
#include <string>

#include "base/angle_definition.h"

namespace repose::vision {
namespace {

/// Distance along the ground from the crest to the foot of a side.
double run_of(const Profile& profile, Side side) {
  const double crest = profile.along[profile.crest];
  return side == Side::left ? crest - profile.along.front() : profile.along.back() - crest;
}

bool has_side(const FittedEdge& edge, Side side) {
  return (side == Side::left ? edge.left : edge.right).status == FlankStatus::ok;
}

FlankFit refit(const FittedEdge& edge, Side side, double from, double to) {
  return fit_flank(edge.profile, side, {from, to, false, edge.grain, 1});
}

/// Mean over the sides of the least-squares angle of another window; empty where a side has none.
std::optional<double> window_angle(const FittedEdge& edge, double from, double to) {
  double sum = 0;
  int sides = 0;
  for (const Side side : {Side::left, Side::right}) {
    if (!has_side(edge, side)) continue;
    const FlankFit other = refit(edge, side, from, to);
    if (other.status != FlankStatus::ok) return std::nullopt;
    sum += std::atan(-other.least_squares.slope);
    ++sides;
  }
  return sides > 0 ? std::optional(sum / sides) : std::nullopt;
}

/// Mean over the sides of crest height over half base.
std::optional<double> cone_angle(const FittedEdge& edge) {
  double sum = 0;
  int sides = 0;
  for (const Side side : {Side::left, Side::right}) {
    if (!has_side(edge, side)) continue;
    sum += std::atan2(edge.profile.crest_height, run_of(edge.profile, side));
    ++sides;
  }
  return sides > 0 ? std::optional(sum / sides) : std::nullopt;
}

}  // namespace

std::vector<NamedAngle> other_definitions(const FittedEdge& edge) {
  std::vector<NamedAngle> all;
  const auto add = [&](const char* name, std::optional<double> angle_rad) {
    const base::AngleDefinition* known = base::find_definition(name);
    if (angle_rad) all.push_back({name, std::string(known->description), *angle_rad});
  };
  add("height_over_base", cone_angle(edge));
  add("half_height_tangent", window_angle(edge, 0.4, 0.6));
  add("inner_window", window_angle(edge, 0.3, 0.7));
  add("outer_window", window_angle(edge, 0.1, 0.9));
  add("whole_flank", window_angle(edge, 0.0, 1.0));
  return all;
}

std::vector<NamedAngle> other_definitions(const Reading& reading) {
  return other_definitions(FittedEdge{.profile = reading.profile,
                                      .left = reading.left,
                                      .right = reading.right,
                                      .grain = reading.grain});
}

}  // namespace repose::vision
