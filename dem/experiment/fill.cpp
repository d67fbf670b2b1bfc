#include "dem/experiment/fill.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"
#include "base/units.h"
#include "dem/experiment/entry.h"
#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_run.h"
#include "dem/experiment/filling.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/model_setup.h"

namespace repose::dem {
namespace {

/// Minimum number of grains across and along the height of a bulk.
constexpr double kFewestInTube = 4;

double volume_m3(const FillProtocol& protocol) {
  const double radius = .5 * protocol.tube_diameter_m;
  return std::numbers::pi * radius * radius * protocol.tube_height_m;
}

void check_sizes(const FillProtocol& protocol, double grain_m, base::Faults& errors) {
  const auto at_least = [&](const char* name, double value, double least, const char* fix) {
    errors.require(std::isfinite(value) && value >= least,
                   {.subject = fmt::format("fill.{}", name),
                    .value = fmt::format("is {:g}", value),
                    .rule = fmt::format("{:g} grains or more, {:.4g} m: narrower and lower tubes "
                                        "hold grains at their walls alone",
                                        kFewestInTube, least),
                    .fix = fmt::format("{}.", fix)});
  };
  at_least("tube_diameter_m", protocol.tube_diameter_m, kFewestInTube * grain_m, "a wider tube");
  at_least("tube_height_m", protocol.tube_height_m, kFewestInTube * grain_m, "a taller tube");
  errors.require(std::isfinite(protocol.pour_m) && protocol.pour_m > 0,
                 {.subject = "fill.pour_m",
                  .value = fmt::format("is {:g}", protocol.pour_m),
                  .rule = "above 0",
                  .fix = "the height of the spout over the rim, such as 0.05."});
}

void check_taps(const FillProtocol& protocol, base::Faults& errors) {
  if (!protocol.taps) return;
  errors.require(*protocol.taps >= 1 && *protocol.taps <= kMaxTaps,
                 {.subject = "fill.taps",
                  .value = fmt::format("is {}", *protocol.taps),
                  .rule = fmt::format("1 to {}", kMaxTaps),
                  .fix = "leave it out not to tap."});
  errors.require(
      protocol.tap_m > 0 && protocol.tap_m <= protocol.tube_height_m,
      {.subject = "fill.tap_m",
       .value = fmt::format("is {:g}", protocol.tap_m),
       .rule = fmt::format("above 0, and at most the tube's height, {:g}", protocol.tube_height_m),
       .fix = "how far the tube drops at each tap, such as 0.003."});
}

/// Checks the pouring rate, for grains that fill the tube.
void check_rate(const Model& model, const FillProtocol& protocol, base::Faults& errors) {
  if (!protocol.pour_kg_s) return;
  constexpr double kPacked = .65;
  const double mass_kg = kPacked * volume_m3(protocol) * model.grain_material.density_kg_m3;
  const double slowest_kg_s = mass_kg / kLongestPour_s;
  errors.require(
      std::isfinite(*protocol.pour_kg_s) && *protocol.pour_kg_s >= slowest_kg_s,
      {.subject = "fill.pour_kg_s",
       .value = fmt::format("is {:g}", *protocol.pour_kg_s),
       .rule =
           fmt::format("{:.3g} or more, which fills the tube in {:g} s: longer runs take too long",
                       slowest_kg_s, kLongestPour_s),
       .fix = fmt::format(
           "{:.3g}, since what is poured so slowly is hardly denser than that; or a smaller tube.",
           slowest_kg_s)});
}

void check(const Model& model, const FillProtocol& protocol) {
  base::Faults errors;
  find_errors(model, errors);
  check_sizes(protocol, 2 * largest_reach_m(model), errors);
  check_taps(protocol, errors);
  check_rate(model, protocol, errors);
  constexpr double kPacked = .65;
  const double grains = kPacked * volume_m3(protocol) / model.grain.volume_m3;
  errors.require(
      !(grains > kMaxGrains),
      {.subject = "fill.tube_diameter_m",
       .value = fmt::format("is {:g}, fill.tube_height_m {:g}: the tube holds about {:.2g} grains",
                            protocol.tube_diameter_m, protocol.tube_height_m, grains),
       .rule = fmt::format("at most {}", kMaxGrains),
       .fix = "a smaller tube."});
  errors.throw_if_any();
}

/// The same tube for pouring, on a plate of its own width.
HeapProtocol tube_of(const FillProtocol& protocol) {
  constexpr double kTubeWall_m = .002;
  return {.tube_diameter_m = protocol.tube_diameter_m,
          .tube_height_m = protocol.tube_height_m,
          .tube_thickness_m = kTubeWall_m,
          .plate_m = protocol.tube_diameter_m + 2 * kTubeWall_m,
          .plate_thickness_m = kTubeWall_m,
          .grains = {}};
}

/// The tube with its collar, if it is tapped.
HeapProtocol collared(HeapProtocol tube, const FillProtocol& protocol) {
  // Enough for packings that become a third denser; hardly any do.
  constexpr double kCollar = 1. / 3;
  if (protocol.taps) tube.tube_height_m *= 1 + kCollar;
  return tube;
}

Bulk bulk_below(const Simulation& simulation, double rim_m) {
  Bulk bulk;
  for (int k = 0; k < simulation.grain_count(); ++k) {
    if (!simulation.is_present(k) || simulation.grain(k).position.z() > rim_m) continue;
    bulk.add(simulation, k);
  }
  return bulk;
}

/// Taps the tube; returns the ratio of mass below its rim after and before.
double tapped(ExperimentRun& run, const FillProtocol& protocol) {
  const double poured = bulk_below(run.simulation(), protocol.tube_height_m).relative_mass;
  tap(run, *protocol.taps, protocol.tap_m);
  if (above_rim(run.simulation(), protocol.tube_height_m).empty()) {
    throw NoMeasurement("the grains sank below the rim of the tube when it was tapped");
  }
  return bulk_below(run.simulation(), protocol.tube_height_m).relative_mass / poured;
}

/// std::nullopt: as fast as they fall. If sizes vary, each is equally likely.
std::optional<double> grains_per_s(const FillProtocol& protocol, const Model& model,
                                   const SimulationSetup& setup) {
  if (!protocol.pour_kg_s) return std::nullopt;
  double one_of_each_m3 = 0;
  for (const GrainKind& kind : setup.kinds) one_of_each_m3 += kind.shape.volume_m3;
  const double mean_kg =
      model.grain_material.density_kg_m3 * one_of_each_m3 / static_cast<double>(setup.kinds.size());
  return *protocol.pour_kg_s / mean_kg;
}

}  // namespace

Repeat run_fill(const Model& model, const FillProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report, const RunRecord& record) {
  check(model, protocol);
  const HeapProtocol tube = tube_of(protocol);
  const HeapProtocol filled = collared(tube, protocol);
  const double spout_m = filled.tube_height_m + protocol.pour_m;
  Readings readings;
  ExperimentRun filling = empty_tube(model, filled, {report, record}, spout_m);
  pour(filling, filled, seed, spout_m, grains_per_s(protocol, model, filling.simulation().setup()));
  if (protocol.taps) readings["hausner_ratio"] = tapped(filling, protocol);
  ExperimentRun run = struck_level(filling, model, tube, spout_m);
  const Bulk bulk = bulk_below(run.simulation(), protocol.tube_height_m);
  const double mass_kg =
      bulk.relative_mass * model.grain_material.density_kg_m3 * model.grain.volume_m3;
  const double density = mass_kg / volume_m3(protocol);
  const double level_m =
      filling_height_m(placed_spheres(run.simulation()), protocol.tube_diameter_m);
  readings.insert({{"filling_height_mm", 1e3 * level_m},
                   {"grains", bulk.grains},
                   {"mass_g", 1e3 * mass_kg},
                   {"solid_fraction", density / model.grain_material.density_kg_m3}});
  return run.finish(density, seed, std::move(readings));
}

namespace {

std::vector<ProtocolKey> keys_of_fill(Protocol& protocol) {
  auto& fill = protocol.as<FillProtocol>();
  ProtocolKey tap = length_key("tap_mm", "3", fill.tap_m);
  tap.needs = "taps";
  return {length_key("tube_diameter_mm", "100", fill.tube_diameter_m),
          length_key("tube_height_mm", "100", fill.tube_height_m),
          length_key("pour_mm", "50", fill.pour_m),
          {.name = "pour_g_s",
           .example = "50",
           .range = above(0, 1e5),
           .unit = 1e-3,
           .value = &fill.pour_kg_s,
           .absence = "as fast as grains fall"},
          count_key("taps", "50", kMaxTaps, fill.taps, "none"),
          tap};
}

/// Balls poured sixteen times more slowly packed 6 % denser: if the bench's rate is unknown,
/// anything from 0 to that is equally likely, 3.5 % root mean square.
SystematicFraction systematic_of_fill(const Protocol& protocol) {
  if (protocol.as<FillProtocol>().pour_kg_s) return {};
  return {.name = "pouring_rate",
          .sd = .035,
          .note =
              "how fast it was poured is not said, and the simulation pours as fast as grains "
              "fall, which is up to 6 % looser: 3.5 % are added to the uncertainty of the "
              "mean, which more readings do not lower. Fix: pour_g_s in [experiment.fill], "
              "what was poured by the time that it took",
          .warning_name = "unknown_pouring_rate",
          .warning =
              "the study does not say how fast the bench pours, and this fill pours as fast as "
              "grains fall: slower ones are up to 6 % denser. Fix: pour_g_s in [experiment.fill], "
              "what was poured by the time that it took."};
}

/// The bench's own tube, or one that also holds a bulk of large grains.
void adapt_fill(Protocol& protocol, const UsualBench& bench) {
  auto& fill = protocol.as<FillProtocol>();
  if (bench.has_own_tube) {
    fill.tube_diameter_m = bench.tube_diameter_mm * kMPerMm;
    fill.tube_height_m = bench.tube_height_mm * kMPerMm;
    return;
  }
  constexpr double kLengths = 5, kRound_mm = 10;
  const double longest_mm = *std::ranges::max_element(bench.grain_mm);
  const double wide_m = kMPerMm * kRound_mm * std::ceil(kLengths * longest_mm / kRound_mm);
  fill.tube_diameter_m = std::max(fill.tube_diameter_m, wide_m);
  fill.tube_height_m = std::max(fill.tube_height_m, wide_m);
}

double cost_of_fill_s(const Model& model, const Protocol& protocol) {
  constexpr double kPacked = .6, kRises_m_s = .13, kFallSpeed_m_s = 2, kTap_s = .1;
  const auto& fill = protocol.as<FillProtocol>();
  const double radius = fill.tube_diameter_m / 2;
  const double tube_m3 = std::numbers::pi * radius * radius * fill.tube_height_m;
  const double grains = kPacked * tube_m3 / model.grain.volume_m3;
  const double mass_kg = kPacked * tube_m3 * model.grain_material.density_kg_m3;
  const double pour_s =
      std::max(fill.tube_height_m / kRises_m_s, fill.pour_kg_s ? mass_kg / *fill.pour_kg_s : 0);
  const double simulated_s = pour_s + kTap_s * fill.taps.value_or(0);
  return bulk_step_s(model) * many_grains_factor(grains) * grains * simulated_s /
         bulk_timestep_s(model, kFallSpeed_m_s);
}

}  // namespace

ExperimentEntry fill_entry() {
  return {.name = "fill",
          .unit = "kg/m3",
          .value_name = "bulk density",
          .description =
              "Grains are poured into a tube that stands on a plate until they heap over its rim. "
              "They are struck level, if wanted after taps, and what is in the tube is weighed.",
          .readings = {{"hausner_ratio", "", true, "taps", true},
                       {"filling_height_mm", "mm", true},
                       {"grains", ""},
                       {"mass_g", "g"},
                       {"solid_fraction", ""}},
          .coefficients = {kWallRestitution, kWallSliding, kWallRolling, kGrainRestitution,
                           kGrainSliding, kGrainRolling},
          .parts = {WallPart::tube},
          // Expanded polystyrene beads have at least 8, solid osmium 22,590.
          .sheet = {.test = "fill",
                    .value = "bulk_density_kg_m3",
                    .mean =
                        MeanOfReadings{
                            .what = "mass in the tube by the tube's volume",
                            .readable = between(5, 22590),
                            .quantity = "bulk_density",
                            .source = "mean of the fillings",
                            .validity = "No material constant: it belongs to this tube, filled in "
                                        "this way."}},
          .is_bulk = true,
          .is_default = false,
          .systematic = systematic_of_fill,
          .usual_scatter = .02,
          .usual_model_error = .02,
          // Overlaps under the weight of the grains above increase the density: for glass beads by
          // 2 % at 6.5 MPa, while ten and a hundred times stiffer ones do not differ
          // (docs/calibrating.md, "Are the grains stiff enough?").
          .soft_pa = 1.25e8,
          .usual = FillProtocol{},
          .keys = keys_of_fill,
          .run = run_as<FillProtocol, run_fill>,
          .adapt = adapt_fill,
          .fall_m =
              [](const ClumpShape& /*grain*/, const Protocol& protocol) {
                const auto& fill = protocol.as<FillProtocol>();
                return fill.tube_height_m + fill.pour_m;
              },
          .possible =
              [](const Model& model, const Protocol& /*protocol*/) {
                return from_to(0, model.grain_material.density_kg_m3);
              },
          // Loose fibres fill 5 % of a tube, random packings of rounder grains 50 % or more.
          .least_of_possible = .05,
          .cost_s = cost_of_fill_s};
}

}  // namespace repose::dem
