#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/track/track.h"

namespace repose::vision {

/// The centre of a grain in one frame.
struct SeenAt {
  double time_s = 0;
  double x_px = 0;
  double y_px = 0;    ///< downwards
  double row_px = 0;  ///< in the frame, from its middle: rows may be exposed one after the other
};

/// Sightings [from, to) in one free flight.
struct FlightSpan {
  std::size_t from = 0;
  std::size_t to = 0;
};

struct Flights {
  std::vector<FlightSpan> spans;
  double gravity_px_s2 = 0;
};

/// Parts of a path that are free flights under a common gravity, which is inferred from the path
/// itself.
///
/// Of all ways to cut the path into parabolas of nearly the same curvature and loose sightings
/// (held, at rest, blurred by an impact), the one with the lowest cost is taken. A flight must be
/// curved clearly beyond the noise.
Flights find_flights(const std::vector<SeenAt>& path, double noise_px);

struct Parabola {
  double acceleration = 0;
  double rms_px = 0;
  double error = 0;  ///< standard error of the acceleration
};

/// Least squares through `count` sightings starting at `from`: their heights against time.
Parabola parabola_through(const std::vector<SeenAt>& path, std::size_t from, std::size_t count);

/// What accelerates a grain in flight [px].
struct FlightDynamics {
  double gravity = 0;  ///< per s2
  double drag = 0;     ///< deceleration by air at the speed v, over (v / gravity)^2: px / s4
};

/// y = y0 + v (t - t0) + g (t - t0)^2 / 2 - drag s^3 |s| / 12, y downwards [px], s the time since
/// the highest point: the last term is air drag, to first order.
struct FlightCurve {
  double t0_s = 0;
  double y0_px = 0;
  double v_px_s = 0;
  double begins_s = 0;  ///< first and last sighting
  double ends_s = 0;
  int sightings = 0;
};

/// Flights of one grain, fitted together by least squares: each with its own place and speed, all
/// with one gravity, one air drag, and one readout time per row (a rolling shutter makes falling
/// objects look too fast and rising ones too slow). The plausible size of the last two is a prior
/// of the fit: for the air by the grain's size.
class FlightFit {
 public:
  /// @param frame_interval_s  upper limit of readout and exposure
  /// @param radius_px  of the grain
  FlightFit(const std::vector<SeenAt>& path, const Flights& flights, double frame_interval_s,
            double frame_height_px, double radius_px);

  const std::vector<FlightCurve>& curves() const { return curves_; }
  const FlightDynamics& pull() const { return pull_; }
  double readout_s_per_px() const { return readout_; }
  double noise_px() const { return noise_px_; }
  int sightings() const { return sightings_; }

  /// Whether the grain was seen to hit something between flights k and k + 1, with nothing but the
  /// impact between them.
  bool has_impact_after(std::size_t k) const;
  double impact_time_s(std::size_t k) const;

  /// A function of two flights and gravity, with its interval.
  using Reading = std::function<double(const FlightCurve& before, const FlightCurve& after,
                                       const FlightDynamics& pull)>;
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
  FlightDynamics pull_;
  double readout_ = 0;
  double noise_px_ = 0;
  double correlation_ = 0;
  int sightings_ = 0;
  cv::Mat covariance_;  ///< of y0 and v of each flight, gravity, drag, readout, for a noise of 1 px
};

/// When two flights meet.
double meeting_time_s(const FlightCurve& before, const FlightCurve& after,
                      const FlightDynamics& pull);

/// When a flight is, or would be, at its highest.
double top_s(const FlightCurve& curve, const FlightDynamics& pull);

/// Speed downwards [px/s].
double speed_at(const FlightCurve& curve, double time_s, const FlightDynamics& pull);
double height_at(const FlightCurve& curve, double time_s, const FlightDynamics& pull);

}  // namespace repose::vision
