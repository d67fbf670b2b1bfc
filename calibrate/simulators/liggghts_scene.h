#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "dem/engine/simulation.h"

/// Scenes of our engine as decks of LIGGGHTS-PUBLIC 3.8: particles given one by one, in place of an
/// experiment's. Read back grain by grain.
namespace repose::calibrate {

inline constexpr const char* kLiggghts = "liggghts";  ///< the command

/// What the installed program calls itself: "LIGGGHTS-PUBLIC 3.8.0"; where there is none, a fault.
std::string installed_liggghts(base::Faults& faults);

/// What a deck says besides the scene itself.
struct DeckOptions {
  std::string start = {};      ///< command that makes the box, and the grains if it can
  std::string insertion = {};  ///< commands that put the grains in, if `start` does not
  std::string integrator = "nve/sphere";
  std::string model_settings = {};  ///< as "limitForce on"
  double skin_m = .001;             ///< how far beyond contact the lists of neighbours reach
  std::string search = "bin";       ///< of neighbours; "nsq" for few of them in a wide box
};

/// The deck up to the first `run`: materials, contact laws, walls, gravity and time step.
/// @throws dem::CannotRun  a wall is no plane across an axis and no tube, or a law is not among
///   those of LIGGGHTS.
std::string deck_of(const dem::SimulationSetup& setup, const DeckOptions& options);

/// Restitutions that the deck has other values for, for people; empty: none.
std::string changed_restitutions(const dem::ContactTable& contacts);

/// The command that sets or renews gravity.
std::string gravity_command(const dem::Vector& gravity);

/// A file for the command `read_data`: grains of one sphere each, in a box that leaves them so much
/// room (m) on both sides of each axis. Grains that leave it are lost.
std::string data_of(const dem::SimulationSetup& setup, const std::vector<dem::Grain>& grains,
                    const dem::Vector& room);

/// A grain, and the force on it in N.
struct FrameGrain : dem::Grain {
  dem::Vector force = dem::Vector::Zero();
};

/// Commands that write all grains to frames.txt every so many steps, for `frames_of`.
std::string dump_command(int every_steps);

/// One list of grains (spheres) for each step that was written.
/// @throws base::InputError  a line cannot be read.
std::vector<std::vector<FrameGrain>> frames_of(const std::filesystem::path& folder);

}  // namespace repose::calibrate
