#include "tests/bench/outline_angles.h"

#include <algorithm>
#include <stdexcept>

#include "vision/measure/flank.h"
#include "vision/measure/geometry.h"
#include "vision/measure/profile.h"

namespace repose::bench {
namespace {

/// As vision's upper_profile makes it of the edge it sees.
vision::Profile profile_of(const render::Truth& truth) {
  const auto& [from, to] = truth.ground.value();
  const double slope = (to.y - from.y) / (to.x - from.x);
  const vision::GroundFrame ground({.y_at_0 = from.y - slope * from.x, .slope = slope});
  vision::Profile profile;
  for (const vision::Point& point : truth.outline) {
    profile.along.push_back(ground.along(point));
    profile.height.push_back(ground.height(point));
  }
  const std::size_t width = std::max<std::size_t>(3, profile.size() / 40);
  const auto smooth = vision::moving_average(profile.height, width);
  profile.crest_height = *std::max_element(smooth.begin(), smooth.end());
  const auto is_top = [&](double height) { return height >= .97 * profile.crest_height; };
  const auto first = std::find_if(smooth.begin(), smooth.end(), is_top) - smooth.begin();
  const auto last = smooth.rend() - std::find_if(smooth.rbegin(), smooth.rend(), is_top) - 1;
  profile.crest = static_cast<std::size_t>(first + last) / 2;
  return profile;
}

}  // namespace

FlankAngles outline_angles(const render::Truth& truth, double grain_px) {
  const vision::Profile profile = profile_of(truth);
  const auto angle_of = [&](vision::Side side) {
    const auto fit = vision::fit_flank(profile, side, {.grain = grain_px});
    if (fit.status != vision::FlankStatus::ok) throw std::logic_error("a heap without a flank");
    return fit.angle_rad;
  };
  return {.left_rad = angle_of(vision::Side::left), .right_rad = angle_of(vision::Side::right)};
}

}  // namespace repose::bench
