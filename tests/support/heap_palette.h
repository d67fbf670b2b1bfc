#pragma once

#include "tests/support/heap_random.h"
#include "tests/support/heap_scene.h"

namespace repose::testing {

/// Perceived difference (CIE 1976) between grains, as shaded, and a flat colour.
double contrast(const Color& grain, const Color& flat);

/// Chooses colours of grains, backdrop, plate and table that a person can tell apart: the contrast
/// between grains and backdrop lies in the range, that between grains and plate is at least half
/// its lower end.
void choose_colors(HeapScene& scene, double least_contrast, double most_contrast, Random& random);

}  // namespace repose::testing
