#pragma once

#include "tests/support/canvas.h"

/// Settings and paints for objects that are not heaps.
namespace repose::testing {

Color any_color(Random& random);
/// Shaded evenly, sometimes nearly flat.
Paint smooth_paint(Random& random);
/// Bricks, planks, cloth and the like.
Paint patterned_paint(Random& random);
Paint any_paint(Random& random);
Color times(const Color& color, double light);

/// A wall with a floor or table in front, some with clutter; returns the ground's height.
double indoors(Canvas& canvas, Random& random);
/// Sky and ground, some with hills; returns the ground's height.
double outdoors(Canvas& canvas, Random& random);

/// Six-sided box whose front stands on `ground`, with its top and one side in perspective.
void stand_box(Canvas& canvas, double left, double ground, double width, double height,
               const Paint& paint, Random& random);
/// Soft shadow on the ground below an object.
void ground_shadow(Canvas& canvas, double left, double right, double ground, Random& random);

}  // namespace repose::testing
