#pragma once

#include <string>

#include "render/truth.h"

namespace repose::cli {

/// What is known exactly about a picture, for programs.
std::string truth_json(const render::Truth& truth);

}  // namespace repose::cli
