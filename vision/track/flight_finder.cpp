#include "vision/track/flight_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <opencv2/core.hpp>

#include "vision/track/parabola.h"

namespace repose::vision {
namespace {

constexpr std::size_t kFewestInFlight = 4;
/// Costs in squared deviations: of a loose sighting, and of a flight more.
constexpr double kLoose = 16;
constexpr double kFlight = 20;
/// How far the middle of a flight's parabola must lie from its chord.
constexpr double kLeastSag_px = 2;
constexpr double kLeastSag_sigmas = 6;

/// The bend of those stretches that parabolas fit, the highest ones before all.
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
      const double least_px = kLeastSag_sigmas * std::max(parabola.rms_px, .1 * noise_px);
      if (parabola.rms_px > 2.5 * noise_px || sag_px < std::max(kLeastSag_px, least_px)) continue;
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

/// A parabola of nearly the gravity through sightings that are added one by one, relative to it.
class NearlyFalling {
 public:
  /// @param unit_s  makes the sums alike in size
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
  /// Squared deviations, that of the gravity too; infinite where it is another one.
  double squares() const {
    const cv::Vec3d solution = normal_.solve(right_, cv::DECOMP_CHOLESKY);
    const double most = 3 * kTolerated * gravity_ * unit_s_ * unit_s_;
    if (std::abs(solution[2]) > most) return std::numeric_limits<double>::infinity();
    return std::max(0.0, squares_ - right_.dot(solution));
  }

 private:
  /// Air, lens and readout change the bend of a flight as a whole.
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

/// Whether a flight is no short stretch of a grain that lies still, to which any line is near.
bool is_bent(const std::vector<SeenAt>& path, const FlightSpan& span, double gravity,
             double noise_px) {
  const double length_s = path[span.to - 1].time_s - path[span.from].time_s;
  const double sag_px = gravity * length_s * length_s / 8;
  if (sag_px < std::max(kLeastSag_px, kLeastSag_sigmas * noise_px)) return false;
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

}  // namespace repose::vision
