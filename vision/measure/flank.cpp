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
constexpr int kRounds = 4;                    // of moving the line to where it crosses the height

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

LineFit line_through(const Descent& d, const Stretch& stretch, const std::vector<double>& weight) {
  const auto part = [&](const std::vector<double>& all) {
    return std::span(all).subspan(stretch.first, stretch.size());
  };
  return least_squares_line(part(d.u), part(d.h),
                            weight.empty() ? std::span<const double>{} : part(weight));
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

constexpr double kSteepest = 3.0;  // tan of 71.6 degrees: no loose grains stand steeper
constexpr std::size_t kFewestPoints = 12;
constexpr double kFewestVisible = 0.8;     // of the window that must be in the picture: as flanks
                                           // are concave, a shorter stretch has another angle
constexpr double kBlockGrains = 2;         // neighbours within 2 grains count as one observation
constexpr double kFewestGrains = 5;        // least height of a heap: caps the grain size
constexpr double kThinGrains = 2;          // height of a layer
constexpr double kHighestApron = 1.0 / 3;  // of the height: what begins above is half of the flank
constexpr double kHalf = 0.5;              // columns with less weight are not reported as fitted

/// Mean distance between upward crossings of the line by the edge: one to two grains.
double bump_length(const Descent& d, const Stretch& w) {
  const LineFit line = line_through(d, w);
  int crossings = 0;
  for (std::size_t i = w.first + 1; i < w.last; ++i) {
    crossings += d.h[i - 1] < line.y(d.u[i - 1]) && d.h[i] >= line.y(d.u[i]) ? 1 : 0;
  }
  return (d.u[w.last - 1] - d.u[w.first]) / std::max(1, crossings);
}

/// Weight of each column: see fit_flank(). Columns below the window, which other windows reach
/// into, have the weight of the window's last column.
/// @param middle  height of the middle of the window `w`
std::vector<double> weights_of(const Descent& d, const Stretch& w, double middle, double grain) {
  constexpr double kFullSlope = .4;  // of the upper half's, from which on a column has full weight
  constexpr int kPower = 6;
  constexpr double kSlopePart = .25;  // of the upper half: a slope is not fitted over less
  std::vector<double> weight(d.u.size(), 1);
  const Stretch upper{w.first, rough_stretch(d, middle, d.smooth[w.first]).last};
  if (upper.size() < 2) return weight;
  const double slope = line_through(d, upper).slope;
  if (slope > -kFlattestSlope) return weight;
  const double run = d.u[upper.last - 1] - d.u[upper.first];
  const double spacing = run / static_cast<double>(upper.size() - 1);
  const double reach = std::max(kSmoothGrains * grain, kSlopePart * run) / std::max(spacing, 1e-9);
  const std::size_t beside = std::max(kFewestBeside, static_cast<std::size_t>(std::lround(reach)));
  for (std::size_t i = upper.last; i < w.last; ++i) {
    const Stretch near{std::max(w.first, i - std::min(i, beside)),
                       std::min(weight.size(), i + beside + 1)};
    const double share = line_through(d, near).slope / slope / kFullSlope;
    weight[i] = std::min(weight[i - 1], std::pow(std::clamp(share, 0.0, 1.0), kPower));
  }
  const auto below = weight.begin() + static_cast<std::ptrdiff_t>(w.last);
  if (w.last > 0) std::fill(below, weight.end(), *(below - 1));
  return weight;
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

double weight_at(const FlankFit& fit, std::size_t i) {
  return fit.weight.empty() ? 1 : fit.weight[i];
}

/// Residuals times the points' weights and, for a robust line, its own weights; points without
/// weight are put on the line.
std::vector<double> believed_residuals(const FlankFit& fit, bool is_robust) {
  std::vector<double> residual;
  for (std::size_t i = 0; i < fit.along.size(); ++i) {
    const double r = fit.height[i] - fit.shown.y(fit.along[i]);
    const double t = is_robust ? r / std::max(1e-9, 4.685 * fit.scatter) : 0;
    residual.push_back(std::abs(t) < 1 ? weight_at(fit, i) * r * (1 - t * t) : 0);
  }
  return residual;
}

/// The heights between which this side is fitted, as far as it has them; otherwise why there are
/// none.
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

/// Scale of the edge's overall curvature: of its distances from the least-squares line, smoothed
/// over three grains. A robust line with a smaller scale would follow one half or the other of a
/// bent flank, and jump between them.
double bend_scale(const FlankFit& fit, double spacing) {
  std::vector<double> residual;
  for (std::size_t i = 0; i < fit.along.size(); ++i) {
    residual.push_back(fit.height[i] - fit.least_squares.y(fit.along[i]));
  }
  const double widest = kWidestOfStretch * static_cast<double>(residual.size());
  const double width = std::min(kSmoothGrains * fit.grain / std::max(spacing, 1e-9), widest);
  std::vector<double> smooth = moving_average(residual, static_cast<std::size_t>(width));
  for (double& value : smooth) value = std::abs(value);
  return kMadToSigma * median(smooth, fit.weight);
}

/// Both lines through the window's points, and their scatter.
void fit_lines(FlankFit& fit, const Descent& d, const Stretch& w, const std::vector<double>& weight,
               double spacing, bool is_robust) {
  const auto part = [&](const std::vector<double>& all) {
    return std::vector<double>(all.begin() + static_cast<std::ptrdiff_t>(w.first),
                               all.begin() + static_cast<std::ptrdiff_t>(w.last));
  };
  fit.along = part(d.u);
  fit.height = part(d.h);
  if (!weight.empty()) fit.weight = part(weight);
  fit.least_squares = least_squares_line(fit.along, fit.height, fit.weight);
  const double bend = bend_scale(fit, spacing);
  fit.robust = robust_line(fit.along, fit.height, fit.weight, bend);
  fit.shown = is_robust ? fit.robust : fit.least_squares;
  fit.angle_rad = angle_of(fit.shown);
  std::vector<double> distance;
  double all = 0;
  for (std::size_t i = 0; i < fit.along.size(); ++i) {
    distance.push_back(std::abs(fit.height[i] - fit.robust.y(fit.along[i])));
    all += weight_at(fit, i);
  }
  fit.scatter = kMadToSigma * median(distance, fit.weight);
  const std::size_t half = w.first + static_cast<std::size_t>(all / 2);
  fit.bend_rad = angle_of(line_through(d, {w.first, half}, weight)) -
                 angle_of(line_through(d, {half, w.last}, weight));
}

void add_fit_error(FlankFit& fit, double spacing, const FlankOptions& options) {
  const auto block = static_cast<std::size_t>(
      std::max(2.0, std::ceil(kBlockGrains * fit.grain / std::max(spacing, 0.1))));
  const double slope_error = block_bootstrap_slope_error(
      fit.along, believed_residuals(fit, options.is_robust), block, options.seed, fit.weight);
  fit.fit_error_rad = slope_error / (1 + fit.shown.slope * fit.shown.slope);
  double all = 0;
  for (std::size_t i = 0; i < fit.along.size(); ++i) all += weight_at(fit, i);
  fit.degrees_of_freedom = independent_blocks(all, block) - 2;
}

/// The angle from other stretches of the flank.
void add_other_windows(FlankFit& fit, const Descent& d, double crest,
                       const std::vector<double>& weight) {
  constexpr double kWindows[][2] = {{0.1, 0.9}, {0.3, 0.7}};
  for (const auto& [from, to] : kWindows) {
    const Stretch w = smoothed_stretch(d, from * crest, to * crest, fit.grain);
    if (w.size() < kFewestPoints) continue;
    const double angle = angle_of(line_through(d, w, weight));
    fit.other_windows.push_back({from, to, angle});
    fit.window_spread_rad =
        std::max(fit.window_spread_rad, std::abs(angle - angle_of(fit.least_squares)));
  }
}

/// The line if an apron had full weight, and where the apron begins.
void add_apron(FlankFit& fit, const Descent& d, const Stretch& w, double crest, double spacing) {
  if (fit.weight.empty() || fit.weight.back() == 1) return;
  FlankFit with = fit;
  with.weight.clear();
  fit_lines(with, d, w, {}, spacing, true);
  fit.apron_rad = std::abs(with.angle_rad - fit.angle_rad);
  const std::size_t counted = fit.counted();
  if (counted == fit.along.size()) return;
  const std::size_t start = w.first + counted;
  const double from = d.smooth[start] / crest;
  fit.apron = Apron{.from = from,
                    .length = d.u.back() - d.u[start],
                    .is_high = from > kHighestApron && d.smooth[start] > kThinGrains * fit.grain,
                    .angle_with_rad = with.angle_rad,
                    .line_with = with.shown};
  fit.window_from = std::max(fit.window_from, from);
}

}  // namespace

std::size_t FlankFit::counted() const {
  const auto less =
      std::count_if(weight.begin(), weight.end(), [](double counts) { return counts < kHalf; });
  return along.size() - static_cast<std::size_t>(less);
}

double mean_angle_rad(const FlankFit& left, const FlankFit& right) {
  const bool l = left.status == FlankStatus::ok;
  const bool r = right.status == FlankStatus::ok;
  if (l && r) return (left.angle_rad + right.angle_rad) / 2;
  return l ? left.angle_rad : r ? right.angle_rad : 0;
}

double FlankFit::sure_bend_rad() const {
  // The standard error of the halves' difference is four times the line's: 2^1.5 for half the
  // length, times the root of 2 for two. Up to two of those are attributed to chance.
  constexpr double kHalvesPerWhole = 4, kByChance = 2;
  const double chance = kByChance * kHalvesPerWhole * fit_error_rad;
  return std::sqrt(std::max(0.0, bend_rad * bend_rad - chance * chance));
}

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
  // An apron's bumps are longer: the part that may be one is left out.
  const Stretch upper =
      rough_stretch(d, std::max(heights.low, kHighestApron * crest), heights.high);
  const Stretch& bumpy = upper.size() < kFewestPoints ? rough : upper;
  fit.grain = options.grain.value_or(std::min(bump_length(d, bumpy), crest / kFewestGrains));
  Stretch w = smoothed_stretch(d, heights.low, heights.high, fit.grain);
  if (w.size() < kFewestPoints) w = rough;
  const double spacing = (d.u[w.last - 1] - d.u[w.first]) / static_cast<double>(w.size() - 1);
  std::vector<double> weight;
  if (options.leave_apron_out) {
    const double middle = (fit.window_from + fit.window_to) / 2 * crest;
    weight = weights_of(d, w, middle, fit.grain);
  }
  fit_lines(fit, d, w, weight, spacing, options.is_robust);
  // A wall with a plate in front, of which all but the wall was treated as an apron.
  if (-fit.least_squares.slope > kSteepest) return upright_end("this side falls off vertically");
  add_fit_error(fit, spacing, options);
  add_other_windows(fit, d, crest, weight);
  add_apron(fit, d, w, crest, spacing);
  return fit;
}

}  // namespace repose::vision
