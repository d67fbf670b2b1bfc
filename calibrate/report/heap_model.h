#pragma once

#include "calibrate/report/document.h"
#include "render/scene/scene.h"

namespace repose::calibrate::report {

/// The grains of a heap as a rotatable chart: few triangles per grain, lengths in mm. If the heap
/// is too large for a page, grains that lie below others are omitted.
Chart heap_model(const render::Scene& scene);

}  // namespace repose::calibrate::report
