#include <algorithm>
#include <cmath>

#include "tests/support/other_kinds.h"
#include "tests/support/other_sites.h"

namespace repose::testing {
namespace {

/// One or two slopes on the ground; some have a flat top.
void wedge(Canvas& canvas, const Paint& paint, Random& random) {
  const double ground = indoors(canvas, random);
  const double width = random.uniform(.35, .7);
  const double left = random.uniform(.05, .95 - width);
  const double rise = std::min(width / 2 * std::tan(random.uniform(.3, .8)), .75 * ground);
  const double ridge = random.chance(.4) ? (random.chance(.5) ? 0. : 1.) : random.uniform(.3, .7);
  const double flat = random.chance(.4) ? random.uniform(.02, .3) * width : 0;
  const double top = left + ridge * (width - flat);
  ground_shadow(canvas, left, left + width, ground, random);
  canvas.fill(
      {{left, ground}, {top, ground - rise}, {top + flat, ground - rise}, {left + width, ground}},
      paint);
}

Paint steel(Random& random) {
  const double grey = random.uniform(.3, .7);
  return {.color = {grey, grey, grey * 1.03}, .contrast = .8, .towards_rad = 1.4};
}

void hammer(Canvas& canvas, Place at, double size, double turn_rad, Random& random) {
  const Paint handle = {
      .color = {.6, .42, .25}, .contrast = .5, .pattern = Pattern::wood, .pattern_scale = .002};
  const Places shaft = rectangle({at.x - .04 * size, at.y}, {at.x + .04 * size, at.y + size});
  const Places head = {{at.x - .3 * size, at.y - .02 * size},
                       {at.x - .1 * size, at.y - .12 * size},
                       {at.x + .28 * size, at.y - .12 * size},
                       {at.x + .28 * size, at.y + .1 * size},
                       {at.x - .1 * size, at.y + .06 * size}};
  canvas.fill(turned(shaft, at, turn_rad), handle);
  canvas.fill(turned(head, at, turn_rad), steel(random));
}

void pliers(Canvas& canvas, Place at, double size, double turn_rad, Random& random) {
  const Paint grip = smooth_paint(random);
  for (const double side : {-1., 1.}) {
    const Places leg = {{at.x, at.y},
                        {at.x + side * .25 * size, at.y + .4 * size},
                        {at.x + side * .2 * size, at.y + size},
                        {at.x + side * .12 * size, at.y + size},
                        {at.x + side * .14 * size, at.y + .4 * size}};
    const Places jaw = {{at.x - side * .05 * size, at.y + .05 * size},
                        {at.x + side * .13 * size, at.y - .1 * size},
                        {at.x + side * .02 * size, at.y - .4 * size},
                        {at.x, at.y - .1 * size}};
    canvas.fill(turned(rounded(leg, 2), at, turn_rad), grip);
    canvas.fill(turned(jaw, at, turn_rad), steel(random));
  }
}

}  // namespace

void draw_smooth_wedge(Canvas& canvas, Random& random) {
  wedge(canvas, smooth_paint(random), random);
}

void draw_patterned_wedge(Canvas& canvas, Random& random) {
  wedge(canvas, patterned_paint(random), random);
}

/// Lying on a board that is seen from above, or leaning against a wall.
void draw_tools(Canvas& canvas, Random& random) {
  const double high = canvas.height();
  if (random.chance(.5)) {
    canvas.fill(rectangle({-.1, -.1}, {1.1, high + .1}), any_paint(random));
  } else {
    indoors(canvas, random);
  }
  const int count = random.integer(1, 4);
  for (int i = 0; i < count; ++i) {
    const double y = high * random.uniform(.25, .55);
    const Place at((i + random.uniform(.3, .7)) / count, y);
    const double size = random.uniform(.2, .4);
    const double turn_rad = random.uniform(-2, 2);
    canvas.darken(ellipse(at + Place(.01, .1), .15 * size, .3 * size, turn_rad), .25, .02);
    if (random.chance(.5)) {
      hammer(canvas, at, size, turn_rad, random);
    } else {
      pliers(canvas, at, size, turn_rad, random);
    }
  }
}

/// An inclined belt on legs, rising from the ground; sometimes two that meet.
void draw_conveyor(Canvas& canvas, Random& random) {
  const double ground = random.chance(.5) ? outdoors(canvas, random) : indoors(canvas, random);
  const Paint frame = smooth_paint(random);
  const double slope = std::tan(random.uniform(.2, .6));
  const double length = random.uniform(.3, .45);
  const double middle = random.uniform(.48, .52);
  const double thick = random.uniform(.015, .04);
  for (const double side : {-1., 1.}) {
    if (side > 0 && random.chance(.5)) break;
    const Place low(middle + side * length, ground - .03);
    const Place top(middle, ground - .03 - length * slope);
    for (int i = 1; i <= 4; ++i) {
      const Place on = low + (top - low) * (i / 4.);
      canvas.stroke({on, {on.x, ground}}, .01, frame);
    }
    canvas.fill({low, top, top + Place(0, thick), low + Place(0, thick)}, smooth_paint(random));
    for (const Place end : {low, top}) {
      canvas.fill(ellipse(end + Place(0, thick / 2), .7 * thick, .7 * thick),
                  {.color = {.3, .3, .3}, .shading = Shading::ball, .contrast = .5});
    }
  }
}

}  // namespace repose::testing
