#pragma once

#include "tests/support/canvas.h"

/// Objects that are not heaps. Those marked as hard have straight or hollow flanks that stand on a
/// ground line.
namespace repose::testing {

// other_rooms.cpp
void draw_room(Canvas& canvas, Random& random);
void draw_staircase(Canvas& canvas, Random& random);
void draw_boxes(Canvas& canvas, Random& random);
void draw_books(Canvas& canvas, Random& random);
void draw_cloth(Canvas& canvas, Random& random);  ///< hard

// other_buildings.cpp
void draw_gabled_roof(Canvas& canvas, Random& random);
void draw_tiled_roof(Canvas& canvas, Random& random);
void draw_roof_on_ground(Canvas& canvas, Random& random);  ///< hard
void draw_pyramid(Canvas& canvas, Random& random);         ///< hard
void draw_tent(Canvas& canvas, Random& random);            ///< hard
void draw_bridge(Canvas& canvas, Random& random);

// other_landscapes.cpp
void draw_mountains(Canvas& canvas, Random& random);
void draw_trees(Canvas& canvas, Random& random);
void draw_clouds(Canvas& canvas, Random& random);
void draw_road(Canvas& canvas, Random& random);

// other_signs.cpp
void draw_warning_sign(Canvas& canvas, Random& random);
void draw_letters(Canvas& canvas, Random& random);
void draw_logo(Canvas& canvas, Random& random);

// other_tools.cpp
void draw_smooth_wedge(Canvas& canvas, Random& random);     ///< hard
void draw_patterned_wedge(Canvas& canvas, Random& random);  ///< hard
void draw_tools(Canvas& canvas, Random& random);
void draw_conveyor(Canvas& canvas, Random& random);

// other_things.cpp
void draw_cone(Canvas& canvas, Random& random);          ///< hard
void draw_striped_cone(Canvas& canvas, Random& random);  ///< hard
void draw_bottles(Canvas& canvas, Random& random);
void draw_balls(Canvas& canvas, Random& random);
void draw_car(Canvas& canvas, Random& random);

// other_bodies.cpp
void draw_animal(Canvas& canvas, Random& random);
void draw_hand(Canvas& canvas, Random& random);

}  // namespace repose::testing
