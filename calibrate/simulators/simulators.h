#pragma once

#include <memory>
#include <string>
#include <vector>

#include "calibrate/experiment/simulator.h"
#include "dem/study/study.h"

/// Other programs that make the runs of our studies, each an implementation of Simulator. A further
/// one is a file, and a line in the table of simulators.cpp.
namespace repose::calibrate {

/// Names of all of them, ours first, as [engine] program has them.
std::vector<std::string> simulator_names();

/// The one that a study asks for.
/// @throws base::InputError  there is none of that name, or it is not installed.
std::shared_ptr<const Simulator> simulator_for(const dem::Study& study);

/// @throws base::InputError  it cannot simulate all experiments of a study between the bounds of
///   what is sought, or has no such readings as were measured: every reason.
/// @return  what its runs do otherwise than ours, a sentence each
std::vector<std::string> check_for_fit(const Simulator& simulator, const dem::Study& study,
                                       const dem::ClumpShape& grain);

/// LIGGGHTS-PUBLIC 3.8, by the decks of calibrate/export. Proved by LiggghtsSimulator.* in
/// tests/peers.
/// @throws base::InputError  it is not installed.
std::shared_ptr<const Simulator> liggghts_simulator(const dem::EngineChoice& choice);

}  // namespace repose::calibrate
