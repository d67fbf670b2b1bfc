#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dem/engine/simulation.h"
#include "tests/support/run_program.h"

/// Our scenes as LIGGGHTS decks, and what it makes of them. Written for LIGGGHTS-PUBLIC 3.8, which
/// Debian has as the package `liggghts`.
namespace repose::testing {

inline constexpr const char* kNoLiggghts =
    "liggghts is not installed; nothing was compared. Fix: apt-get install liggghts";

bool has_liggghts();

/// What a deck says besides the scene itself.
struct DeckOptions {
  std::string start;      ///< command that makes the box, and the grains if it can
  std::string insertion;  ///< commands that put the grains in, if `start` does not
  std::string integrator = "nve/sphere";
  std::string model_settings;  ///< as "limitForce on"
  double skin_m = .001;        ///< how far beyond contact the lists of neighbours reach
};

/// The deck up to the first `run`: materials, contact laws, walls, gravity and time step.
///
/// Walls have to be planes across an axis or tubes about z, and rolling friction that of LIGGGHTS
/// or none; throws std::invalid_argument otherwise.
std::string deck_of(const dem::SimulationSetup& setup, const DeckOptions& options);

/// The command that sets or renews gravity.
std::string gravity_command(const dem::Vector& gravity);

/// A file for the command `read_data`: grains of one sphere each, in a box that leaves them so much
/// room (m) on both sides of each axis. Grains that leave it are lost.
std::string data_of(const dem::SimulationSetup& setup, const std::vector<dem::Grain>& grains,
                    const dem::Vector& room);

/// Commands that write all grains to frames.txt every so many steps, for `frames_of`.
std::string dump_command(int every_steps);

/// One list of grains (spheres) for each step that was written.
std::vector<std::vector<dem::Grain>> frames_of(const std::filesystem::path& folder);

/// Throws std::runtime_error with the last of its output when it fails.
Finished run_liggghts(const TemporaryFolder& folder, const std::string& deck);

}  // namespace repose::testing
