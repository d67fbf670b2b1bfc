#pragma once

#include "dem/study/section.h"
#include "dem/study/study.h"

namespace repose::dem {

/// Ranges that the program can compute with.
inline constexpr Range kPossibleYoung_pa = above(0, 1e13);
inline constexpr Range kPossibleDensity_kg_m3 = above(0, 1e6);
inline constexpr Range kPossiblePoisson = from_to_below(0, .5);

/// Options for files that a study names.
struct NamedFiles {
  std::filesystem::path folder;  ///< where they are looked for
  bool must_exist = true;
};

/// Reads [particle]: shape and material of the grain.
void read_particle(Section particle, const NamedFiles& files, Study& study);

/// Reads [wall]: material of the walls and, in [wall.tube] and so on, of parts made of another
/// material.
void read_wall(Section wall, Study& study);

/// Path of a file named in a study; adds an error if it must exist and does not. `value` is where
/// it is named.
std::filesystem::path file_named(const Section& section, const ConfigValue& value,
                                 const std::string& name, const NamedFiles& files);

}  // namespace repose::dem
