#pragma once

#include <memory>
#include <string>
#include <vector>

#include "calibrate/experiment/simulator.h"
#include "dem/study/study.h"

/// Other programs that make the runs of our studies, each an implementation of Simulator. Adding
/// one takes a file, and a line in the table of simulators.cpp.
namespace repose::calibrate {

/// Names of all simulators, ours first, as in [engine] program.
std::vector<std::string> simulator_names();

/// The simulator chosen by a study.
/// @throws base::InputError  there is none of this name, or it is not installed.
std::shared_ptr<const Simulator> simulator_for(const dem::Study& study);

/// @throws base::InputError  it cannot simulate all experiments of a study within the bounds of the
///   free coefficients, or lacks readings that were measured: all reasons.
/// @return  how its runs differ from ours, a sentence each
std::vector<std::string> check_for_fit(const Simulator& simulator, const dem::Study& study,
                                       const dem::ClumpShape& grain);

/// LIGGGHTS-PUBLIC 3.8, with the decks of calibrate/export. Proved by LiggghtsSimulator.* in
/// tests/peers.
/// @throws base::InputError  it is not installed.
std::shared_ptr<const Simulator> liggghts_simulator(const dem::EngineChoice& choice);

}  // namespace repose::calibrate
