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

/// One step of a grain that touches walls alone, on a core of 2020 or so.
inline constexpr double kAloneStep_s = 1.5e-6;

/// One step of a grain among others, and of bodies on glued grains, on a core of 2020 or so, s.
/// Measured: a grain of one sphere takes 160 ns to 230, one of eleven 150 to 300; a body of one
/// sphere on glued grains 500 ns, one of 33 three microseconds.
double bulk_step_s(const Model& model);
double step_on_grains_s(const Model& model, int bonded);

/// Time step of the model's grains on a plane that they meet this fast, s: for readings of single
/// impacts, and for those that no single impact decides.
double impact_timestep_s(const Model& model, double speed_m_s);
double course_timestep_s(const Model& model, double speed_m_s);

}  // namespace repose::dem
