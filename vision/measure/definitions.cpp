#include "vision/measure/definitions.h"

#include <cmath>

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

}  // namespace

std::vector<NamedAngle> other_definitions(const Reading& reading) {
  double base = 0;
  double half_height = 0;
  double chord = 0;
  int sides = 0;
  for (const Side side : {Side::left, Side::right}) {
    if (reading.flank(side).status != FlankStatus::ok) continue;
    const FlankFit middle = refit(reading, side, 0.4, 0.6);
    const FlankFit whole = refit(reading, side, 0.0, 1.0);
    if (middle.status != FlankStatus::ok || whole.status != FlankStatus::ok) return {};
    base += std::atan2(reading.profile.crest_height, run_of(reading.profile, side));
    half_height += std::atan(-middle.least_squares.slope);
    chord += std::atan(-whole.least_squares.slope);
    ++sides;
  }
  if (sides == 0) return {};
  return {{"height_over_base", "crest height over the base's half width (cone; ISO 4324)",
           base / sides},
          {"half_height_tangent", "least-squares tangent at 40-60 % of the height",
           half_height / sides},
          {"whole_flank", "least-squares line from toe to crest", chord / sides}};
}

}  // namespace repose::vision
