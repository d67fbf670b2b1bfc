#include "dem/experiment/rain.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/experiment/heap_settling.h"
#include "dem/experiment/placing.h"

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

class Rain {
 public:
  /// `draws`: of the rain that this one goes on from.
  Rain(const RainPlan& plan, double reach_m, std::uint64_t seed, std::uint64_t draws)
      : plan_(plan), reach_m_(reach_m), random_(seed, draws) {}

  void fill(ExperimentRun& run);

 private:
  int left(const Simulation& simulation) const {
    return plan_.grains ? *plan_.grains - simulation.grain_count()
                        : std::numeric_limits<int>::max();
  }
  double highest_point_m(const ExperimentRun& run) const;
  void rain_up_to(ExperimentRun& run, double height_m);
  /// At most so many grains; returns how many it has.
  int add_layer(ExperimentRun& run, double height_m, int most);

  /// Of grains that are added at a height: as if they came from the spout, or in a steady rain.
  double speed_m_s(double height_m) const {
    if (!plan_.spout_m) return rain_speed_m_s(reach_m_);
    const double fall_m = std::max(reach_m_, *plan_.spout_m - height_m);
    return std::sqrt(2 * kStandardGravity_m_s2 * fall_m);
  }

  /// Each is as likely as the others.
  int kind_of_next(const SimulationSetup& setup) {
    const auto kinds = static_cast<double>(setup.kinds.size());
    return kinds == 1 ? 0 : static_cast<int>(kinds * random_.uniform());
  }

  const RainPlan& plan_;
  double reach_m_;  ///< of the largest grain
  Random random_;
};

double Rain::highest_point_m(const ExperimentRun& run) const {
  double highest = plan_.floor_m;
  for (int k = 0; k < run.simulation().grain_count(); ++k) {
    highest = std::max(highest, highest_m(run.simulation(), k));
  }
  return highest;
}

int Rain::add_layer(ExperimentRun& run, double height_m, int most) {
  std::vector<Vector> taken;
  for (int k = 0; k < kTriesPerLayer && left(run.simulation()) > 0; ++k) {
    if (static_cast<int>(taken.size()) == most) break;
    Vector place = plan_.place(random_);
    place.z() = height_m;
    const bool is_free = std::all_of(taken.begin(), taken.end(), [&](const Vector& other) {
      return (place - other).norm() > 2 * reach_m_;
    });
    if (!is_free) continue;
    taken.push_back(place);
    run.simulation().add({.kind = kind_of_next(run.simulation().setup()),
                          .position = place,
                          .orientation = random_.orientation(),
                          .velocity = {0, 0, -speed_m_s(height_m)}});
  }
  run.progress().random_draws = random_.draws();
  return static_cast<int>(taken.size());
}

/// A layer at a time goes in just above the last one, which by then has fallen by its own height
/// or lies on the grains below. Of grains that come at a rate, a layer has those that are due; what
/// finds no place there does not come later.
void Rain::rain_up_to(ExperimentRun& run, double height_m) {
  double due = 1;
  for (double highest = highest_point_m(run); highest < height_m && left(run.simulation()) > 0;
       highest = highest_point_m(run)) {
    const double layer_m = highest + 1.01 * reach_m_;
    const int most = plan_.grains_per_s ? static_cast<int>(due) : kTriesPerLayer;
    const int added = add_layer(run, layer_m, most);
    double wait_s = 2 * reach_m_ / speed_m_s(layer_m);
    if (plan_.grains_per_s) {
      const double left_over = std::min(due - added, 1.);
      wait_s = std::max(wait_s, (1 - left_over) / *plan_.grains_per_s);
      due = std::min<double>(left_over + wait_s * *plan_.grains_per_s, kTriesPerLayer);
    }
    run.advance_for(wait_s);
    run.report_progress(kFillFraction * (highest - plan_.floor_m) / (height_m - plan_.floor_m));
  }
}

void Rain::fill(ExperimentRun& run) {
  HeapStage& stage = run.progress().stage;
  do {
    if (stage == HeapStage::rain) {
      rain_up_to(run, plan_.rim_m + kHeaped * reach_m_);
      begin_settling(run, HeapStage::settle_in_tube);
    }
    settle(run, kFillFraction);
    stage = HeapStage::rain;
  } while (left(run.simulation()) > 0 && above_rim(run.simulation(), plan_.rim_m).empty());
}

}  // namespace

double fastest_rain_m_s(double reach_m, std::optional<double> spout_m) {
  if (spout_m) return std::sqrt(2 * kStandardGravity_m_s2 * *spout_m);
  return std::sqrt(2) * rain_speed_m_s(reach_m);
}

void rain(ExperimentRun& run, const RainPlan& plan, std::uint64_t seed) {
  Rain(plan, reach_m(run.simulation().setup()), seed, run.progress().random_draws).fill(run);
}

std::vector<int> above_rim(const Simulation& simulation, double rim_m) {
  std::vector<int> above;
  for (int k = 0; k < simulation.grain_count(); ++k) {
    if (simulation.grain(k).position.z() > rim_m) above.push_back(k);
  }
  return above;
}

}  // namespace repose::dem
