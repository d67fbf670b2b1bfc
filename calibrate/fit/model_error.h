#pragma once

#include "calibrate/fit/minimum.h"
#include "calibrate/fit/misfit.h"

namespace repose::calibrate {

/// How many times as wrong as Observable::model_sd says the model has to be, at least, for the
/// readings to differ from it by no more than chance and its own error make them: 1 where they do
/// as it is, where less than one degree of freedom is left to tell by, or where no reading has such
/// an error. `best` is the minimum of the misfit.
///
/// Formulae and reasons: THEORY.md, "The model's own error". Proved by ModelError.* in
/// tests/calibrate.
double model_error_scale(Misfit misfit, Minimum best);

}  // namespace repose::calibrate
