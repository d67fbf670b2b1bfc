#include "vision/measure/flank.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "vision/measure/line_fit.h"

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

namespace {

constexpr double kSteepest = 3.0;  // tan of 71.6 degrees: nothing loose stands steeper
constexpr std::size_t kFewestPoints = 12;
constexpr double kFewestVisible = 0.8;  // of the window that must be in the picture: a shorter
                                        // stretch is another angle, flanks are hollow
constexpr double kBlockGrains = 2;      // neighbours within 2 grains are one piece of evidence
constexpr double kFewestGrains = 5;     // high: a bump longer than such a heap's grain is none
constexpr double kFewestLeft = 5;       // grains of flank above an apron: over fewer the slope is a
                                        // grain's, below which the next one looks like an apron
constexpr double kThinGrains = 2;       // height of an apron
constexpr double kHighestApron = 1.0 / 3;  // of the height: what begins above is half of the flank

/// Mean distance between upward crossings of the line by the edge: one to two grains.
double bump_length(const Descent& d, const Stretch& w) {
  const LineFit line = line_through(d, w);
  int crossings = 0;
  for (std::size_t i = w.first + 1; i < w.last; ++i) {
    crossings += d.h[i - 1] < line.y(d.u[i - 1]) && d.h[i] >= line.y(d.u[i]) ? 1 : 0;
  }
  return (d.u[w.last - 1] - d.u[w.first]) / std::max(1, crossings);
}

/// Where an apron begins in the lower half of the stretch's height: a thin layer that runs out from
/// the foot. There the slope over some grains has sunk under a third of the upper half's, or less
/// than two grains of height are left though the foot is still far (twice as far as the flank's
/// slope would take).
std::size_t apron_start(const Descent& d, const Stretch& w, double middle, double grain) {
  const Stretch upper{w.first, rough_stretch(d, middle, d.smooth[w.first]).last};
  const double slope = upper.size() < 2 ? 0 : line_through(d, upper).slope;
  if (slope >= 0) return w.last;
  const std::size_t two_grains = column_at(d, d.u[w.first] + 2 * grain) - w.first;
  const std::size_t beside = std::max({two_grains, upper.size() / 4, std::size_t{4}});
  for (std::size_t i = upper.last; i < w.last; ++i) {
    const double to_foot = d.u.back() - d.u[i];
    if (d.smooth[i] < kThinGrains * grain && to_foot > 2 * d.smooth[i] / -slope) return i;
    const std::size_t half = std::min(i, beside);
    if (i + half >= d.u.size()) break;
    if (line_through(d, {i - half, i + half}).slope > slope / 3) return i;
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

FlankFit upright_end(std::string reason) {
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

/// The heights between which this side is fitted, as far as it has them; else why it has none.
struct Heights {
  double low = 0;
  double high = 0;
  bool frame_cut = false;
  std::optional<FlankFit> none;
};

Heights heights_of(const Descent& d, double crest, bool at_frame, const FlankOptions& options) {
  const double asked = options.window_from * crest;
  const double high = options.window_to * crest;
  const auto none = [&](FlankFit why) { return Heights{asked, high, false, std::move(why)}; };
  if (d.u.size() < kFewestPoints || d.smooth.back() > high) {
    return none(at_frame ? without(FlankStatus::absent, "the crest lies at the picture's edge")
                         : upright_end("the heap ends upright at its crest"));
  }
  const bool frame_cut = at_frame && d.smooth.back() > asked;
  const double low = frame_cut ? d.smooth.back() : asked;
  if (high - low < kFewestVisible * (high - asked)) {
    return none(without(FlankStatus::truncated, "the picture's edge cuts the flank off"));
  }
  const Stretch rough = rough_stretch(d, low, high);
  if (rough.size() < 3 || static_cast<double>(rough.size()) < (high - asked) / kSteepest) {
    return none(upright_end("this side falls off vertically"));
  }
  if (rough.size() < kFewestPoints) {
    return none(without(FlankStatus::absent, "too few pixels on this side"));
  }
  return {low, high, frame_cut, std::nullopt};
}

/// Both lines through the window's points, and how they scatter.
void fit_lines(FlankFit& fit, const Descent& d, const Stretch& w) {
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
  fit.bend_rad =
      angle_of(line_through(d, {w.first, half})) - angle_of(line_through(d, {half, w.last}));
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
    const Stretch w = smoothed_stretch(d, std::max(from * crest, floor), to * crest, fit.grain);
    if (w.size() < kFewestPoints) continue;
    const double angle = angle_of(line_through(d, w));
    fit.other_windows.push_back({from, to, angle});
    fit.window_spread_rad =
        std::max(fit.window_spread_rad, std::abs(angle - angle_of(fit.least_squares)));
  }
}

/// Ends the stretch where an apron begins, if that is low enough; else says that there is one.
void leave_apron_out(FlankFit& fit, Stretch& w, const Descent& d, double crest) {
  const double middle = (fit.window_from + fit.window_to) / 2 * crest;
  const std::size_t start = apron_start(d, w, middle, fit.grain);
  const std::size_t five_grains = column_at(d, d.u[w.first] + kFewestLeft * fit.grain) - w.first;
  if (start == w.last || start <= w.first + std::max(kFewestPoints, five_grains)) return;
  const double height = d.smooth[start] / crest;
  const bool is_thin = d.smooth[start] < kThinGrains * fit.grain;
  if (height > kHighestApron && !is_thin) {
    const double below = line_through(d, {start, w.last}).slope;
    const double above = line_through(d, {w.first, start}).slope;
    if (below > above / 2) fit.high_apron = height;  // else a ledge, under which the flank goes on
    return;
  }
  // Two large grains may be more than a third of the height.
  const std::size_t low_enough = rough_stretch(d, kHighestApron * crest, d.smooth[w.first]).last;
  const std::size_t cut = std::max(start, low_enough);
  if (cut >= w.last) return;
  w.last = cut;
  fit.apron_cut = true;
  fit.window_from = std::max(fit.window_from, std::min(height, kHighestApron));
}

}  // namespace

FlankFit fit_flank(const Profile& profile, Side side, const FlankOptions& options) {
  const Descent d = descent_of(profile, side);
  const double crest = profile.crest_height;
  const bool at_frame = side == Side::left ? profile.leaves_frame_left : profile.leaves_frame_right;
  const Heights heights = heights_of(d, crest, at_frame, options);
  if (heights.none) return *heights.none;

  FlankFit fit;
  fit.status = FlankStatus::ok;
  fit.frame_cut = heights.frame_cut;
  fit.window_from = heights.low / crest;
  fit.window_to = heights.high / crest;
  const Stretch rough = rough_stretch(d, heights.low, heights.high);
  // An apron's bumps are longer: what may be one is left out.
  const Stretch upper =
      rough_stretch(d, std::max(heights.low, kHighestApron * crest), heights.high);
  const Stretch& bumpy = upper.size() < kFewestPoints ? rough : upper;
  fit.grain = options.grain.value_or(std::min(bump_length(d, bumpy), crest / kFewestGrains));
  Stretch w = smoothed_stretch(d, heights.low, heights.high, fit.grain);
  if (w.size() < kFewestPoints) w = rough;
  const double spacing = (d.u[w.last - 1] - d.u[w.first]) / static_cast<double>(w.size() - 1);
  if (options.leave_apron_out) leave_apron_out(fit, w, d, crest);
  fit_lines(fit, d, w);
  add_fit_error(fit, spacing, options.seed);
  add_other_windows(fit, d, crest, fit.apron_cut ? fit.window_from * crest : 0);
  return fit;
}

}  // namespace repose::vision
