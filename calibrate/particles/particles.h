#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dem/shape/clump/clump_shape.h"

/// Files of particle positions as simulation programs write them: tables, dumps, VTK.
namespace repose::calibrate {

/// Spheres as they are in a file.
struct Particles {
  /// Centres in the file's own axes. Metres if `unit` is known; otherwise the file's numbers.
  std::vector<dem::ClumpSphere> spheres;
  /// The grain that each sphere belongs to; empty: each sphere is a grain.
  std::vector<std::int64_t> grains;
  std::string unit;    ///< "mm"; empty: stated neither by the file nor by the user
  double unit_m = 1;   ///< of that unit; 1 if there is none
  std::string format;  ///< "LIGGGHTS or LAMMPS dump"
  std::string step;    ///< the one that was read, if the file has several
  int steps = 1;       ///< in the file
};

/// What the user states about a file.
struct ParticleReading {
  std::string unit = {};                   ///< of the numbers, if the file does not state it
  std::optional<double> step = {};         ///< std::nullopt: the last one
  std::optional<double> diameter_mm = {};  ///< of all particles, if the file has no radii
};

/// "m", "cm", "mm", "um", "in".
std::string names_of_units();
/// In metres; std::nullopt for any other word.
std::optional<double> unit_named(std::string_view name);

/// Whether a file holds particles: by its name, or by its first bytes if the name does not show it.
/// True of any table, and of repose's own states.
bool is_particle_file(const std::filesystem::path& file);

/// "CSV, LIGGGHTS or LAMMPS dump, ...".
std::string names_of_particle_files();

/// @throws base::InputError  everything that is wrong with it: missing columns, invalid numbers,
///   radii not above 0, a truncated file, contradictory units.
Particles read_particles(const std::filesystem::path& file, const ParticleReading& reading = {});

}  // namespace repose::calibrate
