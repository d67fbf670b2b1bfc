#pragma once

#include "dem/study/read_particle.h"
#include "dem/study/section.h"
#include "dem/study/study.h"

namespace repose::dem {

/// Reads the sections of all experiments, such as [experiment.drop]: protocol and measured results.
void read_experiments(Section experiments, const NamedFiles& files, Study& study);

}  // namespace repose::dem
