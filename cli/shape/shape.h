#pragma once

#include <string>

#include "cli/common/command.h"
#include "cli/common/output.h"

namespace repose::cli {

/// The arguments of `repose shape`, as typed.
struct ShapeArguments {
  std::string scan;          ///< STL, OBJ or PLY; either this or size_mm
  std::string size_mm;       ///< L,W,T
  std::string tip;           ///< 0 ... 1, with size_mm only
  std::string unit;          ///< mm|m, with a scan only
  std::string spheres;       ///< number of spheres
  std::string volume_error;  ///< a fraction, or a number and %; instead of `spheres`
  std::string density_kg_m3;
  std::string out_file;   ///< clump file
  std::string mesh_file;  ///< .glb or .stl for viewing
  std::string json_file;
};

/// Runs `repose shape`.
ExitCode run_shape(const ShapeArguments& arguments);

Command shape_command();

}  // namespace repose::cli
