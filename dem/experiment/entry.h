#pragma once

#include <cstdint>
#include <string_view>

#include "dem/experiment/experiment_table.h"

/// Every experiment there is, in the order in which they are listed, a line each: NAME_entry() is
/// in the experiment's own source.
#define REPOSE_EXPERIMENTS(EXPERIMENT) \
  EXPERIMENT(drop)                     \
  EXPERIMENT(tilt)                     \
  EXPERIMENT(roll)                     \
  EXPERIMENT(heap)                     \
  EXPERIMENT(drop_on_grains)           \
  EXPERIMENT(tilt_on_grains)           \
  EXPERIMENT(roll_on_grains)           \
  EXPERIMENT(fill)                     \
  EXPERIMENT(pendulum)                 \
  EXPERIMENT(draw_down)

/// What the entries of the experiments are made with.
namespace repose::dem {

#define REPOSE_ENTRY(name) ExperimentEntry name##_entry();
REPOSE_EXPERIMENTS(REPOSE_ENTRY)
#undef REPOSE_ENTRY

/// A run_NAME() as ExperimentEntry::run.
template <typename Kind, Repeat (*kRun)(const Model&, const Kind&, std::uint64_t,
                                        const ProgressReport&, const RunRecord&)>
Repeat run_as(const Model& model, const Protocol& protocol, std::uint64_t seed,
              const ProgressReport& report, const RunRecord& record) {
  return kRun(model, protocol.as<Kind>(), seed, report, record);
}

inline constexpr std::string_view kWallRestitution = "contact.particle_wall.restitution";
inline constexpr std::string_view kWallSliding = "contact.particle_wall.sliding_friction";
inline constexpr std::string_view kWallRolling = "contact.particle_wall.rolling_friction";
inline constexpr std::string_view kGrainRestitution = "contact.particle_particle.restitution";
inline constexpr std::string_view kGrainSliding = "contact.particle_particle.sliding_friction";
inline constexpr std::string_view kGrainRolling = "contact.particle_particle.rolling_friction";

/// What things take on a core of 2020 or so, s. Measured with glass beads, of one sphere, and with
/// hazelnuts, of eleven.
///
/// An impact of a grain on a wall or on another one: its steps are so few, whatever the stiffness,
/// that making it ready takes longest.
inline constexpr double kImpact_s = 3e-3;
/// A step of some grains that are bonded, which touch walls alone or glued grains.
double step_on_wall_s(const Model& model, int bonded);
double step_on_grains_s(const Model& model, int bonded);

/// Time steps of the model's grains that meet each other or a plane this fast, s (time_step.h): of
/// grains that roll or slide, and of bulks.
double rolling_timestep_s(const Model& model, double speed_m_s);
double bulk_timestep_s(const Model& model, double speed_m_s);

}  // namespace repose::dem
