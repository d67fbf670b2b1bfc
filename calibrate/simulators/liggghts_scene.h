#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "dem/engine/simulation.h"

/// Scenes of our engine as decks of LIGGGHTS-PUBLIC 3.8: particles are given one by one rather than
/// by an experiment, and read back one by one.
namespace repose::calibrate {

inline constexpr const char* kLiggghts = "liggghts";  ///< the command

/// Name and version of the installed program: "LIGGGHTS-PUBLIC 3.8.0"; adds an error if there is
/// none.
std::string installed_liggghts(base::Faults& faults);

/// Settings of a deck besides the scene itself.
struct DeckOptions {
  std::string start = {};      ///< command that creates the box, and possibly the grains
  std::string insertion = {};  ///< commands that insert the grains, if `start` does not
  std::string integrator = "nve/sphere";
  std::string model_settings = {};  ///< such as "limitForce on"
  double skin_m = .001;             ///< distance beyond contact covered by neighbour lists
  std::string search = "bin";       ///< of neighbours; "nsq" for few particles in a wide box
};

/// The deck up to the first `run`: materials, contact laws, walls, gravity and time step.
/// @throws dem::CannotRun  a wall is neither a plane normal to an axis nor a tube, or LIGGGHTS does
///   not have a law.
std::string deck_of(const dem::SimulationSetup& setup, const DeckOptions& options);

/// Restitutions whose values differ in the deck, as text; empty: none.
std::string changed_restitutions(const dem::ContactTable& contacts);

/// The command that sets or renews gravity.
std::string gravity_command(const dem::Vector& gravity);

/// A file for the command `read_data`: grains of one sphere each, in a box with `room` (m) around
/// them on both sides of each axis. Grains that leave it are lost.
std::string data_of(const dem::SimulationSetup& setup, const std::vector<dem::Grain>& grains,
                    const dem::Vector& room);

/// A grain, and the force on it [N].
struct FrameGrain : dem::Grain {
  dem::Vector force = dem::Vector::Zero();
};

/// Commands that write all grains to frames.txt every `every_steps` steps, for frames_of().
std::string dump_command(int every_steps);

/// One list of grains (spheres) for each written step.
/// @throws base::InputError  a line cannot be read.
std::vector<std::vector<FrameGrain>> frames_of(const std::filesystem::path& folder);

}  // namespace repose::calibrate
