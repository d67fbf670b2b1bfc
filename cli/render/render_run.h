#pragma once

#include "cli/render/render.h"
#include "cli/render/render_options.h"

namespace repose::cli {

/// Draws the film of a run, and writes what is exact about it where that is asked for.
/// @throws base::InputError  the trajectory cannot be read, or a file cannot be written.
void render_run_film(const RenderArguments& arguments, const RenderPlan& plan);

}  // namespace repose::cli
