#pragma once

#include "dem/study/section.h"
#include "dem/study/study.h"

namespace repose::dem {

/// Reads [contact]: rolling and damping model, and the coefficients of all pairs. `study` must have
/// its walls already.
void read_contact(Section contact, Study& study);

}  // namespace repose::dem
