#pragma once

#include <memory>
#include <string>

#include "dem/verify/case_peer.h"

namespace repose::calibrate {

/// A program, chosen by name, that runs the cases of `repose verify`.
/// @throws base::InputError  it cannot run them, is unknown, or is not installed.
std::unique_ptr<const dem::CasePeer> case_peer_of(const std::string& program);

/// LIGGGHTS-PUBLIC 3.8. Proved by LiggghtsCases.* in tests/peers.
/// @throws base::InputError  it is not installed.
std::unique_ptr<const dem::CasePeer> liggghts_cases();

}  // namespace repose::calibrate
