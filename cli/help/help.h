#pragma once

#include <vector>

#include "cli/common/command.h"

namespace repose::cli {

/// The program's purpose, in its help and its manual.
inline constexpr const char* kAbout =
    "Measures heaps of grains in photographs, simulates the bench experiments that\n"
    "give contact parameters, renders the simulations, and calibrates the parameters\n"
    "so that measurement and simulation agree.";

inline constexpr const char* kExamples = R"(
Examples:
  repose measure heap.jpg
  repose measure photos/ --overlay checked/ --csv angles.csv
  repose measure photos/ --method paper --json -
  repose compare photo.jpg render.png --overlay both.png
  repose shape nut.stl --spheres 11 --out nut.json
  repose simulate heap samples/hazelnut/study.toml --out heaps
  repose render heaps/heap_seed_1.vtp --out heap.png
  repose new soybean.toml --grains soybean --plate acrylic
  repose calibrate samples/hazelnut/study.toml --out hazelnut
  repose report hazelnut
  repose bench sliding angles.csv
  repose design ccd --factor e=.1:.3 --factor mu=.1:.3 --out runs.csv
  repose regress runs.csv --response angle_deg --target 23.38
  repose verify

Exit codes: 0 done, 1 internal error, 2 bad usage or input,
3 nothing measurable, 130 interrupted.
)";

/// The commands that describe all others: completion and manual.
std::vector<Command> help_commands(const std::vector<Command>& others);

}  // namespace repose::cli
