#pragma once

#include <string>

#include "cli/common/command.h"
#include "cli/common/output.h"

namespace repose::cli {

/// The arguments of `repose new`, as typed.
struct NewArguments {
  std::string study;
  std::string grains;  ///< a kind of grain
  std::string plate;   ///< a kind of plate
  std::string tube;
  std::string incline;
  std::string pane;
  std::string grain_mm;  ///< L,W,T
  std::string density_kg_m3;
  std::string tube_mm;      ///< DxH
  std::string experiments;  ///< "drop,tilt"; empty: the default ones
};

/// Runs `repose new`.
ExitCode run_new(const NewArguments& arguments);

Command new_command();

}  // namespace repose::cli
