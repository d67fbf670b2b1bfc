#include <algorithm>
#include <cmath>

#include "tests/support/other_kinds.h"
#include "tests/support/other_sites.h"

namespace repose::testing {
namespace {

/// A truncated cone, sometimes as squat as a hat; bands of another colour on its body.
void cone(Canvas& canvas, bool has_bands, Random& random) {
  const double ground = random.chance(.6) ? outdoors(canvas, random) : indoors(canvas, random);
  const double half = random.uniform(.1, .32);
  const double rise = std::min(half * std::tan(random.uniform(.45, 1.3)), .8 * ground);
  const double middle = random.uniform(.4, .6);
  const double tip = random.uniform(.02, .2);
  const auto edge = [&](double u, double side) {
    return Place(middle + side * half * (1 - u * (1 - tip)), ground - u * rise);
  };
  const auto band = [&](double from, double to) {
    return Places{edge(from, -1), edge(to, -1), edge(to, 1), edge(from, 1)};
  };
  Paint paint = smooth_paint(random);
  if (random.chance(.5)) paint.color = {.92, random.uniform(.3, .45), .1};
  paint.shading = Shading::cylinder;
  paint.contrast = random.uniform(.2, .6);
  ground_shadow(canvas, middle - half, middle + half, ground, random);
  canvas.fill(band(0, 1), paint);
  if (random.chance(.4)) {
    canvas.fill(
        rectangle({middle - 1.25 * half, ground - .03 * half}, {middle + 1.25 * half, ground}),
        paint);
  }
  if (!has_bands) return;
  Paint other = paint;
  other.color = random.chance(.6) ? Color{.93, .93, .92} : any_color(random);
  const int bands = random.integer(1, 4);
  for (int i = 0; i < bands; ++i) {
    canvas.fill(band((i + .4) / (bands + .3), (i + .85) / (bands + .3)), other);
  }
}

void bottle(Canvas& canvas, double middle, double ground, double high, Random& random) {
  const double half = high * random.uniform(.12, .2);
  const double neck = half * random.uniform(.3, .5);
  const double shoulder = ground - high * random.uniform(.55, .7);
  const Place top(middle, ground - high);
  const Places outline = {
      {middle - half, ground},   {middle - half, shoulder}, {middle - neck, shoulder - .15 * high},
      {middle - neck, top.y},    {middle + neck, top.y},    {middle + neck, shoulder - .15 * high},
      {middle + half, shoulder}, {middle + half, ground}};
  canvas.fill(outline, {.color = any_color(random),
                        .shading = Shading::cylinder,
                        .contrast = random.uniform(.3, .6),
                        .opacity = random.uniform(.6, 1)});
  canvas.fill(
      rectangle({middle - half, shoulder + .1 * high}, {middle + half, shoulder + .3 * high}),
      smooth_paint(random));
}

/// Wider at the top than at the bottom, or the other way round.
void cup(Canvas& canvas, double middle, double ground, double high, Random& random) {
  const double below = high * random.uniform(.3, .8);
  const double above = high * random.uniform(.3, .8);
  canvas.fill({{middle - below, ground},
               {middle - above, ground - high},
               {middle + above, ground - high},
               {middle + below, ground}},
              {.color = any_color(random), .shading = Shading::cylinder, .contrast = .45});
  canvas.fill(ellipse({middle, ground - high}, above, .15 * above), smooth_paint(random));
}

}  // namespace

void draw_cone(Canvas& canvas, Random& random) { cone(canvas, false, random); }

void draw_striped_cone(Canvas& canvas, Random& random) { cone(canvas, true, random); }

void draw_bottles(Canvas& canvas, Random& random) {
  const double ground = indoors(canvas, random);
  const int count = random.integer(1, 4);
  for (int i = 0; i < count; ++i) {
    const double middle = (i + random.uniform(.4, .6)) / count;
    const double high = random.uniform(.2, .75 * ground);
    ground_shadow(canvas, middle - .2 * high, middle + .2 * high, ground, random);
    if (random.chance(.6)) {
      bottle(canvas, middle, ground, high, random);
    } else {
      cup(canvas, middle, ground, std::min(high, .5 / count), random);
    }
  }
}

/// Round and oval ones, and halves like upturned bowls.
void draw_balls(Canvas& canvas, Random& random) {
  const double ground = indoors(canvas, random);
  const int count = random.integer(1, 3);
  for (int i = 0; i < count; ++i) {
    const double half = random.uniform(.1, .28) / (count > 1 ? 1.6 : 1);
    const double high = std::min(half * random.uniform(.4, 1.2), .4 * ground);
    const double middle = (i + .5) / count;
    Paint paint = any_paint(random);
    paint.shading = Shading::ball;
    paint.contrast = random.uniform(.2, .6);
    ground_shadow(canvas, middle - half, middle + half, ground, random);
    Places outline = ellipse({middle, ground - high}, half, high);
    if (random.chance(.4)) {
      outline = moved(outline, {0, high});
      for (Place& p : outline) p.y = std::min(p.y, ground);
    }
    canvas.fill(outline, paint);
  }
}

void draw_car(Canvas& canvas, Random& random) {
  const double ground = outdoors(canvas, random);
  const double size = random.uniform(.5, .8);
  const double left = random.uniform(.05, .95 - size);
  const auto at = [&](double x, double y) { return Place(left + x * size, ground - y * size); };
  const double roof = random.uniform(.26, .36);
  const Places body = {at(0, .06),
                       at(.02, .17),
                       at(.2, .21),
                       at(random.uniform(.28, .4), roof),
                       at(random.uniform(.6, .75), roof),
                       at(.88, .21),
                       at(.98, .17),
                       at(1, .06)};
  ground_shadow(canvas, left, left + size, ground, random);
  canvas.fill(random.chance(.7) ? rounded(body, 2) : body, smooth_paint(random));
  canvas.fill({at(.27, .21), at(.4, .9 * roof), at(.6, .9 * roof), at(.78, .21)},
              {.color = {.15, .18, .22}, .contrast = .6});
  for (const double x : {.2, .8}) {
    canvas.fill(ellipse(at(x, .075), .075 * size, .075 * size), {.color = {.07, .07, .07}});
    canvas.fill(ellipse(at(x, .075), .04 * size, .04 * size), {.color = {.6, .6, .62}});
  }
}

}  // namespace repose::testing
