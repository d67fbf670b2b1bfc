#include "vision/measure/descent.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace repose::vision {
namespace {

constexpr double kSmoothGrains = 3;           // width of the line that smooths the edge
constexpr std::size_t kFewestBeside = 4;      // columns on each side that such a line needs
constexpr double kWidestOfStretch = 1.0 / 3;  // ... of the stretch whose end is sought
constexpr int kRounds = 4;                    // of moving the line to the place that it gives

std::size_t first_below(const Descent& d, std::size_t from, double height) {
  while (from < d.smooth.size() && d.smooth[from] >= height) ++from;
  return from;
}

/// Where the smoothed edge has the height, near the column `at`.
std::size_t crossing_near(const Descent& d, std::size_t at, double height, std::size_t beside) {
  for (int round = 0; round < kRounds; ++round) {
    if (at >= d.u.size()) return at;
    const std::size_t half = std::min({beside, at, d.u.size() - 1 - at});
    if (half < kFewestBeside) return at;
    const LineFit line = line_through(d, {at - half, at + half + 1});
    if (line.slope > -kFlattestSlope) return at;
    const std::size_t there = column_at(d, (height - line.intercept) / line.slope);
    const std::size_t next = std::clamp(there, at - half, at + half);
    if (next == at) return at;
    at = next;
  }
  return at;
}

}  // namespace

Descent descent_of(const Profile& profile, Side side) {
  Descent descent;
  const double crest = profile.along[profile.crest];
  const auto push = [&](std::size_t i) {
    descent.u.push_back(std::abs(profile.along[i] - crest));
    descent.h.push_back(profile.height[i]);
  };
  if (side == Side::left) {
    for (std::size_t i = profile.crest + 1; i-- > 0;) push(i);
  } else {
    for (std::size_t i = profile.crest; i < profile.size(); ++i) push(i);
  }
  const std::size_t width = std::max<std::size_t>(3, profile.size() / 60);
  descent.smooth = moving_average(descent.h, width);
  return descent;
}

std::size_t column_at(const Descent& d, double u) {
  return static_cast<std::size_t>(std::lower_bound(d.u.begin(), d.u.end(), u) - d.u.begin());
}

LineFit line_through(const Descent& d, const Stretch& stretch) {
  return least_squares_line(std::span(d.u).subspan(stretch.first, stretch.size()),
                            std::span(d.h).subspan(stretch.first, stretch.size()));
}

Stretch rough_stretch(const Descent& d, double low, double high) {
  Stretch stretch;
  stretch.first = first_below(d, 0, high);
  stretch.last = first_below(d, stretch.first, low);
  return stretch;
}

Stretch smoothed_stretch(const Descent& d, double low, double high, double grain) {
  const Stretch rough = rough_stretch(d, low, high);
  if (rough.size() < 2) return rough;
  const double spacing =
      (d.u[rough.last - 1] - d.u[rough.first]) / static_cast<double>(rough.size() - 1);
  const double grains = kSmoothGrains * grain / std::max(spacing, 1e-9) / 2;
  const double widest = kWidestOfStretch * static_cast<double>(rough.size());
  const auto beside =
      std::max(kFewestBeside, static_cast<std::size_t>(std::lround(std::min(grains, widest))));
  return {crossing_near(d, rough.first, high, beside), crossing_near(d, rough.last, low, beside)};
}

}  // namespace repose::vision
