#include "vision/measure/flank.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "vision/measure/bootstrap.h"

namespace repose::vision {
namespace {

constexpr double kSteepest = 3.0;  // tan of 71.6 degrees: nothing loose stands steeper
constexpr std::size_t kFewestPoints = 12;
constexpr double kFewestVisible = 0.8;  // of the window that must be in the picture: a shorter
                                        // stretch is another angle, flanks are hollow
constexpr double kMadToSigma = 1.4826;  // of a normal distribution
constexpr double kBlockGrains = 2;      // neighbours within 2 grains are one piece of evidence
constexpr double kFewestGrains = 5;     // high: a bump longer than such a heap's grain is none
constexpr double kFewestLeft = 5;       // grains of flank above an apron: over fewer the slope is a
                                        // grain's, below which the next one looks like an apron

/// The points of one side from the crest outwards: u grows outwards, h is the height.
struct Descent {
  std::vector<double> u;
  std::vector<double> h;
  std::vector<double> smooth;
};

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

struct Window {
  std::size_t first = 0;
  std::size_t last = 0;  ///< one past the end
  std::size_t size() const { return last > first ? last - first : 0; }
};

std::size_t first_below(const Descent& d, std::size_t from, double height) {
  while (from < d.smooth.size() && d.smooth[from] >= height) ++from;
  return from;
}

LineFit fit_window(const Descent& d, const Window& w) {
  return least_squares_line(std::span(d.u).subspan(w.first, w.size()),
                            std::span(d.h).subspan(w.first, w.size()));
}

std::size_t index_at(const Descent& d, double u) {
  return static_cast<std::size_t>(std::lower_bound(d.u.begin(), d.u.end(), u) - d.u.begin());
}

/// Columns between the heights `low` and `high`. The ends are put where the fitted line, not the
/// bumpy edge, has those heights: choosing points by their own height would flatten the line.
Window window_between(const Descent& d, double low, double high) {
  Window w;
  w.first = first_below(d, 0, high);
  w.last = first_below(d, w.first, low);
  for (int round = 0; round < 4 && w.size() >= kFewestPoints; ++round) {
    const LineFit line = fit_window(d, w);
    if (line.slope >= -kFlattestSlope) break;
    const Window next{index_at(d, (high - line.intercept) / line.slope),
                      index_at(d, (low - line.intercept) / line.slope)};
    if (next.size() < kFewestPoints || (next.first == w.first && next.last == w.last)) break;
    w = next;
  }
  return w;
}

/// Mean distance between upward crossings of the line by the edge: one to two grains.
double bump_length(const Descent& d, const Window& w) {
  const LineFit line = fit_window(d, w);
  int crossings = 0;
  for (std::size_t i = w.first + 1; i < w.last; ++i) {
    crossings += d.h[i - 1] < line.y(d.u[i - 1]) && d.h[i] >= line.y(d.u[i]) ? 1 : 0;
  }
  return (d.u[w.last - 1] - d.u[w.first]) / std::max(1, crossings);
}

/// Where an apron begins, a thin layer that runs out from the foot: where the slope over some
/// grains has sunk under a third of the flank's, or where less than two grains of height are left
/// though the foot is still far (twice as far as the flank's slope would take).
std::size_t apron_start(const Descent& d, const Window& w, double grain) {
  const LineFit upper = fit_window(d, {w.first, w.first + w.size() / 2});
  if (upper.slope >= 0) return w.last;
  const std::size_t two_grains = index_at(d, d.u[w.first] + 2 * grain) - w.first;
  for (std::size_t i = w.first + w.size() / 2; i < w.last; ++i) {
    const double to_foot = d.u.back() - d.u[i];
    if (d.smooth[i] < 2 * grain && to_foot > 2 * d.smooth[i] / -upper.slope) return i;
    const std::size_t half = std::min(i, std::max({two_grains, w.size() / 8, std::size_t{4}}));
    if (i + half >= d.u.size()) break;
    if (fit_window(d, {i - half, i + half}).slope > upper.slope / 3) return i;
  }
  return w.last;
}

double angle_of(const LineFit& line) { return std::atan(-line.slope); }

FlankFit without(FlankStatus status, std::string reason) {
  FlankFit fit;
  fit.status = status;
  fit.reason = std::move(reason);
  return fit;
}

FlankFit upright(std::string reason) {
  FlankFit fit = without(FlankStatus::absent, std::move(reason));
  fit.vertical = true;
  return fit;
}

/// Residuals of the points that the robust line believes; the others are put on the line.
std::vector<double> believed_residuals(const FlankFit& fit) {
  std::vector<double> residual;
  for (std::size_t i = 0; i < fit.along.size(); ++i) {
    const double r = fit.height[i] - fit.robust.y(fit.along[i]);
    const double t = r / std::max(1e-9, 4.685 * fit.scatter);
    residual.push_back(std::abs(t) < 1 ? r * (1 - t * t) : 0);
  }
  return residual;
}

/// The window that is asked for, as far as this side has it; else why it has none.
struct Stretch {
  Window window;
  bool frame_cut = false;
  std::optional<FlankFit> none;
};

Stretch stretch_of(const Descent& d, double crest, bool at_frame, const FlankOptions& options) {
  const double low = options.window_from * crest;
  const double high = options.window_to * crest;
  const auto none = [](FlankFit why) { return Stretch{{}, false, std::move(why)}; };
  if (d.u.size() < kFewestPoints || d.smooth.back() > high) {
    return none(at_frame ? without(FlankStatus::absent, "the crest lies at the picture's edge")
                         : upright("the heap ends upright at its crest"));
  }
  const bool frame_cut = at_frame && d.smooth.back() > low;
  const double lowest = frame_cut ? d.smooth.back() : low;
  if (high - lowest < kFewestVisible * (high - low)) {
    return none(without(FlankStatus::truncated, "the picture's edge cuts the flank off"));
  }
  const Window w = window_between(d, lowest, high);
  if (w.size() < 3 || static_cast<double>(w.size()) < (high - low) / kSteepest) {
    return none(upright("this side falls off vertically"));
  }
  if (w.size() < kFewestPoints) {
    return none(without(FlankStatus::absent, "too few pixels on this side"));
  }
  return {w, frame_cut, std::nullopt};
}

/// Both lines through the window's points, and how they scatter.
void fit_lines(FlankFit& fit, const Descent& d, const Window& w) {
  const auto part = [&](const std::vector<double>& all) {
    return std::vector<double>(all.begin() + static_cast<std::ptrdiff_t>(w.first),
                               all.begin() + static_cast<std::ptrdiff_t>(w.last));
  };
  fit.along = part(d.u);
  fit.height = part(d.h);
  fit.least_squares = least_squares_line(fit.along, fit.height);
  fit.robust = robust_line(fit.along, fit.height);
  fit.shown = fit.robust;
  fit.angle_rad = angle_of(fit.shown);
  std::vector<double> distance;
  for (std::size_t i = 0; i < fit.along.size(); ++i) {
    distance.push_back(std::abs(fit.height[i] - fit.robust.y(fit.along[i])));
  }
  fit.scatter = kMadToSigma * median(distance);
  const std::size_t half = w.first + w.size() / 2;
  fit.bend_rad = angle_of(fit_window(d, {w.first, half})) - angle_of(fit_window(d, {half, w.last}));
}

void add_fit_error(FlankFit& fit, double spacing, std::uint64_t seed) {
  const auto block = static_cast<std::size_t>(
      std::max(2.0, std::ceil(kBlockGrains * fit.grain / std::max(spacing, 0.1))));
  const double slope_error =
      block_bootstrap_slope_error(fit.along, believed_residuals(fit), block, seed);
  fit.fit_error_rad = slope_error / (1 + fit.robust.slope * fit.robust.slope);
  fit.degrees_of_freedom = independent_blocks(fit.along.size(), block) - 2;
}

/// The angle from other stretches of the flank, none of them reaching below `floor`.
void add_other_windows(FlankFit& fit, const Descent& d, double crest, double floor) {
  constexpr double kWindows[][2] = {{0.1, 0.9}, {0.3, 0.7}};
  for (const auto& [from, to] : kWindows) {
    const Window w = window_between(d, std::max(from * crest, floor), to * crest);
    if (w.size() < kFewestPoints) continue;
    const double angle = angle_of(fit_window(d, w));
    fit.other_windows.push_back({from, to, angle});
    fit.window_spread_rad =
        std::max(fit.window_spread_rad, std::abs(angle - angle_of(fit.least_squares)));
  }
}

}  // namespace

FlankFit fit_flank(const Profile& profile, Side side, const FlankOptions& options) {
  const Descent d = descent_of(profile, side);
  const double crest = profile.crest_height;
  const bool at_frame = side == Side::left ? profile.leaves_frame_left : profile.leaves_frame_right;
  const Stretch stretch = stretch_of(d, crest, at_frame, options);
  if (stretch.none) return *stretch.none;

  Window w = stretch.window;
  const double spacing = (d.u[w.last - 1] - d.u[w.first]) / static_cast<double>(w.size() - 1);
  FlankFit fit;
  fit.status = FlankStatus::ok;
  fit.frame_cut = stretch.frame_cut;
  fit.grain = options.grain.value_or(std::min(bump_length(d, w), crest / kFewestGrains));
  const std::size_t cut = options.leave_apron_out ? apron_start(d, w, fit.grain) : w.last;
  const std::size_t five_grains = index_at(d, d.u[w.first] + kFewestLeft * fit.grain) - w.first;
  if (cut < w.last && cut > w.first + std::max(kFewestPoints, five_grains)) {
    w.last = cut;
    fit.apron_cut = true;
  }
  fit_lines(fit, d, w);
  add_fit_error(fit, spacing, options.seed);
  add_other_windows(fit, d, crest, fit.apron_cut ? d.smooth[cut] : 0);
  return fit;
}

}  // namespace repose::vision
