#pragma once

#include <functional>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/track/flight_finder.h"
#include "vision/track/track.h"

namespace repose::vision {

/// What accelerates a grain in flight [px].
struct Pull {
  double gravity = 0;  ///< per s2
  double drag = 0;  ///< deceleration by air at the speed v, as a part of (v / gravity)^2: px / s4
};

/// y = y0 + v (t - t0) + g (t - t0)^2 / 2 - drag s^3 |s| / 12, y downwards [px], s the time from
/// the highest point on: the last term is the air's, to first order.
struct FlightCurve {
  double t0_s = 0;
  double y0_px = 0;
  double v_px_s = 0;
  double begins_s = 0;  ///< first and last sighting
  double ends_s = 0;
  int sightings = 0;
};

/// Flights of one grain, fitted together by least squares: each with its own place and speed, all
/// with one gravity, one drag of the air, and one readout time a row (cameras that expose rows one
/// after the other see what falls too fast, and what rises too slow). What the last two can be at
/// most is known beforehand, and enters the fit: of the air by the grain's size.
class FlightFit {
 public:
  /// @param frame_interval_s  what readout and exposure cannot be longer than
  /// @param radius_px  of the grain
  FlightFit(const std::vector<SeenAt>& path, const Flights& flights, double frame_interval_s,
            double frame_height_px, double radius_px);

  const std::vector<FlightCurve>& curves() const { return curves_; }
  const Pull& pull() const { return pull_; }
  double readout_s_per_px() const { return readout_; }
  double noise_px() const { return noise_px_; }
  int sightings() const { return sightings_; }

  /// Whether the grain was seen to hit something between flights k and k + 1, with nothing but the
  /// impact between them.
  bool has_impact_after(std::size_t k) const;
  double impact_time_s(std::size_t k) const;

  /// Anything that follows from two flights and gravity, with its interval.
  using Reading =
      std::function<double(const FlightCurve& before, const FlightCurve& after, const Pull& pull)>;
  Estimate estimate(std::size_t before, std::size_t after, const Reading& reading) const;

 private:
  struct Observation {
    SeenAt seen;
    std::size_t flight = 0;
    bool is_used = true;
  };
  void solve();
  void read_residuals();
  void drop_loose_ends();
  void drop_blurred();
  void drop_strays();
  double fitted_y(const Observation& one) const;
  double factor() const;

  std::vector<Observation> observations_;
  std::vector<FlightCurve> curves_;
  double interval_s_;
  double most_readout_s_per_px_;
  double radius_px_;
  Pull pull_;
  double readout_ = 0;
  double noise_px_ = 0;
  double correlation_ = 0;
  int sightings_ = 0;
  cv::Mat covariance_;  ///< of y0 and v of each flight, gravity, drag, readout, for a noise of 1 px
};

/// When two flights meet.
double meeting_time_s(const FlightCurve& before, const FlightCurve& after, const Pull& pull);

/// When a flight is, or would be, at its highest.
double top_s(const FlightCurve& curve, const Pull& pull);

/// Speed downwards [px/s].
double speed_at(const FlightCurve& curve, double time_s, const Pull& pull);
double height_at(const FlightCurve& curve, double time_s, const Pull& pull);

}  // namespace repose::vision
