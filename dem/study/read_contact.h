#pragma once

#include "dem/study/section.h"
#include "dem/study/study.h"

namespace repose::dem {

/// [contact]: the rolling model, and the coefficients of all pairs, once `study` has its walls.
void read_contact(Section contact, Study& study);

}  // namespace repose::dem
