#pragma once

#include "calibrate/report/document.h"
#include "render/scene/scene.h"

namespace repose::calibrate::report {

/// The grains of a heap as a chart that can be rotated: each with few triangles, lengths in mm. Of
/// heaps too large for a page the grains are left out that lie below others.
Chart heap_model(const render::Scene& scene);

}  // namespace repose::calibrate::report
