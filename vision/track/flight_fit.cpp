#include "vision/track/flight_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <boost/math/distributions/students_t.hpp>
#include <opencv2/core.hpp>

namespace repose::vision {

Parabola parabola_through(const std::vector<SeenAt>& path, std::size_t from, std::size_t count) {
  const SeenAt& middle = path[from + count / 2];
  const double length_s = path[from + count - 1].time_s - path[from].time_s;
  cv::Matx33d normal = cv::Matx33d::zeros();
  cv::Vec3d right(0, 0, 0);
  double squares = 0;
  for (std::size_t k = from; k < from + count; ++k) {
    const double t = (path[k].time_s - middle.time_s) / length_s;
    const double y = path[k].y_px - middle.y_px;
    const cv::Vec3d terms(1, t, .5 * t * t);
    normal += terms * terms.t();
    right += y * terms;
    squares += y * y;
  }
  const cv::Matx33d inverse = normal.inv();
  const cv::Vec3d solution = inverse * right;
  constexpr double kMinRms_px = .1;
  const double left = std::max(0.0, squares - solution.dot(right));
  const double rms = std::sqrt(left / static_cast<double>(count - 3));
  const double per_s2 = 1 / (length_s * length_s);
  return {.acceleration = per_s2 * solution[2],
          .rms_px = rms,
          .error = per_s2 * std::max(rms, kMinRms_px) * std::sqrt(inverse(2, 2))};
}

namespace {

constexpr std::size_t kFewestInFlight = 4;
/// Costs in squared deviations: of a loose sighting, and of an additional flight.
constexpr double kLoose = 16;
constexpr double kFlight = 20;
/// Minimum distance between the middle of a flight's parabola and its chord.
constexpr double kMinSag_px = 2;
constexpr double kMinSag_sigmas = 6;

/// Gravity from the curvature of the stretches that parabolas fit, weighted towards the highest
/// ones.
std::optional<double> gravity_of(const std::vector<SeenAt>& path, double noise_px) {
  std::vector<std::pair<double, double>> found;  // acceleration and weight
  double total = 0;
  for (const std::size_t count :
       std::array<std::size_t, 10>{5, 7, 10, 14, 20, 28, 40, 56, 80, 112}) {
    const std::size_t step = std::max<std::size_t>(1, count / 6);
    for (std::size_t from = 0; from + count <= path.size(); from += step) {
      const Parabola parabola = parabola_through(path, from, count);
      const double length_s = path[from + count - 1].time_s - path[from].time_s;
      const double sag_px = parabola.acceleration * length_s * length_s / 8;
      const double least_px = kMinSag_sigmas * std::max(parabola.rms_px, .1 * noise_px);
      if (parabola.rms_px > 2.5 * noise_px || sag_px < std::max(kMinSag_px, least_px)) continue;
      found.emplace_back(parabola.acceleration, sag_px * sag_px);
      total += sag_px * sag_px;
    }
  }
  std::sort(found.begin(), found.end());
  double sum = 0;
  for (const auto& [acceleration, weight] : found) {
    sum += weight;
    if (sum >= .5 * total) return acceleration;
  }
  return std::nullopt;
}

/// Fit of a parabola with nearly the given gravity through sightings added one by one, relative to
/// it.
class NearlyFalling {
 public:
  /// @param unit_s  gives the sums similar magnitudes
  NearlyFalling(double gravity, double noise_px, double unit_s)
      : unit_s_(unit_s), gravity_(gravity) {
    const double tolerated = kTolerated * gravity * unit_s * unit_s;
    normal_(2, 2) = noise_px * noise_px / (tolerated * tolerated);
  }

  void add(double time_s, double y_px) {
    const double t = time_s / unit_s_;
    const double z = y_px - .5 * gravity_ * time_s * time_s;
    const cv::Vec3d terms(1, t, .5 * t * t);
    normal_ += terms * terms.t();
    right_ += z * terms;
    squares_ += z * z;
  }
  /// Squared deviations, including that of gravity; infinite if gravity differs too much.
  double squares() const {
    const cv::Vec3d solution = normal_.solve(right_, cv::DECOMP_CHOLESKY);
    const double most = 3 * kTolerated * gravity_ * unit_s_ * unit_s_;
    if (std::abs(solution[2]) > most) return std::numeric_limits<double>::infinity();
    return std::max(0.0, squares_ - right_.dot(solution));
  }

 private:
  /// Air, lens and readout change the curvature of a flight as a whole.
  static constexpr double kTolerated = .12;

  double unit_s_;
  double gravity_;
  cv::Matx33d normal_ = cv::Matx33d::zeros();
  cv::Vec3d right_{0, 0, 0};
  double squares_ = 0;
};

std::vector<FlightSpan> cheapest_cut(const std::vector<SeenAt>& path, double gravity,
                                     double noise_px) {
  const std::size_t count = path.size();
  const double unit_s = (path.back().time_s - path.front().time_s) / static_cast<double>(count);
  std::vector<double> cost(count + 1, 0);
  std::vector<std::size_t> begin(count + 1, 0);
  for (std::size_t end = 1; end <= count; ++end) {
    cost[end] = cost[end - 1] + kLoose;
    begin[end] = end - 1;
    const SeenAt& last = path[end - 1];
    NearlyFalling falling(gravity, noise_px, unit_s);
    for (std::size_t from = end; from-- > 0;) {
      falling.add(path[from].time_s - last.time_s, path[from].y_px - last.y_px);
      const std::size_t length = end - from;
      if (length < kFewestInFlight) continue;
      const double misfit = falling.squares() / (noise_px * noise_px);
      if (std::isinf(misfit)) continue;
      if (misfit > 2 * kLoose * static_cast<double>(length)) break;
      if (cost[from] + misfit + kFlight < cost[end]) {
        cost[end] = cost[from] + misfit + kFlight;
        begin[end] = from;
      }
    }
  }
  std::vector<FlightSpan> spans;
  for (std::size_t end = count; end > 0; end = begin[end]) {
    if (end - begin[end] >= kFewestInFlight) spans.push_back({begin[end], end});
  }
  std::reverse(spans.begin(), spans.end());
  return spans;
}

/// Whether a flight is curved, and not a short stretch of a grain at rest, which any line fits.
bool is_bent(const std::vector<SeenAt>& path, const FlightSpan& span, double gravity,
             double noise_px) {
  const double length_s = path[span.to - 1].time_s - path[span.from].time_s;
  const double sag_px = gravity * length_s * length_s / 8;
  if (sag_px < std::max(kMinSag_px, kMinSag_sigmas * noise_px)) return false;
  const SeenAt& first = path[span.from];
  NearlyFalling falling(gravity, noise_px, length_s);
  for (std::size_t k = span.from; k < span.to; ++k) {
    falling.add(path[k].time_s - first.time_s, path[k].y_px - first.y_px);
  }
  constexpr double kOff = .1;
  const double count = static_cast<double>(span.to - span.from);
  return std::sqrt(falling.squares() / count) < kOff * sag_px;
}

}  // namespace

Flights find_flights(const std::vector<SeenAt>& path, double noise_px) {
  const auto gravity = gravity_of(path, noise_px);
  if (!gravity) return {};
  Flights flights{.spans = cheapest_cut(path, *gravity, noise_px), .gravity_px_s2 = *gravity};
  std::erase_if(flights.spans,
                [&](const FlightSpan& span) { return !is_bent(path, span, *gravity, noise_px); });
  return flights;
}

namespace {

constexpr int kFitRounds = 4;
constexpr double kStraySigmas = 4;
/// Maximum gap between two flights with only an impact between them, in frames.
constexpr double kLongestGap = 4.5;
constexpr double kMinNoise_px = .03;
/// Centres are no better than this, however little they scatter: shadows and the scene behind the
/// grain shift them alike in many frames.
constexpr double kMinError_px = .1;
/// Errors of frames this close in time are correlated, as videos at 240 frames per second show.
constexpr double kAlike_s = 1. / 60;
/// Air decelerates a sphere of radius r at speed v by 3 Cd p v^2 / (8 r q), with the densities p
/// and q of air and grain: Newton's drag law over the mass. This is 3 Cd p / (8 q), dimensionless,
/// as a standard deviation: 2e-4 for Cd = .55, as for spheres at Reynolds numbers of 500 to 2000
/// (R. Clift, J. R. Grace, M. E. Weber: Bubbles, Drops, and Particles, 1978, chapter 5), and q =
/// 1200 kg/m3; 8e-4 for non-spherical grains of 400 kg/m3. Based on the radius, not a terminal
/// speed, since it also holds in pixels and in slow-motion videos.
constexpr double kAir = 4e-4;

/// Unknowns differ greatly in magnitude: all are scaled first.
cv::Mat inverse_of(const cv::Mat& normal) {
  cv::Mat size, sizes, inverse;
  cv::sqrt(normal.diag(), size);
  sizes = size * size.t();
  cv::invert(normal / sizes, inverse, cv::DECOMP_SVD);
  return inverse / sizes;
}

}  // namespace

double top_s(const FlightCurve& curve, const FlightDynamics& pull) {
  return curve.t0_s - curve.v_px_s / pull.gravity;
}

double speed_at(const FlightCurve& curve, double time_s, const FlightDynamics& pull) {
  const double s = time_s - top_s(curve, pull);
  return pull.gravity * s - pull.drag * s * s * std::abs(s) / 3;
}

double height_at(const FlightCurve& curve, double time_s, const FlightDynamics& pull) {
  const double t = time_s - curve.t0_s;
  const double s = time_s - top_s(curve, pull);
  return curve.y0_px + t * (curve.v_px_s + .5 * pull.gravity * t) -
         pull.drag * s * s * s * std::abs(s) / 12;
}

double meeting_time_s(const FlightCurve& before, const FlightCurve& after,
                      const FlightDynamics& pull) {
  double time_s = .5 * (before.ends_s + after.begins_s);
  constexpr int kSteps = 4;  // the flights are nearly parabolas, whose difference is a line
  for (int step = 0; step < kSteps; ++step) {
    time_s += (height_at(after, time_s, pull) - height_at(before, time_s, pull)) /
              (speed_at(before, time_s, pull) - speed_at(after, time_s, pull));
  }
  return time_s;
}

FlightFit::FlightFit(const std::vector<SeenAt>& path, const Flights& flights,
                     double frame_interval_s, double frame_height_px, double radius_px)
    : interval_s_(frame_interval_s),
      most_readout_s_per_px_(std::min(frame_interval_s, 1. / 30) / frame_height_px),
      radius_px_(std::max(1.0, radius_px)),
      pull_{.gravity = flights.gravity_px_s2} {
  for (std::size_t k = 0; k < flights.spans.size(); ++k) {
    const auto& [from, to] = flights.spans[k];
    curves_.push_back({.t0_s = .5 * (path[from].time_s + path[to - 1].time_s),
                       .begins_s = path[from].time_s,
                       .ends_s = path[to - 1].time_s});
    for (std::size_t n = from; n < to; ++n) observations_.push_back({path[n], k});
  }
  drop_loose_ends();
  for (int round = 0; round < kFitRounds; ++round) {
    solve();
    drop_blurred();
    drop_strays();
  }
  solve();
}

double FlightFit::fitted_y(const Observation& one) const {
  return height_at(curves_[one.flight], one.seen.time_s + readout_ * one.seen.row_px, pull_);
}

/// One Gauss-Newton step; only readout and drag make it nonlinear, and only slightly.
void FlightFit::solve() {
  const auto flights = static_cast<int>(curves_.size());
  const int unknowns = 2 * flights + 3;
  const int gravity = unknowns - 3, drag = unknowns - 2, readout = unknowns - 1;
  cv::Mat normal = cv::Mat::zeros(unknowns, unknowns, CV_64F);
  cv::Mat right = cv::Mat::zeros(unknowns, 1, CV_64F);
  for (const Observation& one : observations_) {
    if (!one.is_used) continue;
    const FlightCurve& curve = curves_[one.flight];
    const double time_s = one.seen.time_s + readout_ * one.seen.row_px;
    const double t = time_s - curve.t0_s;
    // The speeds are still unknown in the first round.
    const double s = curve.v_px_s == 0 ? 0 : time_s - top_s(curve, pull_);
    const int at = 2 * static_cast<int>(one.flight);
    const std::array<std::pair<int, double>, 5> terms = {
        {{at, 1},
         {at + 1, t},
         {gravity, .5 * t * t},
         {drag, -s * s * s * std::abs(s) / 12},
         {readout, s == 0 ? 0 : one.seen.row_px * speed_at(curve, time_s, pull_)}}};
    const double off = one.seen.y_px - height_at(curve, time_s, pull_);
    for (const auto& [i, a] : terms) {
      for (const auto& [j, b] : terms) normal.at<double>(i, j) += a * b;
      right.at<double>(i) += a * off;
    }
  }
  const auto know = [&](int which, double value, double sd) {
    const double weight = std::pow(std::max(noise_px_, kMinNoise_px) / sd, 2);
    normal.at<double>(which, which) += weight;
    right.at<double>(which) -= weight * value;
  };
  know(readout, readout_, most_readout_s_per_px_);
  know(drag, pull_.drag, kAir / radius_px_ * pull_.gravity * pull_.gravity);
  covariance_ = inverse_of(normal);
  const cv::Mat step = covariance_ * right;
  for (int k = 0; k < flights; ++k) {
    curves_[static_cast<std::size_t>(k)].y0_px += step.at<double>(2 * k);
    curves_[static_cast<std::size_t>(k)].v_px_s += step.at<double>(2 * k + 1);
  }
  pull_.gravity += step.at<double>(gravity);
  pull_.drag += step.at<double>(drag);
  readout_ += step.at<double>(readout);
  read_residuals();
}

void FlightFit::read_residuals() {
  double squares = 0, products = 0, before = 0;
  const Observation* last = nullptr;
  sightings_ = 0;
  for (FlightCurve& curve : curves_) curve.sightings = 0;
  for (const Observation& one : observations_) {
    if (!one.is_used) continue;
    const double off = one.seen.y_px - fitted_y(one);
    squares += off * off;
    if (last != nullptr && last->flight == one.flight) products += off * before;
    before = off;
    last = &one;
    ++sightings_;
    ++curves_[one.flight].sightings;
  }
  const auto flights = static_cast<int>(curves_.size());
  const int freedom = std::max(1, sightings_ - 2 * flights - 1);
  noise_px_ = std::max(kMinNoise_px, std::sqrt(squares / freedom));
  correlation_ = squares > 0 ? std::clamp(products / squares, 0.0, .8) : 0;
}

/// If no other flight follows immediately, the first and last sightings may be partly held, or
/// partly past an impact that was not seen.
void FlightFit::drop_loose_ends() {
  constexpr std::size_t kEnough = 6;
  const auto is_loose = [&](std::size_t before, std::size_t after) {
    return after >= curves_.size() ||
           curves_[after].begins_s - curves_[before].ends_s > kLongestGap * interval_s_;
  };
  for (std::size_t n = 0; n < observations_.size(); ++n) {
    const std::size_t k = observations_[n].flight;
    const bool is_first = n == 0 || observations_[n - 1].flight != k;
    const bool is_last = n + 1 == observations_.size() || observations_[n + 1].flight != k;
    const auto length = std::count_if(observations_.begin(), observations_.end(),
                                      [&](const Observation& one) { return one.flight == k; });
    if (length < static_cast<std::ptrdiff_t>(kEnough)) continue;
    if (is_first && (k == 0 || is_loose(k - 1, k))) observations_[n].is_used = false;
    if (is_last && is_loose(k, k + 1)) observations_[n].is_used = false;
  }
}

/// Frames whose exposure may include an impact show the grain in two flights at once.
void FlightFit::drop_blurred() {
  for (std::size_t k = 0; k + 1 < curves_.size(); ++k) {
    if (!has_impact_after(k)) continue;
    const double impact_s = impact_time_s(k);
    for (Observation& one : observations_) {
      if (one.flight != k && one.flight != k + 1) continue;
      const double time_s = one.seen.time_s + readout_ * one.seen.row_px;
      const double off_s = (one.flight == k ? 1 : -1) * (impact_s - time_s);
      constexpr double kExposure = .6;
      if (off_s < kExposure * interval_s_) one.is_used = false;
    }
  }
}

void FlightFit::drop_strays() {
  for (Observation& one : observations_) {
    const double off = std::abs(one.seen.y_px - fitted_y(one));
    if (off > kStraySigmas * noise_px_) one.is_used = false;
  }
}

bool FlightFit::has_impact_after(std::size_t k) const {
  if (k + 1 >= curves_.size()) return false;
  const FlightCurve& before = curves_[k];
  const FlightCurve& after = curves_[k + 1];
  constexpr int kFewest = 4;
  if (before.sightings < kFewest || after.sightings < kFewest) return false;
  const double gap_s = after.begins_s - before.ends_s;
  constexpr double kSlack = 1.5;
  if (gap_s > kLongestGap * interval_s_) return false;
  const double time_s = impact_time_s(k);
  return speed_at(before, time_s, pull_) > 0 && speed_at(after, time_s, pull_) < 0 &&
         time_s > before.ends_s - kSlack * interval_s_ &&
         time_s < after.begins_s + kSlack * interval_s_;
}

double FlightFit::impact_time_s(std::size_t k) const {
  return meeting_time_s(curves_[k], curves_[k + 1], pull_);
}

/// Factor from the noise of one sighting to 95 %: correlated residuals carry less information.
double FlightFit::factor() const {
  const auto flights = static_cast<int>(curves_.size());
  const double inflation =
      std::sqrt((1 + correlation_) / (1 - correlation_) * std::max(1.0, kAlike_s / interval_s_));
  const double freedom =
      std::max(2.0, (sightings_ - 2 * flights - 1) * (1 - correlation_) / (1 + correlation_));
  const boost::math::students_t student(freedom);
  return boost::math::quantile(student, .975) * std::max(noise_px_, kMinError_px) * inflation;
}

Estimate FlightFit::estimate(std::size_t before, std::size_t after, const Reading& reading) const {
  const double value = reading(curves_[before], curves_[after], pull_);
  const int unknowns = covariance_.rows;
  const double length_s = std::max(1e-3, curves_[before].ends_s - curves_[before].begins_s);
  const double step_px = std::max(1e-4, noise_px_);
  cv::Mat slopes = cv::Mat::zeros(unknowns, 1, CV_64F);
  const auto slope = [&](double step, auto change) {
    const auto moved = [&](double by) {
      FlightCurve a = curves_[before], b = curves_[after];
      FlightDynamics pull = pull_;
      change(a, b, pull, by);
      return reading(a, b, pull);
    };
    return (moved(step) - moved(-step)) / (2 * step);
  };
  const int a = 2 * static_cast<int>(before), b = 2 * static_cast<int>(after);
  const double step_s = step_px / length_s;
  using Curve = FlightCurve;
  slopes.at<double>(a) =
      slope(step_px, [](Curve& x, Curve&, FlightDynamics&, double by) { x.y0_px += by; });
  slopes.at<double>(a + 1) =
      slope(step_s, [](Curve& x, Curve&, FlightDynamics&, double by) { x.v_px_s += by; });
  if (after != before) {
    slopes.at<double>(b) =
        slope(step_px, [](Curve&, Curve& y, FlightDynamics&, double by) { y.y0_px += by; });
    slopes.at<double>(b + 1) =
        slope(step_s, [](Curve&, Curve& y, FlightDynamics&, double by) { y.v_px_s += by; });
  }
  slopes.at<double>(unknowns - 3) =
      slope(step_s / length_s,
            [](Curve&, Curve&, FlightDynamics& pull, double by) { pull.gravity += by; });
  slopes.at<double>(unknowns - 2) =
      slope(step_s / length_s / length_s / length_s,
            [](Curve&, Curve&, FlightDynamics& p, double by) { p.drag += by; });
  const cv::Mat variance = slopes.t() * covariance_ * slopes;
  return {value, factor() * std::sqrt(std::max(0.0, variance.at<double>(0)))};
}

}  // namespace repose::vision
