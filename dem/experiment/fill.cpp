#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_run.h"
#include "dem/experiment/grain_limit.h"
#include "dem/experiment/heap_fill.h"
#include "dem/experiment/model_setup.h"

namespace repose::dem {
namespace {

/// Grains across and upwards that a bulk has at least.
constexpr double kFewest = 4;

double volume_m3(const FillProtocol& protocol) {
  const double radius = .5 * protocol.tube_diameter_m;
  return std::numbers::pi * radius * radius * protocol.tube_height_m;
}

void check_sizes(const FillProtocol& protocol, double grain_m, base::ErrorList& errors) {
  const auto at_least = [&](const char* name, double value, double least, const char* fix) {
    errors.require(std::isfinite(value) && value >= least,
                   fmt::format("fill.{} is {:g}. Rule: {:g} grains or more, {:.4g} m: narrower and "
                               "lower tubes hold grains at their walls alone. Fix: {}.",
                               name, value, kFewest, least, fix));
  };
  at_least("tube_diameter_m", protocol.tube_diameter_m, kFewest * grain_m, "a wider tube");
  at_least("tube_height_m", protocol.tube_height_m, kFewest * grain_m, "a taller tube");
  errors.require(
      std::isfinite(protocol.pour_m) && protocol.pour_m > 0,
      fmt::format("fill.pour_m is {:g}. Rule: above 0. Fix: the height of the spout over "
                  "the rim, such as 0.05.",
                  protocol.pour_m));
}

void check(const Model& model, const FillProtocol& protocol) {
  base::ErrorList errors;
  find_errors(model, errors);
  check_sizes(protocol, 2 * model.grain.reach_m(), errors);
  constexpr double kPacked = .65;
  const double grains = kPacked * volume_m3(protocol) / model.grain.volume_m3;
  errors.require(
      !(grains > kMaxGrains),
      fmt::format("fill.tube_diameter_m is {:g}, fill.tube_height_m {:g}: the tube holds "
                  "about {:.2g} grains. Rule: at most {}. Fix: a smaller tube.",
                  protocol.tube_diameter_m, protocol.tube_height_m, grains, kMaxGrains));
  errors.throw_if_any();
}

/// The same tube for the pouring, which stands on a plate as wide as itself.
HeapProtocol tube_of(const FillProtocol& protocol) {
  constexpr double kThickness_m = .002;
  return {.tube_diameter_m = protocol.tube_diameter_m,
          .tube_height_m = protocol.tube_height_m,
          .tube_thickness_m = kThickness_m,
          .plate_m = protocol.tube_diameter_m + 2 * kThickness_m,
          .plate_thickness_m = kThickness_m,
          .grains = {}};
}

}  // namespace

Repeat run_fill(const Model& model, const FillProtocol& protocol, std::uint64_t seed,
                const ProgressReport& report, const RunRecord& record) {
  check(model, protocol);
  const HeapProtocol tube = tube_of(protocol);
  const double spout_m = protocol.tube_height_m + protocol.pour_m;
  ExperimentRun run =
      fill_tube(empty_tube(model, tube, {report, record}, spout_m), model, tube, seed, spout_m);
  const Simulation& struck = run.simulation();
  double grains = 0;
  for (int k = 0; k < struck.grain_count(); ++k) grains += struck.is_present(k) ? 1 : 0;
  const double mass_kg = grains * model.grain_material.density_kg_m3 * model.grain.volume_m3;
  const double density = mass_kg / volume_m3(protocol);
  return run.finish(density, seed,
                    {{"grains", grains},
                     {"mass_g", 1e3 * mass_kg},
                     {"solid_fraction", density / model.grain_material.density_kg_m3}});
}

}  // namespace repose::dem
