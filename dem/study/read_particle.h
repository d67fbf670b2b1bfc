#pragma once

#include "dem/study/section.h"
#include "dem/study/study.h"

namespace repose::dem {

/// [particle]: shape and material of the grain. Files are looked for in `folder`.
void read_particle(Section particle, const std::filesystem::path& folder, Study& study);

/// [wall]: what all walls are made of.
void read_wall(Section wall, Study& study);

/// A file named in a study; a fault when there is none. `value` is where it is named.
std::filesystem::path existing_file(const Section& section, const ConfigValue& value,
                                    const std::string& name, const std::filesystem::path& folder);

}  // namespace repose::dem
