#pragma once

#include <string_view>
#include <vector>

#include "dem/study/experiment_table.h"

/// The rows of the table of experiments, each in a file of its own.
namespace repose::dem {

ExperimentEntry drop_entry();
ExperimentEntry tilt_entry();
ExperimentEntry roll_entry();
ExperimentEntry heap_entry();
ExperimentEntry drop_on_grains_entry();
ExperimentEntry tilt_on_grains_entry();
ExperimentEntry roll_on_grains_entry();
ExperimentEntry fill_entry();
ExperimentEntry pendulum_entry();
ExperimentEntry draw_down_entry();

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
/// A step of a grain among others.
double bulk_step_s(const Model& model);
/// A step of some grains that are bonded, which touch walls alone or glued grains.
double step_on_wall_s(const Model& model, int bonded);
double step_on_grains_s(const Model& model, int bonded);

/// Time steps of the model's grains that meet each other or a plane this fast, s (time_step.h): of
/// grains that roll or slide, and of bulks.
double rolling_timestep_s(const Model& model, double speed_m_s);
double bulk_timestep_s(const Model& model, double speed_m_s);

}  // namespace repose::dem
