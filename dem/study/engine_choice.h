#pragma once

#include <optional>
#include <string>

namespace repose::dem {

class Section;

/// Name of our own engine in [engine].
inline constexpr const char* kOwnEngine = "repose";

/// Which program performs a study's runs: its section [engine]. The available programs are not
/// known here.
struct EngineChoice {
  std::string program = kOwnEngine;
  int processes = 1;                ///< for a run of many grains
  std::string launcher = "mpirun";  ///< starts them if there are several
  /// Accepts coefficients that the program supports only approximately; otherwise an error.
  bool takes_approximate = false;
  std::optional<double> timeout_s;  ///< of each run

  bool is_own() const { return program == kOwnEngine; }
};

/// Reads [engine]; if missing, our own engine.
EngineChoice read_engine(Section engine);

}  // namespace repose::dem
