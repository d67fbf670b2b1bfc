#include "dem/experiment/heap.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "base/units.h"
#include "dem/experiment/entry.h"
#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_run.h"
#include "dem/experiment/filling.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/rest_test.h"

namespace repose::dem {

namespace {

constexpr double kColumnsPerRadius = 20;

void check(const std::vector<ClumpSphere>& spheres, int views) {
  base::Faults errors;
  errors.require(views >= 1, {.subject = "views",
                              .value = fmt::format("is {}", views),
                              .rule = "1 or more",
                              .fix = "18."});
  const bool is_above = std::any_of(spheres.begin(), spheres.end(), [](const ClumpSphere& sphere) {
    return sphere.centre.z() + sphere.radius > 0;
  });
  errors.require(is_above, {.value = "there is no heap: no sphere reaches above the ground"});
  errors.throw_if_any();
}

double mean_radius(const std::vector<ClumpSphere>& spheres) {
  double sum = 0;
  for (const ClumpSphere& sphere : spheres) sum += sphere.radius;
  return sum / static_cast<double>(spheres.size());
}

/// Raises the columns under a sphere to its upper side; `at` is its centre's column.
void raise_columns(std::vector<double>& height_m, const ClumpSphere& sphere, double at,
                   double column_m) {
  const double reach = sphere.radius / column_m;
  const auto first = static_cast<std::size_t>(std::max(0.0, std::ceil(at - reach)));
  for (std::size_t k = first; k < height_m.size() && static_cast<double>(k) <= at + reach; ++k) {
    const double off = (static_cast<double>(k) - at) * column_m;
    const double dome = std::sqrt(std::max(0.0, sphere.radius * sphere.radius - off * off));
    height_m[k] = std::max(height_m[k], sphere.centre.z() + dome);
  }
}

/// The columns around the highest one, up to the first gap on either side.
std::vector<double> connected_part(const std::vector<double>& height_m) {
  const auto highest = std::max_element(height_m.begin(), height_m.end());
  auto first = highest;
  while (first != height_m.begin() && *(first - 1) > 0) --first;
  auto last = highest;
  while (last != height_m.end() && *last > 0) ++last;
  return {first, last};
}

Envelope envelope_at(const std::vector<ClumpSphere>& spheres, double azimuth_rad) {
  const Vector across(std::cos(azimuth_rad), std::sin(azimuth_rad), 0);
  double from = std::numeric_limits<double>::infinity();
  double to = -from;
  for (const ClumpSphere& sphere : spheres) {
    from = std::min(from, across.dot(sphere.centre) - sphere.radius);
    to = std::max(to, across.dot(sphere.centre) + sphere.radius);
  }
  const double column_m = mean_radius(spheres) / kColumnsPerRadius;
  std::vector<double> height_m(static_cast<std::size_t>((to - from) / column_m) + 1, 0.0);
  for (const ClumpSphere& sphere : spheres) {
    const double at = (across.dot(sphere.centre) - from) / column_m;
    raise_columns(height_m, sphere, at, column_m);
  }
  return {.azimuth_rad = azimuth_rad, .column_m = column_m, .height_m = connected_part(height_m)};
}

}  // namespace

std::vector<Envelope> heap_envelopes(const std::vector<ClumpSphere>& spheres, int views) {
  check(spheres, views);
  std::vector<Envelope> envelopes;
  envelopes.reserve(static_cast<std::size_t>(views));
  for (int view = 0; view < views; ++view) {
    envelopes.push_back(envelope_at(spheres, std::numbers::pi * view / views));
  }
  return envelopes;
}

double height_m(const std::vector<Envelope>& envelopes) {
  double highest = 0;
  for (const Envelope& envelope : envelopes) {
    for (const double height : envelope.height_m) highest = std::max(highest, height);
  }
  return highest;
}

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLongestLift_s = 600;
/// Number of views for a heap's envelopes.
constexpr int kViews = 18;
/// Fractions of the run at which the lift begins and the tube is removed.
constexpr double kLiftFrom = .35;
constexpr double kLiftTo = .9;

void check_sizes(const HeapProtocol& protocol, base::Faults& errors) {
  const auto above_0 = [&errors](const char* name, double value) {
    errors.require(std::isfinite(value) && value > 0, {.subject = fmt::format("heap.{}", name),
                                                       .value = fmt::format("is {:g}", value),
                                                       .rule = "above 0",
                                                       .fix = "the size on the bench."});
  };
  above_0("tube_diameter_m", protocol.tube_diameter_m);
  above_0("tube_height_m", protocol.tube_height_m);
  above_0("tube_thickness_m", protocol.tube_thickness_m);
  above_0("plate_m", protocol.plate_m);
  above_0("plate_thickness_m", protocol.plate_thickness_m);
  above_0("camera_height_m", protocol.camera_height_m);
  errors.require(
      !(protocol.camera_height_m > protocol.camera_distance_m.value_or(kInfinity)),
      {.subject = "heap.camera_height_m",
       .value = fmt::format("is {:g}, heap.camera_distance_m {:g}", protocol.camera_height_m,
                            protocol.camera_distance_m.value_or(0)),
       .rule = "a level camera is no higher than it is far away",
       .fix = "the height of the lens over the plate on the bench."});
  errors.require(
      !protocol.camera_distance_m || *protocol.camera_distance_m >= protocol.plate_m,
      {.subject = "heap.camera_distance_m",
       .value = fmt::format("is {:g}, heap.plate_m {:g}", protocol.camera_distance_m.value_or(0),
                            protocol.plate_m),
       .rule = "the camera stands beside the plate, at least as far away as the plate is wide",
       .fix = "the distance from the heap's middle to the lens on the bench."});
}

void check_grains(const Model& model, const HeapProtocol& protocol, base::Faults& errors) {
  if (protocol.grains) {
    errors.require(*protocol.grains >= 1 && *protocol.grains <= kMaxGrains,
                   {.subject = "heap.grains",
                    .value = fmt::format("is {}", *protocol.grains),
                    .rule = fmt::format("1 to {}", kMaxGrains),
                    .fix = "leave it out to fill the tube."});
    return;
  }
  constexpr double kPacked = .6;
  const double radius = protocol.tube_diameter_m / 2;
  const double tube_m3 = std::numbers::pi * radius * radius * protocol.tube_height_m;
  const double full = kPacked * tube_m3 / model.grain.volume_m3;
  errors.require(
      !(full > kMaxGrains),
      {.subject = "heap.tube_diameter_m",
       .value = fmt::format("is {:g}, heap.tube_height_m {:g}: the tube holds about {:.2g} grains",
                            protocol.tube_diameter_m, protocol.tube_height_m, full),
       .rule = fmt::format("at most {}", kMaxGrains),
       .fix = "a smaller tube, or fewer grains by number."});
}

void check(const Model& model, const HeapProtocol& protocol) {
  base::Faults errors;
  find_errors(model, errors);
  check_sizes(protocol, errors);
  const double outer = protocol.tube_diameter_m + 2 * protocol.tube_thickness_m;
  errors.require(
      !(outer > protocol.plate_m),
      {.subject = "heap.tube_diameter_m",
       .value = fmt::format("is {:g}, with its wall {:g}", protocol.tube_diameter_m, outer),
       .rule = fmt::format("it stands on the plate, {:g} m", protocol.plate_m),
       .fix = "a narrower tube or a larger plate."});
  const double grain = 2 * largest_reach_m(model);
  errors.require(!(protocol.tube_diameter_m < 1.05 * grain),
                 {.subject = "heap.tube_diameter_m",
                  .value = fmt::format("is {:g}", protocol.tube_diameter_m),
                  .rule = fmt::format("wider than a grain is long, {:.4g} m", grain),
                  .fix = "a wider tube."});
  errors.require(!(protocol.tube_height_m < grain),
                 {.subject = "heap.tube_height_m",
                  .value = fmt::format("is {:g}", protocol.tube_height_m),
                  .rule = fmt::format("higher than a grain is long, {:.4g} m", grain),
                  .fix = "a taller tube."});
  errors.require(
      protocol.lift_speed_m_s > 0 &&
          protocol.tube_height_m / protocol.lift_speed_m_s <= kLongestLift_s,
      {.subject = "heap.lift_speed_m_s",
       .value = fmt::format("is {:g}", protocol.lift_speed_m_s),
       .rule = fmt::format("above 0, and fast enough to lift the tube by its height in {:g} s",
                           kLongestLift_s),
       .fix = "the speed on the bench, such as 0.03."});
  check_grains(model, protocol, errors);
  errors.throw_if_any();
}

/// Highest point of all grains, m; 0 without grains.
double highest_point_m(const ExperimentRun& run) {
  double highest = 0;
  for (int k = 0; k < run.simulation().grain_count(); ++k) {
    if (!run.simulation().is_present(k)) continue;
    highest = std::max(highest, highest_m(run.simulation(), k));
  }
  return highest;
}

void begin_lift(ExperimentRun& run, const HeapProtocol& protocol) {
  Simulation& simulation = run.simulation();
  simulation.set_motions(kHeapTube, {{.velocity = protocol.lift_speed_m_s * Vector::UnitZ(),
                                      .start_s = simulation.time_s()}});
  RunProgress& progress = run.progress();
  progress.stage = HeapStage::lift;
  progress.grains = count_present(simulation);
  progress.start_m = highest_point_m(run);
}

/// Lifts the tube until no grain reaches its lower rim, and removes it.
void lift(ExperimentRun& run) {
  Simulation& simulation = run.simulation();
  const double look_s = RestTest(simulation.setup()).interval_s();
  const double start = run.progress().start_m;
  for (;;) {
    const double highest = highest_point_m(run);
    const double rim = simulation.wall(kHeapTube).pose.position.z();
    if (rim > highest) break;
    // Grains that are not carried along stay below the initial highest point.
    if (rim > start + reach_m(simulation.setup())) {
      throw NoMeasurement(
          fmt::format("heap: grains hang in the tube, its lower rim now {:.3g} m up. "
                      "Fix: a wider tube, or less friction.",
                      rim));
    }
    run.advance_for(look_s);
    run.report_progress(kLiftFrom + (kLiftTo - kLiftFrom) * rim / (.3 * start));
  }
  simulation.remove_wall(kHeapTube);
}

ExperimentRun filled(ExperimentRun filling, const Model& model, const HeapProtocol& protocol,
                     std::uint64_t seed) {
  ExperimentRun run = fill_tube(std::move(filling), model, protocol, seed);
  begin_lift(run, protocol);
  return run;
}

/// Result: the grains left on the plate.
Repeat heap_of(ExperimentRun run, const Model& model, bool is_at_rest, std::uint64_t seed) {
  const int grains = run.progress().grains;
  const int on_plate = count_present(run.simulation());
  if (on_plate == 0) {
    throw NoMeasurement(
        fmt::format("heap: all {} grains left the plate. Fix: a larger plate, or more "
                    "friction.",
                    grains));
  }
  std::vector<Envelope> envelopes = heap_envelopes(placed_spheres(run.simulation()), kViews);
  const double height = height_m(envelopes);
  const bool is_layer = height < kLowestHeap * diameter_m(model.grain);
  Repeat repeat = run.finish(std::nullopt, seed,
                             {{"grains", grains},
                              {"grains_on_plate", on_plate},
                              {"grains_off_plate", grains - on_plate},
                              {"height_mm", 1e3 * height},
                              {"no_heap", is_layer ? 1 : 0},
                              {"at_rest", is_at_rest ? 1 : 0},
                              {"time_s", run.simulation().time_s()}});
  repeat.envelopes = std::move(envelopes);
  return repeat;
}

/// Continues from the lift, or from where it was interrupted later.
Repeat finish_heap(ExperimentRun run, const Model& model, std::uint64_t seed) {
  if (run.progress().stage == HeapStage::lift) {
    lift(run);
    begin_settling(run, HeapStage::settle);
  }
  const bool is_at_rest = settle(run, kLiftTo);
  return heap_of(std::move(run), model, is_at_rest, seed);
}

}  // namespace

Repeat heap_from(const Model& model, const HeapProtocol& protocol, std::uint64_t seed,
                 const StandingHeap& heap) {
  check(model, protocol);
  const ProgressReport unasked;
  const RunRecord unseen;
  ExperimentRun run = empty_tube(model, protocol, {unasked, unseen});
  run.simulation().remove_wall(kHeapTube);
  for (const Grain& grain : heap.grains) run.simulation().add(grain);
  run.progress().grains = heap.lifted;
  return heap_of(std::move(run), model, heap.is_at_rest, seed);
}

Repeat run_heap(const Model& model, const HeapProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report, const RunRecord& record) {
  check(model, protocol);
  return finish_heap(filled(empty_tube(model, protocol, {report, record}), model, protocol, seed),
                     model, seed);
}

Repeat resume_heap(const Model& model, const HeapProtocol& protocol, std::uint64_t seed,
                   const Restart& from, const ProgressReport& report, const RunRecord& record) {
  check(model, protocol);
  SimulationSetup setup = from.setup;
  setup.threads = model.threads;
  ExperimentRun run(Simulation(std::move(setup), from.checkpoint), {report, record},
                    pace_of_rain(model), from.progress);
  run.advance(from.progress.steps_left);
  const bool is_full = from.progress.stage > HeapStage::settle_in_tube;
  return finish_heap(is_full ? std::move(run) : filled(std::move(run), model, protocol, seed),
                     model, seed);
}

namespace {

std::vector<ProtocolKey> keys_of_heap(Protocol& protocol) {
  auto& heap = protocol.as<HeapProtocol>();
  ProtocolKey distance =
      length_key("camera_distance_mm", "1500", heap.camera_distance_m, "far away");
  ProtocolKey height = length_key("camera_height_mm", "40", heap.camera_height_m);
  height.needs = "camera_distance_mm";
  distance.is_of_pictures = height.is_of_pictures = true;
  return {length_key("tube_diameter_mm", "100", heap.tube_diameter_m),
          length_key("tube_height_mm", "400", heap.tube_height_m),
          length_key("tube_thickness_mm", "2", heap.tube_thickness_m),
          length_key("lift_speed_mm_s", "30", heap.lift_speed_m_s),
          length_key("plate_mm", "400", heap.plate_m),
          length_key("plate_thickness_mm", "2", heap.plate_thickness_m),
          count_key("grains", "455", kMaxGrains, heap.grains, "as many as fit"),
          distance,
          height};
}

void adapt_heap(Protocol& protocol, const UsualBench& bench) {
  constexpr double kPlateWidths = 6;  // more than the extent of a low heap
  auto& heap = protocol.as<HeapProtocol>();
  heap.tube_diameter_m = bench.tube_diameter_mm * kMPerMm;
  heap.tube_height_m = bench.tube_height_mm * kMPerMm;
  heap.plate_m = kPlateWidths * heap.tube_diameter_m;
}

std::optional<LevelCamera> camera_of_heap(const Protocol& protocol) {
  const auto& heap = protocol.as<HeapProtocol>();
  if (!heap.camera_distance_m) return std::nullopt;
  return LevelCamera{.distance_m = *heap.camera_distance_m, .height_m = heap.camera_height_m};
}

double grains_in(const HeapProtocol& heap, const ClumpShape& grain) {
  constexpr double kPacked = .6;
  const double radius = heap.tube_diameter_m / 2;
  const double tube_m3 = std::numbers::pi * radius * radius * heap.tube_height_m;
  const double full = kPacked * tube_m3 / grain.volume_m3;
  return heap.grains ? std::min<double>(*heap.grains, full) : full;
}

double cost_of_heap_s(const Model& model, const Protocol& protocol) {
  // Once the tube is lifted by its diameter, the remaining grains fall out.
  constexpr double kFillAndSettle_s = 1.5, kSpeed_m_s = .5;
  const auto& heap = protocol.as<HeapProtocol>();
  const double simulated_s = heap.tube_diameter_m / heap.lift_speed_m_s + kFillAndSettle_s;
  const double grains = grains_in(heap, model.grain);
  return bulk_step_s(model) * many_grains_factor(grains) * grains * simulated_s /
         bulk_timestep_s(model, kSpeed_m_s);
}

/// Fewer grains form no heap at low friction. Heaps of kFewest are off by up to 8 degrees,
/// depending on friction, and scatter two to six times as much: docs/simulating.md, "Heaps of
/// larger grains".
std::optional<double> coarse_size_of_heap(const ClumpShape& grain, const Protocol& protocol) {
  constexpr double kFewest = 300;
  constexpr double kWorthIt = 1.5;  // a fifth of the cost
  constexpr double kMaxSize = 8;
  const double size = std::cbrt(grains_in(protocol.as<HeapProtocol>(), grain) / kFewest);
  if (size < kWorthIt) return std::nullopt;
  return std::min(size, kMaxSize);
}

void coarsen_heap(Protocol& protocol, double size) {
  auto& heap = protocol.as<HeapProtocol>();
  if (heap.grains) {
    heap.grains = std::max(1, static_cast<int>(std::lround(*heap.grains / (size * size * size))));
  }
}

}  // namespace

ExperimentEntry heap_entry() {
  return {
      .name = "heap",
      .unit = "deg",
      .value_name = "angle of repose",
      .description =
          "A tube full of grains stands on the plate and is lifted slowly. A heap stays.",
      .readings = {{"base_radius_mm", "mm", true},
                   {"height_mm", "mm", true},
                   {"grains_off_plate", "", true},
                   {"grains", ""},
                   {"grains_on_plate", ""},
                   {"between_views_deg", "deg"},
                   {"angle_xz_deg", "deg"},
                   {"inner_window_deg", "deg"},
                   {"no_heap", ""},
                   {"at_rest", ""},
                   {"time_s", "s"}},
      .coefficients = {kWallRestitution, kWallSliding, kWallRolling, kGrainRestitution,
                       kGrainSliding, kGrainRolling},
      .parts = {WallPart::tube},
      .sheet = {.test = "heap",
                .value = "angle_deg",
                .mean =
                    MeanOfReadings{
                        .what = "angle of repose",
                        .readable = from_to_below(0, 90),
                        .quantity = "angle_of_repose",
                        .source = "mean of the heaps",
                        .validity = "No material constant: it belongs to heaps of this size, made "
                                    "on this base in this way."}},
      .is_bulk = true,
      .is_pictured = true,
      .needs_tube = true,
      .filmed = FilmedMotion::rest,
      .grains_asked = [](const Protocol& protocol) { return protocol.as<HeapProtocol>().grains; },
      .usual_model_error = .03,
      .usual = HeapProtocol{.grains = {}, .allow_partial_fill = true},
      .keys = keys_of_heap,
      .run = run_as<HeapProtocol, run_heap>,
      .resume =
          [](const Model& model, const Protocol& protocol, std::uint64_t seed, const Restart& from,
             const ProgressReport& report, const RunRecord& record) {
            return resume_heap(model, protocol.as<HeapProtocol>(), seed, from, report, record);
          },
      .stages = {"rain", "settle_in_tube", "lift", "settle"},
      .adapt = adapt_heap,
      .camera = camera_of_heap,
      // Grains rain into the tube.
      .fall_m = [](const ClumpShape& grain,
                   const Protocol& /*protocol*/) { return 8 * grain.reach_m(); },
      .possible = [](const Model& /*model*/,
                     const Protocol& /*protocol*/) { return from_to(-90, 90); },
      .cost_s = cost_of_heap_s,
      .coarse_size = coarse_size_of_heap,
      .coarsen = coarsen_heap,
      .coarse_error = .2};
}

}  // namespace repose::dem
