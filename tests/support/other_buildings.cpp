#include <array>
#include <cmath>

#include "tests/support/other_kinds.h"
#include "tests/support/other_sites.h"

namespace repose::testing {
namespace {

/// Random left edge of an object of this width.
double any_left(double width, Random& random) {
  return .5 - width / 2 + random.uniform(-.45, .45) * (.95 - width);
}

void house(Canvas& canvas, const Paint& roof, const Paint& wall, Random& random) {
  const double ground = outdoors(canvas, random);
  const double width = random.uniform(.4, .7);
  const double left = any_left(width, random);
  const double walls = random.uniform(.08, .2);
  const double over = random.uniform(0, .04);
  const double rise = (width / 2 + over) * std::tan(random.uniform(.35, .8));
  const double eaves = ground - walls;
  const double ridge = random.chance(.6) ? 0 : random.uniform(.1, .4) * width;  // hipped
  canvas.fill(rectangle({left, eaves}, {left + width, ground}), wall);
  canvas.fill({{left - over, eaves},
               {left + (width - ridge) / 2, eaves - rise * (1 - ridge / width)},
               {left + (width + ridge) / 2, eaves - rise * (1 - ridge / width)},
               {left + width + over, eaves}},
              roof);
  for (double x = left + .06; x + .09 < left + width; x += random.uniform(.1, .2)) {
    canvas.fill(rectangle({x, eaves + .3 * walls}, {x + .05, eaves + .75 * walls}),
                {.color = {.2, .25, .3}, .contrast = .6});
  }
}

Paint of_pattern(Pattern pattern, double strength, Random& random) {
  Paint paint = smooth_paint(random);
  paint.pattern = pattern;
  paint.pattern_strength = strength;
  paint.pattern_scale = random.uniform(.008, .022);
  return paint;
}

Pattern masonry(Random& random) {
  return random.pick(std::array{Pattern::bricks, Pattern::tiles, Pattern::planks});
}

}  // namespace

void draw_gabled_roof(Canvas& canvas, Random& random) {
  const Paint wall = smooth_paint(random);
  house(canvas, smooth_paint(random), wall, random);
}

void draw_tiled_roof(Canvas& canvas, Random& random) {
  const Paint roof = of_pattern(Pattern::tiles, random.uniform(.15, .4), random);
  house(canvas, roof, of_pattern(Pattern::bricks, random.uniform(.1, .3), random), random);
}

/// Its eaves are on the ground; sometimes with a door in the gable.
void draw_roof_on_ground(Canvas& canvas, Random& random) {
  const double ground = outdoors(canvas, random);
  const double width = random.uniform(.4, .75);
  const double left = any_left(width, random);
  const double rise = width / 2 * std::tan(random.uniform(.35, .85));
  const double ridge = left + width * random.uniform(.42, .58);
  ground_shadow(canvas, left, left + width, ground, random);
  const double strength = random.uniform(.1, .35);
  canvas.fill({{left, ground}, {ridge, ground - rise}, {left + width, ground}},
              of_pattern(masonry(random), strength, random));
  if (random.chance(.4)) {
    canvas.fill(rectangle({ridge - .03, ground - .3 * rise}, {ridge + .03, ground}),
                {.color = {.15, .12, .1}});
  }
}

/// One or two of its faces are visible.
void draw_pyramid(Canvas& canvas, Random& random) {
  const double ground = random.chance(.7) ? outdoors(canvas, random) : indoors(canvas, random);
  const double width = random.uniform(.4, .75);
  const double left = any_left(width, random);
  const double rise = width / 2 * std::tan(random.uniform(.3, .75));
  const Place top(left + width / 2, ground - rise);
  Paint face = random.chance(.4) ? smooth_paint(random)
                                 : of_pattern(Pattern::bricks, random.uniform(.1, .3), random);
  ground_shadow(canvas, left, left + width, ground, random);
  canvas.fill({{left, ground}, top, {left + width, ground}}, face);
  if (random.chance(.6)) {
    const Place corner(left + width * random.uniform(.45, .85), ground);
    face.color = times(face.color, random.uniform(.6, .9));
    canvas.fill({corner, top, {left + width, ground}}, face);
  }
}

/// Its sides sag, as canvas does.
void draw_tent(Canvas& canvas, Random& random) {
  const double ground = outdoors(canvas, random);
  const double width = random.uniform(.35, .65);
  const double left = any_left(width, random);
  const double rise = width / 2 * std::tan(random.uniform(.5, .95));
  const double sag = random.uniform(0, .35);
  Places outline;
  for (double u = -1; u <= 1; u += .02) {
    const double high = std::pow(1 - std::abs(u), 1 + sag);
    outline.push_back({left + width * (1 + u) / 2, ground - rise * high});
  }
  Paint paint = smooth_paint(random);
  if (random.chance(.4)) {
    paint.pattern = random.chance(.5) ? Pattern::stripes : Pattern::fabric;
    paint.pattern_scale = random.uniform(.003, .03);
  }
  ground_shadow(canvas, left, left + width, ground, random);
  canvas.fill(outline, paint);
  const double middle = left + width / 2;
  if (random.chance(.6)) {
    const double half = random.uniform(.06, .2) * width;
    canvas.fill({{middle - half, ground}, {middle, ground - .7 * rise}, {middle + half, ground}},
                {.color = times(paint.color, .35), .contrast = .5});
  }
  for (const double end : {left - .08, left + width + .08}) {
    canvas.stroke({{middle, ground - rise}, {end, ground}}, .002, {.color = {.8, .8, .75}});
  }
}

void draw_bridge(Canvas& canvas, Random& random) {
  const double ground = outdoors(canvas, random);
  const double deck = ground - random.uniform(.08, .2);
  const Paint paint = any_paint(random);
  canvas.fill(rectangle({-.1, deck}, {1.1, deck + .02}), paint);
  const int piers = random.integer(2, 5);
  const double gap = 1.0 / piers;
  const double high = random.uniform(.1, .22);
  const bool hangs = random.chance(.5);
  for (int i = 0; i < piers; ++i) {
    const double x = (i + .5) * gap;
    canvas.fill(rectangle({x - .012, deck - (hangs ? high : 0)}, {x + .012, ground}), paint);
    Places cable;
    for (double u = -.5; u <= .5; u += .02) {
      const double sink = 4 * u * u;
      cable.push_back({x + gap / 2 + u * gap, hangs ? deck - high * sink : deck + .06 * sink});
    }
    canvas.stroke(cable, hangs ? .004 : .015, paint);
  }
}

}  // namespace repose::testing
