#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/particles/particles.h"

/// What files of particles of all kinds have in common: columns of numbers with names.
namespace repose::calibrate {

/// A number of each particle.
struct ParticleColumn {
  std::string name;
  std::vector<double> values;
};

/// A file, before it is understood what its columns are.
struct ParticleColumns {
  std::string file;                     ///< as messages call it
  std::string format;                   ///< "VTK, XML"
  std::vector<ParticleColumn> columns;  ///< those that are of use; all of one length
  std::vector<std::string> names;       ///< all that there are, for messages
  std::string unit = {};                ///< that the file says of itself
  std::string step = {};                ///< that was chosen
  int steps = 1;
  /// Where a particle stands, for messages: "heap.dump:12"; empty: by its number.
  std::function<std::string(std::size_t particle)> place = {};
};

/// Whether a column is a coordinate, a size, a clump's number or a time step.
bool is_of_use(std::string_view name);
/// Whether x, y and z are among these.
bool has_places(const std::vector<std::string>& names);
/// A column's name without what EDEM puts around it: "Q01 : Particle Position X:".
std::string_view without_query_number(std::string_view name);

/// @throws base::InputError  columns that are missing or doubled, units, numbers.
Particles particles_of(ParticleColumns columns, const ParticleReading& reading);

// A reader for each kind of file. `text` is all of it.

ParticleColumns columns_in_dump(const std::string& file, std::string_view text,
                                const ParticleReading& reading);
/// Tables of any kind with a header; those that EDEM exports too.
ParticleColumns columns_in_table(const std::string& file, std::string_view text,
                                 const ParticleReading& reading);
ParticleColumns columns_in_legacy_vtk(const std::string& file, std::string_view text,
                                      const ParticleReading& reading);
/// .vtu and .vtp.
ParticleColumns columns_in_xml_vtk(const std::string& file, std::string_view text,
                                   const ParticleReading& reading);

/// Of steps with these labels, in the file's order, the one that is asked for, or the latest.
/// @throws base::InputError  there is no such step.
std::size_t chosen_step(const std::string& file, const std::vector<std::string>& labels,
                        const ParticleReading& reading);

}  // namespace repose::calibrate
