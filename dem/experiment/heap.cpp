#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "dem/experiment/bench_setup.h"
#include "dem/experiment/course.h"
#include "dem/experiment/experiment.h"
#include "dem/experiment/heap_fill.h"
#include "dem/experiment/heap_settling.h"
#include "dem/experiment/placing.h"
#include "dem/experiment/rest_test.h"
#include "dem/experiment/surface_profile.h"

namespace repose::dem {
namespace {

constexpr double kLongestLift_s = 600;
/// Heaps lower than this many grain diameters are layers.
constexpr double kLowestHeap = 2.5;
/// Shares of the course when the lift begins and when the tube is away.
constexpr double kLiftFrom = .35;
constexpr double kLiftTo = .9;

void check_sizes(const HeapProtocol& protocol, Faults& faults) {
  const auto above_0 = [&faults](const char* name, double value) {
    faults.require(
        std::isfinite(value) && value > 0,
        fmt::format("heap.{} is {:g}. Rule: above 0. Fix: the size on the bench.", name, value));
  };
  above_0("tube_diameter_m", protocol.tube_diameter_m);
  above_0("tube_height_m", protocol.tube_height_m);
  above_0("tube_thickness_m", protocol.tube_thickness_m);
  above_0("plate_m", protocol.plate_m);
  above_0("plate_thickness_m", protocol.plate_thickness_m);
}

void check(const Bench& bench, const HeapProtocol& protocol) {
  Faults faults;
  find_faults(bench, faults);
  check_sizes(protocol, faults);
  const double outer = protocol.tube_diameter_m + 2 * protocol.tube_thickness_m;
  faults.require(!(outer > protocol.plate_m),
                 fmt::format("heap.tube_diameter_m is {:g}, with its wall {:g}. Rule: it stands on "
                             "the plate, {:g} m. Fix: a narrower tube or a larger plate.",
                             protocol.tube_diameter_m, outer, protocol.plate_m));
  const double grain = 2 * bench.grain.reach_m();
  faults.require(
      !(protocol.tube_diameter_m < 1.05 * grain),
      fmt::format("heap.tube_diameter_m is {:g}. Rule: wider than a grain is long, {:.4g} "
                  "m. Fix: a wider tube.",
                  protocol.tube_diameter_m, grain));
  faults.require(
      !(protocol.tube_height_m < grain),
      fmt::format("heap.tube_height_m is {:g}. Rule: higher than a grain is long, {:.4g} "
                  "m. Fix: a taller tube.",
                  protocol.tube_height_m, grain));
  faults.require(
      protocol.lift_speed_m_s > 0 &&
          protocol.tube_height_m / protocol.lift_speed_m_s <= kLongestLift_s,
      fmt::format("heap.lift_speed_m_s is {:g}. Rule: above 0, and fast enough to lift the tube "
                  "by its height in {:g} s. Fix: the speed on the bench, such as 0.03.",
                  protocol.lift_speed_m_s, kLongestLift_s));
  faults.require(!protocol.grains || *protocol.grains >= 1,
                 fmt::format("heap.grains is {}. Rule: 1 or more. Fix: leave it out to fill the "
                             "tube.",
                             protocol.grains.value_or(0)));
  faults.throw_if_any();
}

int count_present(const Simulation& simulation) {
  int present = 0;
  for (int k = 0; k < simulation.grain_count(); ++k) present += simulation.is_present(k) ? 1 : 0;
  return present;
}

/// Highest point of all grains, m; 0 without grains.
double highest_point_m(const Course& course) {
  double highest = 0;
  for (int k = 0; k < course.simulation().grain_count(); ++k) {
    if (!course.simulation().is_present(k)) continue;
    highest = std::max(highest, highest_m(course.shape(), course.simulation().grain(k)));
  }
  return highest;
}

void begin_lift(Course& course, const HeapProtocol& protocol) {
  Simulation& simulation = course.simulation();
  simulation.set_motions(kHeapTube, {{.velocity = protocol.lift_speed_m_s * Vector::UnitZ(),
                                      .start_s = simulation.time_s()}});
  HeapProgress& progress = course.progress();
  progress.stage = HeapStage::lift;
  progress.grains = count_present(simulation);
  progress.start_m = highest_point_m(course);
}

/// Lifts the tube until no grain reaches up to its lower rim, and takes it away.
void lift(Course& course) {
  Simulation& simulation = course.simulation();
  const RestTest rest(simulation.setup());
  const std::int64_t steps = course.steps_of(rest.interval_s());
  const double start = course.progress().start_m;
  for (;;) {
    const double highest = highest_point_m(course);
    const double rim = simulation.wall(kHeapTube).pose.position.z();
    if (rim > highest) break;
    // Grains that are not carried along stay below where the highest was.
    if (rim > start + course.shape().reach_m()) {
      throw NoReading(
          fmt::format("heap: grains hang in the tube, its lower rim now {:.3g} m up. "
                      "Fix: a wider tube, or less friction.",
                      rim));
    }
    course.advance(steps);
    course.tell(kLiftFrom + (kLiftTo - kLiftFrom) * rim / (.3 * start));
  }
  simulation.remove_wall(kHeapTube);
}

Course filled(Course filling, const Bench& bench, const HeapProtocol& protocol,
              std::uint64_t seed) {
  Course course = fill_tube(std::move(filling), bench, protocol, seed);
  begin_lift(course, protocol);
  return course;
}

/// From the lift on, or from where it was broken off after that.
Repeat finish_heap(Course course, const Bench& bench, std::uint64_t seed) {
  if (course.progress().stage == HeapStage::lift) {
    lift(course);
    begin_settling(course, HeapStage::settle);
  }
  const bool is_at_rest = settle(course, kLiftTo);
  const int grains = course.progress().grains;
  const int on_plate = count_present(course.simulation());
  if (on_plate == 0) {
    throw NoReading(
        fmt::format("heap: all {} grains left the plate. Fix: a larger plate, or more "
                    "friction.",
                    grains));
  }
  const std::vector<ClumpSphere> spheres = placed_spheres(course.simulation());
  const SurfaceReading surface = measure_surface(spheres);
  const SurfaceReading inner = measure_surface(spheres, {.window_from = .3, .window_to = .7});
  const bool is_layer = surface.height_m < kLowestHeap * diameter_m(bench.grain);
  return course.finish(surface.angle_deg, seed,
                       {{"grains", grains},
                        {"grains_on_plate", on_plate},
                        {"grains_off_plate", grains - on_plate},
                        {"height_mm", 1e3 * surface.height_m},
                        {"base_radius_mm", 1e3 * surface.base_radius_m},
                        {"between_views_deg", surface.between_views_deg},
                        {"angle_xz_deg", surface.first_view_deg},
                        {"inner_window_deg", inner.angle_deg},
                        {"no_heap", is_layer ? 1 : 0},
                        {"at_rest", is_at_rest ? 1 : 0},
                        {"time_s", course.simulation().time_s()}});
}

}  // namespace

Repeat run_heap(const Bench& bench, const HeapProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report, const RunRecord& record) {
  check(bench, protocol);
  return finish_heap(filled(empty_tube(bench, protocol, {report, record}), bench, protocol, seed),
                     bench, seed);
}

Repeat resume_heap(const Bench& bench, const HeapProtocol& protocol, std::uint64_t seed,
                   const HeapRestart& from, const ProgressReport& report, const RunRecord& record) {
  check(bench, protocol);
  SimulationSetup setup = from.setup;
  setup.threads = bench.threads;
  Course course(Simulation(std::move(setup), from.checkpoint), {report, record}, from.progress);
  course.advance(from.progress.steps_left);
  const bool is_full = from.progress.stage > HeapStage::settle_in_tube;
  return finish_heap(is_full ? std::move(course) : filled(std::move(course), bench, protocol, seed),
                     bench, seed);
}

}  // namespace repose::dem
