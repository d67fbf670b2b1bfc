#pragma once

#include <string>

#include "calibrate/export/export.h"
#include "dem/experiment/protocol.h"

namespace repose::calibrate {

/// Whether a target has a deck for an experiment that is done so. Each of them has been run: see
/// tests/peers. EDEM has tables in place of decks, which hold for all.
bool has_decks(ExportTarget target, const dem::Protocol& protocol);

/// Names of all experiments with a deck: "drop, tilt".
std::string names_with_decks(ExportTarget target);

}  // namespace repose::calibrate
