#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dem/shape/clump/clump_shape.h"

/// Files with the places of particles, as simulation programs write them: tables, dumps, VTK.
namespace repose::calibrate {

/// Spheres, as a file has them.
struct Particles {
  /// Centres with the file's own axes. Metres where `unit` is known; else the file's numbers.
  std::vector<dem::ClumpSphere> spheres;
  /// The grain that each sphere belongs to; empty: each is a grain by itself.
  std::vector<std::int64_t> grains;
  std::string unit;    ///< "mm"; empty: neither the file nor anybody else tells it
  double unit_m = 1;   ///< of that unit; 1 where there is none
  std::string format;  ///< "LIGGGHTS or LAMMPS dump"
  std::string step;    ///< of a file of several: the one that was read
  int steps = 1;       ///< that the file has
};

/// What is told of a file beside it.
struct ParticleReading {
  std::string unit = {};                   ///< of numbers whose unit the file does not say
  std::optional<double> step = {};         ///< none: the last one
  std::optional<double> diameter_mm = {};  ///< of all, where the file has no radius
};

/// "m", "cm", "mm", "um", "in".
std::string names_of_units();
/// In metres; none for another word.
std::optional<double> unit_named(std::string_view name);

/// Whether a file is one of particles: by its name, or by its first bytes where the name says
/// nothing. True of any table, and of repose's own states.
bool is_particle_file(const std::filesystem::path& file);

/// "CSV, LIGGGHTS or LAMMPS dump, ...".
std::string names_of_particle_files();

/// @throws base::InputError  all that is wrong with it: no such columns, numbers that are none,
/// radii that are not above 0, a file that is cut short, units that contradict each other.
Particles read_particles(const std::filesystem::path& file, const ParticleReading& reading = {});

}  // namespace repose::calibrate
