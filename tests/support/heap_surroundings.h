#pragma once

#include "tests/support/heap_paint.h"
#include "tests/support/heap_profile.h"
#include "tests/support/heap_random.h"
#include "tests/support/heap_scene.h"

/// Everything in the picture that is not grains.
namespace repose::testing {

/// Wall behind the heap with its texture and the heap's shadow on it.
void paint_backdrop(Stage& stage, const HeapScene& scene, const HeapProfile& profile,
                    Random& random);

/// Open cylinder hanging above the crest, out of the frame at the top.
void paint_tube(Stage& stage, const HeapScene& scene, const HeapProfile& profile);

/// Upright ruler beside the heap.
void paint_ruler(Stage& stage, const HeapScene& scene, const HeapProfile& profile, Random& random);

/// Walls that a half heap or a column leans against.
void paint_walls(Stage& stage, const HeapScene& scene, const HeapProfile& profile);

/// Front edge of the plate and the table below; covers what reaches below the ground line.
void paint_ground(Stage& stage, const HeapScene& scene, const HeapProfile& profile, Random& random);

/// Table top that rises to a horizon behind the heap, for views from above.
void paint_table_top(Stage& stage, const HeapScene& scene, Random& random);

}  // namespace repose::testing
