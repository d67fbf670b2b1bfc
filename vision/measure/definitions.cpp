#include "vision/measure/definitions.h"

#include <cmath>
#include <optional>

namespace repose::vision {
namespace {

/// Distance along the ground from the crest to the foot of a side.
double run_of(const Profile& profile, Side side) {
  const double crest = profile.along[profile.crest];
  return side == Side::left ? crest - profile.along.front() : profile.along.back() - crest;
}

FlankFit refit(const Reading& reading, Side side, double from, double to) {
  return fit_flank(reading.profile, side, {from, to, false, reading.grain, 1});
}

/// Mean over the sides of the least-squares angle of another window; empty where a side has none.
std::optional<double> window_angle(const Reading& reading, double from, double to) {
  double sum = 0;
  int sides = 0;
  for (const Side side : {Side::left, Side::right}) {
    if (reading.flank(side).status != FlankStatus::ok) continue;
    const FlankFit other = refit(reading, side, from, to);
    if (other.status != FlankStatus::ok) return std::nullopt;
    sum += std::atan(-other.least_squares.slope);
    ++sides;
  }
  return sides > 0 ? std::optional(sum / sides) : std::nullopt;
}

/// Mean over the sides of crest height over half base.
std::optional<double> cone_angle(const Reading& reading) {
  double sum = 0;
  int sides = 0;
  for (const Side side : {Side::left, Side::right}) {
    if (reading.flank(side).status != FlankStatus::ok) continue;
    sum += std::atan2(reading.profile.crest_height, run_of(reading.profile, side));
    ++sides;
  }
  return sides > 0 ? std::optional(sum / sides) : std::nullopt;
}

}  // namespace

std::vector<NamedAngle> other_definitions(const Reading& reading) {
  std::vector<NamedAngle> all;
  const auto add = [&](const char* name, const char* description, std::optional<double> angle_rad) {
    if (angle_rad) all.push_back({name, description, *angle_rad});
  };
  add("height_over_base", "crest height over the base's half width (cone; ISO 4324)",
      cone_angle(reading));
  add("half_height_tangent", "least-squares tangent at 40-60 % of the height",
      window_angle(reading, 0.4, 0.6));
  add("inner_window", "least-squares line at 30-70 % of the height",
      window_angle(reading, 0.3, 0.7));
  add("outer_window", "least-squares line at 10-90 % of the height",
      window_angle(reading, 0.1, 0.9));
  add("whole_flank", "least-squares line from toe to crest", window_angle(reading, 0.0, 1.0));
  return all;
}

}  // namespace repose::vision
