#pragma once

#include "dem/study/section.h"
#include "dem/study/study.h"

namespace repose::dem {

/// What the program can compute with.
inline constexpr Range kPossibleYoung_pa = above(0, 1e13);
inline constexpr Range kPossibleDensity_kg_m3 = above(0, 1e6);
inline constexpr Range kPossiblePoisson = from_to_below(0, .5);

/// Files that a study names.
struct NamedFiles {
  std::filesystem::path folder;  ///< where they are looked for
  bool must_exist = true;
};

/// [particle]: shape and material of the grain.
void read_particle(Section particle, const NamedFiles& files, Study& study);

/// [wall]: what the walls are made of, and in [wall.tube] and so on the parts of another material.
void read_wall(Section wall, Study& study);

/// A file named in a study; an error when there must be one and is none. `value` is where it is
/// named.
std::filesystem::path file_named(const Section& section, const ConfigValue& value,
                                 const std::string& name, const NamedFiles& files);

}  // namespace repose::dem
