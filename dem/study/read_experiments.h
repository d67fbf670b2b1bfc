#pragma once

#include "dem/study/section.h"
#include "dem/study/study.h"

namespace repose::dem {

/// [experiment.drop] ... [experiment.heap]: how each is done and what it gave on the bench.
/// Pictures are looked for in `folder`.
void read_experiments(Section experiments, const std::filesystem::path& folder, Study& study);

}  // namespace repose::dem
