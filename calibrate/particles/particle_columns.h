#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/particles/particles.h"

/// What all particle file formats have in common: named columns of numbers.
namespace repose::calibrate {

/// One number for each particle.
struct ParticleColumn {
  std::string name;
  std::vector<double> values;
};

/// A file whose columns have not been interpreted yet.
struct ParticleColumns {
  std::string file;                     ///< name in messages
  std::string format;                   ///< "VTK, XML"
  std::vector<ParticleColumn> columns;  ///< those that are used; all of the same length
  std::vector<std::string> names;       ///< of all columns, for messages
  std::string unit = {};                ///< as the file states it
  std::string step = {};                ///< the chosen one
  int steps = 1;
  /// A particle's location in the file, for messages: "heap.dump:12"; empty: its number is used.
  std::function<std::string(std::size_t particle)> place = {};
};

/// Whether a column is a coordinate, a size, a clump's number or a time step.
bool is_of_use(std::string_view name);
/// Whether the names include x, y and z.
bool has_places(const std::vector<std::string>& names);
/// A column's name without EDEM's prefix and suffix: "Q01 : Particle Position X:".
std::string_view without_query_number(std::string_view name);

/// @throws base::InputError  missing or duplicate columns, bad units or numbers.
Particles particles_of(ParticleColumns columns, const ParticleReading& reading);

// One reader per file format. `text` is the whole file.

ParticleColumns columns_in_dump(const std::string& file, std::string_view text,
                                const ParticleReading& reading);
/// Any table with a header, including EDEM's exports.
ParticleColumns columns_in_table(const std::string& file, std::string_view text,
                                 const ParticleReading& reading);
ParticleColumns columns_in_legacy_vtk(const std::string& file, std::string_view text,
                                      const ParticleReading& reading);
/// .vtu and .vtp.
ParticleColumns columns_in_xml_vtk(const std::string& file, std::string_view text,
                                   const ParticleReading& reading);

/// Index, among step labels in the file's order, of the requested step, or of the latest.
/// @throws base::InputError  there is no such step.
std::size_t chosen_step(const std::string& file, const std::vector<std::string>& labels,
                        const ParticleReading& reading);

}  // namespace repose::calibrate
