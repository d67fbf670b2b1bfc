#include <cmath>

#include "tests/support/other_kinds.h"
#include "tests/support/other_sites.h"

namespace repose::testing {

void draw_room(Canvas& canvas, Random& random) {
  const double high = canvas.height();
  const double from_y = high * random.uniform(.15, .3);
  const Place from(random.uniform(.15, .35), from_y);
  const double to_y = high * random.uniform(.55, .7);
  const Place to(random.uniform(.65, .85), to_y);
  const Paint wall = smooth_paint(random);
  Paint side = wall;
  side.color = times(wall.color, random.uniform(.7, .95));
  canvas.fill(rectangle({-.1, -.1}, {1.1, from.y}), {.color = {.9, .9, .88}});
  canvas.fill({{-.1, -.1}, from, {from.x, to.y}, {-.1, high + .1}}, side);
  canvas.fill({{1.1, -.1}, {to.x, from.y}, to, {1.1, high + .1}}, side);
  Paint floor = any_paint(random);
  canvas.fill({{from.x, to.y}, to, {1.1, high + .1}, {-.1, high + .1}}, floor);
  canvas.fill(rectangle(from, to), wall);
  const double window = random.uniform(from.x, to.x - .15);
  canvas.fill(rectangle({window, from.y + .03}, {window + .12, from.y + .03 + .1}),
              {.color = {.85, .92, .97}});
  const int count = random.integer(2, 5);
  for (int i = 0; i < count; ++i) {
    const double ground = random.uniform(to.y + .02, high);
    const double width = random.uniform(.08, .28);
    const double left = random.uniform(.05, .8);
    ground_shadow(canvas, left, left + width, ground, random);
    const Paint paint = any_paint(random);
    stand_box(canvas, left, ground, width, random.uniform(.05, .25), paint, random);
  }
}

/// Rises from one side, or to a landing from both.
void draw_staircase(Canvas& canvas, Random& random) {
  const double ground = indoors(canvas, random);
  const int steps = random.integer(4, 14);
  const double rise = random.uniform(.3, .55) * ground / steps;
  const double run = rise * random.uniform(1.2, 2.2);
  const bool both = random.chance(.5);
  const double left = random.uniform(.02, .2);
  Places outline = {{left, ground}};
  for (int i = 0; i < steps; ++i) {
    outline.push_back({left + i * run, ground - (i + 1) * rise});
    outline.push_back({left + (i + 1) * run, ground - (i + 1) * rise});
  }
  const double top = left + steps * run;
  if (both) {
    for (int i = steps; i > 0; --i) {
      outline.push_back({top + (steps - i) * run, ground - i * rise});
      outline.push_back({top + (steps - i + 1) * run, ground - i * rise});
    }
  }
  outline.push_back({outline.back().x, ground});
  canvas.fill(outline, any_paint(random));
}

void draw_boxes(Canvas& canvas, Random& random) {
  const double ground = indoors(canvas, random);
  const int rows = random.integer(1, 4);
  const double size = random.uniform(.09, .18);
  const double left = random.uniform(.05, .3);
  ground_shadow(canvas, left, left + rows * size, ground, random);
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < rows - row; ++i) {
      const double from = left + (i + .5 * row) * size * 1.05;
      stand_box(canvas, from, ground - .6 * size * row, size, .6 * size, any_paint(random), random);
    }
  }
}

/// Stacked, or leaning.
void draw_books(Canvas& canvas, Random& random) {
  const double ground = indoors(canvas, random);
  const bool is_pile = random.chance(.6);
  const int count = random.integer(4, 10);
  const double middle = random.uniform(.35, .65);
  double at = is_pile ? ground : random.uniform(.15, .4);
  for (int i = 0; i < count; ++i) {
    const double thick = random.uniform(.015, .045);
    const double length = random.uniform(.2, .35) * (is_pile ? 1 - .5 * i / count : .7);
    const double aside = random.uniform(-.03, .03);
    const Paint paint = smooth_paint(random);
    if (is_pile) {
      canvas.fill(
          rectangle({middle + aside - length / 2, at - thick}, {middle + aside + length / 2, at}),
          paint);
      at -= thick;
    } else {
      const Places book = rectangle({at, ground - length}, {at + thick, ground});
      canvas.fill(turned(book, {at, ground}, i + 2 >= count ? random.uniform(-.4, 0) : 0), paint);
      at += thick;
    }
  }
}

/// A dropped cloth: a smooth hump with folds that run down from its top.
void draw_cloth(Canvas& canvas, Random& random) {
  const double ground = indoors(canvas, random);
  const double middle = random.uniform(.4, .6);
  const double high = random.uniform(.12, .3);
  const double wide = high * random.uniform(.9, 1.8);
  const double power = random.uniform(1.2, 2.4);
  const auto top_at = [&](double u) {
    const double hump = std::exp(-std::pow(std::abs(u), power));
    return ground - high * hump * (1 + .04 * std::sin(9 * u) + .02 * std::sin(23 * u));
  };
  Places outline;
  for (double u = -2.2; u <= 2.2; u += .02) outline.push_back({middle + u * wide, top_at(u)});
  outline.push_back({middle + 2.2 * wide, ground + .01});
  outline.push_back({middle - 2.2 * wide, ground + .01});
  Paint paint = smooth_paint(random);
  if (random.chance(.6)) paint.pattern = random.chance(.5) ? Pattern::fabric : Pattern::stripes;
  paint.pattern_scale = random.uniform(.002, .01);
  canvas.fill(outline, paint);
  const int folds = random.integer(4, 12);
  for (int i = 0; i < folds; ++i) {
    const double u = random.uniform(-1.3, 1.3);
    const Place from(middle + .3 * u * wide, top_at(.3 * u) + .02);
    const Place to(middle + u * wide, ground - .05 * high);
    const Places fold = {from, (from + to) / 2 + Place(0, .03 * high), to, to + Place(.02, 0)};
    if (to.y > from.y) canvas.darken(rounded(fold, 3), random.uniform(.15, .5), .004);
  }
}

}  // namespace repose::testing
