#include "dem/experiment/pace.h"

#include <algorithm>
#include <cmath>

#include "dem/engine/time_step.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/placing.h"

namespace repose::dem {
namespace {

/// Speeds are taken in rungs, each by this much faster than the one below, so that the step seldom
/// changes.
constexpr double kRung = 1.15;
/// The lowest rung, 1.15^-16: a tenth of the usual speed.
constexpr int kLowestRung = -16;

/// Fastest that a surface moves, m/s; no grain turns faster about a point than its reach allows.
double fastest_surface_m_s(const Simulation& simulation) {
  double fastest = 0;
  for (int k = 0; k < simulation.grain_count(); ++k) {
    if (!simulation.is_present(k)) continue;
    const Grain grain = simulation.grain(k);
    const double turning = grain.spin.norm() * shape_of(simulation, grain).reach_m();
    fastest = std::max(fastest, grain.velocity.norm() + turning);
  }
  return fastest;
}

}  // namespace

Pace::Pace(const Model& model, double usual_speed_m_s)
    : is_fixed_(model.timestep_s.has_value()),
      fraction_(kBulkFraction * model.timestep_fraction),
      usual_speed_m_s_(usual_speed_m_s),
      setup_(bulk_setup(model, {}, usual_speed_m_s)),
      usual_step_s_(accurate_timestep_s(setup_, usual_speed_m_s)) {}

double Pace::step_of(int rung) {
  const auto known = step_s_.find(rung);
  if (known != step_s_.end()) return known->second;
  const double ratio =
      accurate_timestep_s(setup_, std::pow(kRung, rung) * usual_speed_m_s_) / usual_step_s_;
  return step_s_[rung] = ratio * setup_.timestep_s;
}

double Pace::timestep_s(const Simulation& simulation, double ahead_s) {
  const double now = simulation.setup().timestep_s;
  if (is_fixed_) return now;
  const double speed =
      fastest_surface_m_s(simulation) + ahead_s * simulation.setup().gravity.norm();
  const double rungs = std::log(speed / usual_speed_m_s_) / std::log(kRung);
  // -inf of grains that all stand still.
  const int rung = static_cast<int>(std::max<double>(kLowestRung, std::ceil(rungs)));
  const double longest = step_of(rung);
  if (now <= longest && now >= step_of(rung + 1)) return now;
  if (longest < now) return longest;
  // Grains that press on each other have speed in store.
  const auto stable = simulation.stable_timestep_s();
  return stable ? std::clamp(fraction_ * *stable, now, longest) : longest;
}

}  // namespace repose::dem
