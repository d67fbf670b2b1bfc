#pragma once

#include <optional>
#include <string>

namespace repose::dem {

class Section;

/// Our own engine, by its name in [engine].
inline constexpr const char* kOwnEngine = "repose";

/// Which program makes a study's runs: its section [engine]. What programs there are is not known
/// here.
struct EngineChoice {
  std::string program = kOwnEngine;
  int processes = 1;                ///< of a run of many grains
  std::string launcher = "mpirun";  ///< that starts them, where they are several
  /// Takes coefficients that the program has only approximately; else they are refused.
  bool takes_approximate = false;
  std::optional<double> timeout_s;  ///< of each run

  bool is_own() const { return program == kOwnEngine; }
};

/// [engine] itself; one that is not there is our own engine.
EngineChoice read_engine(Section engine);

}  // namespace repose::dem
