#include "dem/experiment/heap_fill.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "dem/experiment/heap_settling.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/placing.h"
#include "dem/experiment/random.h"

namespace repose::dem {
namespace {

/// Share of the run that filling is taken to be.
constexpr double kFillFraction = .35;
/// Places tried for each layer: more would find few.
constexpr int kTriesPerLayer = 400;
/// How far the rain is taken to have fallen, in reaches of a grain.
constexpr double kFall = 4;
/// How far grains are heaped over the rim before they are levelled, in reaches of a grain.
constexpr double kHeaped = 4;

double rain_speed_m_s(double reach_m) {
  return std::sqrt(2 * kStandardGravity_m_s2 * kFall * reach_m);
}

/// Of the impacts that the time step is chosen for.
double fastest_m_s(double reach_m, std::optional<double> spout_m = {}) {
  if (spout_m) return std::sqrt(2 * kStandardGravity_m_s2 * *spout_m);
  return std::sqrt(2) * rain_speed_m_s(reach_m);
}

Wall plate_of(const HeapProtocol& protocol) {
  const double half = .5 * protocol.plate_m;
  const double half_thickness = .5 * protocol.plate_thickness_m;
  return study_wall(Box{.half_size = {half, half, half_thickness}},
                    {.position = {0, 0, -half_thickness}});
}

Wall tube_of(const HeapProtocol& protocol, double height_m) {
  return study_wall(Tube{.inner_radius = .5 * protocol.tube_diameter_m,
                         .thickness = protocol.tube_thickness_m,
                         .height = height_m});
}

/// Grains whose centres lie above the rim.
std::vector<int> above_rim(const Simulation& simulation, double rim_m) {
  std::vector<int> above;
  for (int k = 0; k < simulation.grain_count(); ++k) {
    if (simulation.grain(k).position.z() > rim_m) above.push_back(k);
  }
  return above;
}

/// Rains grains into a tube that is tall enough for all that fall.
class Rain {
 public:
  /// `draws`: of the rain that this one goes on from.
  Rain(const HeapProtocol& protocol, double reach_m, std::optional<double> spout_m,
       std::uint64_t seed, std::uint64_t draws)
      : protocol_(protocol), reach_m_(reach_m), spout_m_(spout_m), random_(seed, draws) {}

  void fill(ExperimentRun& run);

 private:
  int left(const Simulation& simulation) const {
    return protocol_.grains ? *protocol_.grains - simulation.grain_count()
                            : std::numeric_limits<int>::max();
  }
  void rain_up_to(ExperimentRun& run, double height_m);
  void add_layer(ExperimentRun& run, double height_m);

  /// Of grains that are added at a height: as if they came from the spout, or in a steady rain.
  double speed_m_s(double height_m) const {
    if (!spout_m_) return rain_speed_m_s(reach_m_);
    const double fall_m = std::max(reach_m_, *spout_m_ - height_m);
    return std::sqrt(2 * kStandardGravity_m_s2 * fall_m);
  }

  const HeapProtocol& protocol_;
  double reach_m_;
  std::optional<double> spout_m_;
  Random random_;
};

double highest_point_m(const ExperimentRun& run) {
  double highest = 0;
  for (int k = 0; k < run.simulation().grain_count(); ++k) {
    highest = std::max(highest, highest_m(run.shape(), run.simulation().grain(k)));
  }
  return highest;
}

/// Adds grains at random places, no nearer to each other or the tube than they can reach.
void Rain::add_layer(ExperimentRun& run, double height_m) {
  const double room = .5 * protocol_.tube_diameter_m - reach_m_;
  std::vector<Vector> taken;
  for (int k = 0; k < kTriesPerLayer && left(run.simulation()) > 0; ++k) {
    const double radius = room * std::sqrt(random_.uniform());
    const double turn = 2 * std::numbers::pi * random_.uniform();
    const Vector place(radius * std::cos(turn), radius * std::sin(turn), height_m);
    const bool is_free = std::all_of(taken.begin(), taken.end(), [&](const Vector& other) {
      return (place - other).norm() > 2 * reach_m_;
    });
    if (!is_free) continue;
    taken.push_back(place);
    run.simulation().add({.position = place,
                          .orientation = random_.orientation(),
                          .velocity = {0, 0, -speed_m_s(height_m)}});
  }
  run.progress().random_draws = random_.draws();
}

/// A layer at a time goes in just above the last one, which by then has fallen by its own height
/// or lies on the grains below.
void Rain::rain_up_to(ExperimentRun& run, double height_m) {
  for (double highest = highest_point_m(run); highest < height_m && left(run.simulation()) > 0;
       highest = highest_point_m(run)) {
    const double layer_m = highest + 1.01 * reach_m_;
    add_layer(run, layer_m);
    run.advance(run.steps_of(2 * reach_m_ / speed_m_s(layer_m)));
    run.report_progress(kFillFraction * highest / height_m);
  }
}

void Rain::fill(ExperimentRun& run) {
  HeapStage& stage = run.progress().stage;
  do {
    if (stage == HeapStage::rain) {
      rain_up_to(run, protocol_.tube_height_m + kHeaped * reach_m_);
      begin_settling(run, HeapStage::settle_in_tube);
    }
    settle(run, kFillFraction);
    stage = HeapStage::rain;
  } while (left(run.simulation()) > 0 &&
           above_rim(run.simulation(), protocol_.tube_height_m).empty());
}

/// The grains up to the rim, and their contacts but those with the tube above it.
Checkpoint levelled(const HeapProtocol& protocol, const Simulation& filled) {
  const ClumpShape& shape = filled.setup().kinds.front().shape;
  Checkpoint now = filled.checkpoint();
  now.step = 0;
  for (const int grain : above_rim(filled, protocol.tube_height_m)) {
    now.is_present[static_cast<std::size_t>(grain)] = false;
  }
  std::erase_if(now.contacts, [&](const ContactState& contact) {
    const auto a = static_cast<std::size_t>(contact.grain_a);
    if (!now.is_present[a]) return true;
    if (contact.grain_b >= 0) return !now.is_present[static_cast<std::size_t>(contact.grain_b)];
    const bool is_tube = -1 - contact.grain_b == kHeapTube;
    return is_tube && highest_m(shape, now.grains[a]) > protocol.tube_height_m;
  });
  return now;
}

}  // namespace

ExperimentRun empty_tube(const Model& model, const HeapProtocol& protocol,
                         const Observers& observers, std::optional<double> spout_m) {
  const double reach = model.grain.reach_m();
  const double tall = protocol.tube_height_m + 10 * kHeaped * reach;
  return {Simulation(model_setup(model, model.grain, {plate_of(protocol), tube_of(protocol, tall)},
                                 fastest_m_s(reach, spout_m), kCourseFraction)),
          observers};
}

ExperimentRun fill_tube(ExperimentRun filling, const Model& model, const HeapProtocol& protocol,
                        std::uint64_t seed, std::optional<double> spout_m) {
  const double reach = model.grain.reach_m();
  Rain(protocol, reach, spout_m, seed, filling.progress().random_draws).fill(filling);
  const auto over = above_rim(filling.simulation(), protocol.tube_height_m).size();
  if (protocol.grains && !protocol.may_be_fewer && over > 0) {
    throw std::invalid_argument(fmt::format(
        "heap.grains is {}. Rule: at most what fits into the tube, {}. Fix: fewer grains, a taller "
        "or wider tube, or leave the number out to fill it.",
        *protocol.grains, static_cast<std::size_t>(filling.simulation().grain_count()) - over));
  }
  SimulationSetup setup = model_setup(
      model, model.grain, {plate_of(protocol), tube_of(protocol, protocol.tube_height_m)},
      fastest_m_s(reach, spout_m), kCourseFraction);
  // Grains that fall off the plate are gone once they are well below it.
  setup.floor_m = -protocol.plate_thickness_m - 5 * reach;
  return {Simulation(std::move(setup), levelled(protocol, filling.simulation())),
          filling.observers(),
          {.work = filling.progress().work}};
}

}  // namespace repose::dem
