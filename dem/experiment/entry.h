#pragma once

#include <cstdint>
#include <string_view>

#include "dem/experiment/experiment_table.h"

/// All experiments in listing order, one per line: NAME_entry() is defined in the experiment's own
/// source.
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

/// Building blocks of the experiments' entries.
namespace repose::dem {

#define REPOSE_ENTRY(name) ExperimentEntry name##_entry();
REPOSE_EXPERIMENTS(REPOSE_ENTRY)
#undef REPOSE_ENTRY

/// Adapts a run_NAME() to ExperimentEntry::run.
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

/// Computing times on a core of about 2020, s. Measured with glass beads (one sphere) and hazelnuts
/// (eleven).
///
/// An impact of a grain on a wall or another grain: it has so few steps, whatever the stiffness,
/// that setup dominates.
inline constexpr double kImpact_s = 3e-3;
/// One step of `bonded` grains that touch only walls, or glued grains.
double step_on_wall_s(const Model& model, int bonded);
double step_on_grains_s(const Model& model, int bonded);

/// Time steps, s, for the model's grains meeting each other or a plane at this speed (time_step.h):
/// for grains that roll or slide, and for bulks.
double rolling_timestep_s(const Model& model, double speed_m_s);
double bulk_timestep_s(const Model& model, double speed_m_s);

}  // namespace repose::dem
