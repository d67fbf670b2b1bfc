#include <cmath>

#include <gmock/gmock.h>

#include "vision/track/drop_candidate.h"
#include "vision/track/flight_fit.h"

namespace repose::vision {
namespace {

constexpr double kGravity = 9800;  // px/s2: a pixel is about a millimetre
constexpr double kFrame_s = 1. / 120;
constexpr double kFrameHeight_px = 720;
constexpr double kRestitution = .6;

/// A camera's view of a grain held for a while, dropped from 300 px and bouncing to rest.
struct Drop {
  double drag_per_px = 0;  ///< deceleration by air / speed squared
  double readout_s = 0;    ///< of a frame
  double noise_px = .05;
  unsigned seed = 1;

  std::vector<SeenAt> path() const {
    constexpr double kStep_s = 1e-5, kHeld_s = .2, kFloor_px = 300, kEnd_s = 1.6;
    std::vector<SeenAt> path;
    double y = 0, v = 0;
    int frame = 0;
    unsigned state = 2654435761U * seed;
    for (double t = 0; t < kEnd_s; t += kStep_s) {
      if (t > kHeld_s) v += (kGravity - drag_per_px * v * std::abs(v)) * kStep_s;
      y += v * kStep_s;
      if (y > kFloor_px && v > 0) {
        y = kFloor_px;
        v = v > 100 ? -kRestitution * v : 0;
      }
      const double row = y - 200;
      if (t < frame * kFrame_s + readout_s * row / kFrameHeight_px) continue;
      double noise = 0;
      for (int k = 0; k < 4; ++k) {
        state = state * 1664525U + 1013904223U;
        noise += state / 4294967296.0 - .5;
      }
      path.push_back({.time_s = frame * kFrame_s,
                      .x_px = 0,
                      .y_px = y + 1.7 * noise_px * noise,
                      .row_px = row});
      ++frame;
    }
    return path;
  }
};

FlightFit fit_of(const std::vector<SeenAt>& path) {
  constexpr double kRadius_px = 4;
  return {path, find_flights(path, .5), kFrame_s, kFrameHeight_px, kRadius_px};
}

Estimate restitution(const FlightFit& fit, std::size_t k) {
  return fit.estimate(
      k, k + 1,
      [](const FlightCurve& before, const FlightCurve& after, const FlightDynamics& pull) {
        const double time_s = meeting_time_s(before, after, pull);
        return -speed_at(after, time_s, pull) / speed_at(before, time_s, pull);
      });
}

TEST(Flights, AreThePartsBetweenReleaseImpactsAndRest) {
  const Flights flights = find_flights(Drop{}.path(), .5);
  EXPECT_NEAR(flights.gravity_px_s2, kGravity, .02 * kGravity);
  ASSERT_GE(flights.spans.size(), 3U);
  EXPECT_NEAR(static_cast<double>(flights.spans[0].from) * kFrame_s, .2, 2.5 * kFrame_s);
  const double fall_s = std::sqrt(2 * 300 / kGravity);
  EXPECT_NEAR(static_cast<double>(flights.spans[0].to) * kFrame_s, .2 + fall_s, 1.5 * kFrame_s);
  // The grain is at rest in the end.
  const double flown_s = fall_s * (1 + 2 * kRestitution / (1 - kRestitution));
  EXPECT_LT(static_cast<double>(flights.spans.back().to) * kFrame_s, .2 + flown_s);
}

TEST(Flights, AreNoneOfWhatLiesStillOrMovesEvenly) {
  std::vector<SeenAt> still, even;
  for (int k = 0; k < 200; ++k) {
    const double jitter = .05 * ((k * 7919) % 13 - 6) / 6;
    still.push_back({.time_s = k * kFrame_s, .y_px = 100 + jitter});
    even.push_back({.time_s = k * kFrame_s, .y_px = 2 * k + jitter});
  }
  EXPECT_TRUE(find_flights(still, .5).spans.empty());
  EXPECT_TRUE(find_flights(even, .5).spans.empty());
}

struct Tally {
  int held = 0;
  double mean_error = 0;
};

/// Tally of the first bounce over drops that differ only in noise.
Tally tally_of(Drop drop) {
  constexpr int kDrops = 60;
  Tally tally;
  for (int k = 1; k <= kDrops; ++k) {
    drop.seed = static_cast<unsigned>(k);
    const Estimate first = restitution(fit_of(drop.path()), 0);
    const double error = first.value - kRestitution;
    tally.held += std::abs(error) <= first.uncertainty ? 1 : 0;
    tally.mean_error += error / kDrops;
  }
  return tally;
}

// 95 % of 60 is 57; less 3 standard deviations of that number, 52.
TEST(FlightFit, IntervalsHoldTheRestitutionAsOftenAsTheySay) {
  const Tally tally = tally_of({});
  EXPECT_GE(tally.held, 52);
  EXPECT_NEAR(tally.mean_error, 0, .001);
}

// At 2.4 m/s air drag is 9 % of gravity: a light grain of 8 m/s terminal speed. Without air in the
// fit, restitution comes out 2 % low.
TEST(FlightFit, TakesTheAirOut) {
  const double terminal_px_s = 8 / 9.80665 * kGravity;
  const Tally tally = tally_of({.drag_per_px = kGravity / (terminal_px_s * terminal_px_s)});
  EXPECT_GE(tally.held, 45);
  EXPECT_NEAR(tally.mean_error, 0, .002);
}

// Row-by-row readout makes falling grains seem faster and rising ones slower.
TEST(FlightFit, TakesTheReadoutOfRowsOut) {
  const Drop drop{.readout_s = .008};
  EXPECT_NEAR(fit_of(drop.path()).readout_s_per_px() * kFrameHeight_px, .008, .001);
  const Tally tally = tally_of(drop);
  EXPECT_GE(tally.held, 52);
  EXPECT_NEAR(tally.mean_error, 0, .001);
}

// The bound on air drag depends on the grain's size in pixels, which is independent of the clock.
TEST(FlightFit, IsTheSameInAFilmThatPlaysSlowerThanItWasTaken) {
  std::vector<SeenAt> path = Drop{}.path();
  const Estimate plain = restitution(fit_of(path), 0);
  constexpr double kSlower = 4;
  for (SeenAt& one : path) one.time_s *= kSlower;
  const FlightFit slow(path, find_flights(path, .5), kSlower * kFrame_s, kFrameHeight_px, 4);
  EXPECT_NEAR(restitution(slow, 0).value, plain.value, .002);
  EXPECT_NEAR(restitution(slow, 0).uncertainty, plain.uncertainty, .3 * plain.uncertainty);
}

TEST(FlightFit, OfASmallGrainHasAWiderIntervalSinceAirMaySlowItMore) {
  // A fall and a rise, which alone say little about the air.
  std::vector<SeenAt> path = Drop{.noise_px = .2}.path();
  std::erase_if(path, [](const SeenAt& one) { return one.time_s > .7; });
  const auto interval = [&](double radius_px) {
    const FlightFit fit(path, find_flights(path, .5), kFrame_s, kFrameHeight_px, radius_px);
    return restitution(fit, 0).uncertainty;
  };
  EXPECT_GT(interval(2), 1.1 * interval(12));
}

TEST(DropCandidate, JoinsAFlightThatTheReadoutOfRowsCutsInTwo) {
  const Drop drop{.readout_s = .03};
  FilmGrains film;
  film.survey.interval_s = kFrame_s;
  film.survey.size = cv::Size(960, static_cast<int>(kFrameHeight_px));
  GrainPath path;
  for (const SeenAt& one : drop.path()) {
    Sighting sighting;
    sighting.time_s = one.time_s;
    sighting.blob.centre = {100, one.y_px + .5 * kFrameHeight_px - 200};
    sighting.blob.area_px = 50;
    path.push_back(sighting);
  }
  const DropCandidate candidate = drop_candidate(path, film);
  ASSERT_TRUE(candidate.fit);
  ASSERT_FALSE(candidate.impacts.empty());
  const std::size_t pieces = find_flights(candidate.seen, .5).spans.size();
  EXPECT_LT(candidate.flights.spans.size(), pieces) << "so that there is something to join";
  EXPECT_NEAR(restitution(*candidate.fit, candidate.impacts.front()).value, kRestitution, .01);
  for (std::size_t k = 0; k + 2 < candidate.flights.spans.size(); ++k) {
    EXPECT_TRUE(candidate.fit->has_impact_after(k)) << k;
  }
}

TEST(FlightFit, MoreNoiseGivesAWiderInterval) {
  const FlightFit clear = fit_of(Drop{.noise_px = .05}.path());
  const FlightFit noisy = fit_of(Drop{.noise_px = .4}.path());
  ASSERT_TRUE(clear.has_impact_after(0) && noisy.has_impact_after(0));
  EXPECT_GT(restitution(noisy, 0).uncertainty, 1.5 * restitution(clear, 0).uncertainty);
}

}  // namespace
}  // namespace repose::vision
