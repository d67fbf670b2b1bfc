#include "dem/experiment/experiment_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "dem/engine/time_step.h"
#include "dem/experiment/model_setup.h"

namespace repose::dem {

namespace {

/// Ratio between successive speed rungs. Speeds are rounded up to rungs so that the step seldom
/// changes.
constexpr double kRung = 1.15;
/// The lowest rung, 1.15^-16: a tenth of the usual speed.
constexpr int kLowestRung = -16;

/// Upper bound for the speed of any grain's surface, m/s.
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

AdaptiveTimestep::AdaptiveTimestep(const Model& model, double usual_speed_m_s)
    : is_fixed_(model.timestep_s.has_value()),
      fraction_(kBulkFraction * model.timestep_fraction),
      usual_speed_m_s_(usual_speed_m_s),
      setup_(bulk_setup(model, {}, usual_speed_m_s)),
      usual_step_s_(accurate_timestep_s(setup_, usual_speed_m_s)) {}

double AdaptiveTimestep::step_of(int rung) {
  const auto known = step_s_.find(rung);
  if (known != step_s_.end()) return known->second;
  const double ratio =
      accurate_timestep_s(setup_, std::pow(kRung, rung) * usual_speed_m_s_) / usual_step_s_;
  return step_s_[rung] = ratio * setup_.timestep_s;
}

double AdaptiveTimestep::timestep_s(const Simulation& simulation, double ahead_s) {
  const double now = simulation.setup().timestep_s;
  if (is_fixed_) return now;
  const double speed =
      fastest_surface_m_s(simulation) + ahead_s * simulation.setup().gravity.norm();
  const double rungs = std::log(speed / usual_speed_m_s_) / std::log(kRung);
  // -inf if all grains are at rest.
  const int rung = static_cast<int>(std::max<double>(kLowestRung, std::ceil(rungs)));
  const double longest = step_of(rung);
  if (now <= longest && now >= step_of(rung + 1)) return now;
  if (longest < now) return longest;
  // Grains pressed together store energy that can become speed.
  const auto stable = simulation.stable_timestep_s();
  return stable ? std::clamp(fraction_ * *stable, now, longest) : longest;
}

namespace {

/// Maximum of grains times steps between two looks: some seconds of work.
constexpr std::int64_t kClumpStepsBetweenLooks = 1'000'000;

/// The first multiple of `every` after `step`, so that looks do not depend on where a run was
/// resumed.
std::int64_t multiple_after(std::int64_t step, std::int64_t every) {
  return (step / every + 1) * every;
}

}  // namespace

std::optional<double> Readings::number(const std::string& name) const {
  const auto found = find(name);
  return found == end() ? std::nullopt : found->second;
}

double Readings::at(const std::string& name) const {
  const std::optional<double> found = number(name);
  if (found) return *found;
  throw std::out_of_range(fmt::format("the run has no reading {}", name));
}

int count_present(const Simulation& simulation) {
  int present = 0;
  for (int k = 0; k < simulation.grain_count(); ++k) present += simulation.is_present(k) ? 1 : 0;
  return present;
}

std::optional<double> scatter_of(double squares, std::size_t count) {
  if (count < 2) return std::nullopt;
  return std::sqrt(squares / (static_cast<double>(count) - 1));
}

ExperimentRun::ExperimentRun(Simulation simulation, const Observers& observers,
                             std::optional<AdaptiveTimestep> pace, RunProgress progress)
    : simulation_(std::move(simulation)),
      observers_(observers),
      pace_(std::move(pace)),
      progress_(std::move(progress)) {}

std::int64_t ExperimentRun::steps_of(double duration_s) const {
  const double steps = std::ceil(duration_s / simulation_.setup().timestep_s);
  return static_cast<std::int64_t>(std::max(1.0, steps));
}

/// Step of the next frame: the first at or after a multiple of the interval, if the time step
/// stays.
std::int64_t ExperimentRun::next_frame_step() const {
  if (!observers_.record.frame) return std::numeric_limits<std::int64_t>::max();
  constexpr double kRounding = 1e-6;  // steps within this of the time count as there
  const double timestep_s = simulation_.setup().timestep_s;
  const double steps = observers_.record.frame_interval_s / timestep_s;
  const double now = simulation_.time_s() / timestep_s;
  if (steps <= 1) return simulation_.step() + 1;
  const double next = (std::floor((now + kRounding) / steps) + 1) * steps;
  return simulation_.step() + std::llround(std::ceil(next - now - kRounding));
}

void ExperimentRun::advance(std::int64_t steps) {
  const RunRecord& record = observers_.record;
  const std::int64_t between_looks =
      std::max<std::int64_t>(1, kClumpStepsBetweenLooks / std::max(1, simulation_.grain_count()));
  progress_.steps_left = steps;
  if (record.frame && steps > 0 && simulation_.step() == 0) record.frame(simulation_);
  while (progress_.steps_left > 0) {
    const std::int64_t now = simulation_.step();
    const std::int64_t frame_at = next_frame_step();
    const std::int64_t look_at = multiple_after(now, between_looks);
    const std::int64_t stretch = std::min({progress_.steps_left, frame_at - now, look_at - now});
    const int present = count_present(simulation_);
    simulation_.advance(stretch);
    progress_.steps_left -= stretch;
    progress_.work.steps += stretch;
    progress_.work.shortest_timestep_s =
        std::min(progress_.work.shortest_timestep_s, simulation_.setup().timestep_s);
    progress_.work.clump_steps += static_cast<double>(present) * static_cast<double>(stretch);
    if (now + stretch == frame_at) record.frame(simulation_);
    if (now + stretch == look_at) look();
  }
}

void ExperimentRun::advance_for(double duration_s) {
  if (pace_) simulation_.set_timestep(pace_->timestep_s(simulation_, duration_s));
  advance(steps_of(duration_s));
}

void ExperimentRun::report_progress(double fraction) {
  fraction_ = std::clamp(fraction, 0.0, 1.0);
  look();
}

void ExperimentRun::look() const {
  const RunRecord& record = observers_.record;
  const bool goes_on = !observers_.report || observers_.report(fraction_, simulation_);
  if (record.save_restart && (!goes_on || (record.is_restart_due && record.is_restart_due()))) {
    record.save_restart(simulation_, progress_);
  }
  if (goes_on) return;
  throw Interrupted(fmt::format("interrupted at {:.4f} s of the experiment", simulation_.time_s()));
}

Repeat ExperimentRun::finish(std::optional<double> value, std::uint64_t seed, Readings readings) {
  const double shortest_s =
      std::min(progress_.work.shortest_timestep_s, simulation_.setup().timestep_s);
  const auto keep_finite = [](std::optional<double>& number) {
    if (number && !std::isfinite(*number)) number.reset();
  };
  keep_finite(value);
  for (auto& [name, number] : readings) keep_finite(number);
  return {.seed = seed,
          .value = value,
          .readings = std::move(readings),
          .steps = progress_.work.steps,
          .timestep_s = shortest_s,
          .clump_steps = progress_.work.clump_steps,
          .state = std::make_shared<const Simulation>(std::move(simulation_))};
}

}  // namespace repose::dem
