#pragma once

#include "dem/study/read_particle.h"
#include "dem/study/section.h"
#include "dem/study/study.h"

namespace repose::dem {

/// The sections of all experiments, [experiment.drop] and so on: how each is done and what it gave
/// on the bench.
void read_experiments(Section experiments, const NamedFiles& files, Study& study);

}  // namespace repose::dem
