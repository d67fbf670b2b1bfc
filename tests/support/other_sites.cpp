#include "tests/support/other_sites.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace repose::testing {
namespace {

constexpr double kOutside = .1;  // a rolled picture shows this much beyond its sides

Places across(double top, double bottom) {
  return rectangle({-kOutside, top}, {1 + kOutside, bottom});
}

void clutter(Canvas& canvas, double ground, Random& random) {
  const int count = random.integer(2, 6);
  for (int i = 0; i < count; ++i) {
    Paint paint = any_paint(random);
    paint.opacity = random.uniform(.5, 1);
    const double left = random.uniform(-.05, .95);
    const double width = random.uniform(.04, .2);
    const double bottom = random.chance(.6) ? ground : ground * random.uniform(.3, .8);
    const double top = bottom - random.uniform(.05, .3);
    if (random.chance(.7)) {
      canvas.fill(rectangle({left, top}, {left + width, bottom}), paint);
    } else {
      canvas.fill(ellipse({left, (top + bottom) / 2}, width / 2, (bottom - top) / 2), paint);
    }
  }
}

/// A ridge of hills, partly transparent.
void hills(Canvas& canvas, double ground, const Color& color, Random& random) {
  Places ridge = {{-kOutside, ground}};
  const double phase = random.uniform(0, 6);
  const double high = random.uniform(.02, .08);
  for (double x = -kOutside; x <= 1 + kOutside; x += .01) {
    ridge.push_back({x, ground - high * (1.2 + std::sin(5 * x + phase) + .3 * std::sin(17 * x))});
  }
  ridge.push_back({1 + kOutside, ground});
  canvas.fill(ridge, {.color = color, .opacity = random.uniform(.4, .9)});
}

}  // namespace

Color times(const Color& color, double light) {
  return {std::clamp(color.r * light, .01, 1.), std::clamp(color.g * light, .01, 1.),
          std::clamp(color.b * light, .01, 1.)};
}

Color any_color(Random& random) {
  const double grey = random.uniform(.08, .92);
  const double saturation = random.chance(.6) ? random.uniform(0, .12) : random.uniform(.15, .6);
  const double hue = random.uniform(0, 2 * CV_PI);
  const auto channel = [&](double at) {
    return std::clamp(grey * (1 + saturation * std::cos(hue - at)), .02, .97);
  };
  return {channel(0), channel(2.1), channel(4.2)};
}

Paint smooth_paint(Random& random) {
  return {.color = any_color(random),
          .contrast = random.uniform(.02, .5),
          .towards_rad = random.uniform(0, 2 * CV_PI)};
}

Paint patterned_paint(Random& random) {
  Paint paint = smooth_paint(random);
  paint.pattern =
      random.pick(std::array{Pattern::noise, Pattern::fabric, Pattern::wood, Pattern::bricks,
                             Pattern::tiles, Pattern::stripes, Pattern::planks});
  const bool is_fine = paint.pattern == Pattern::noise || paint.pattern == Pattern::fabric ||
                       paint.pattern == Pattern::wood;
  paint.pattern_scale = is_fine ? random.uniform(.002, .008) : random.uniform(.01, .03);
  paint.pattern_strength = random.uniform(.1, .35);
  return paint;
}

Paint any_paint(Random& random) {
  return random.chance(.5) ? smooth_paint(random) : patterned_paint(random);
}

double indoors(Canvas& canvas, Random& random) {
  const double high = canvas.height();
  const double ground = high * random.uniform(.68, .86);
  Paint wall = random.chance(.65) ? smooth_paint(random) : patterned_paint(random);
  wall.contrast = std::min(wall.contrast, .25);
  canvas.fill(across(-kOutside, ground), wall);
  if (random.chance(.35)) clutter(canvas, ground, random);
  const Paint floor = any_paint(random);
  canvas.fill(across(ground, high + kOutside), floor);
  if (random.chance(.5)) {  // a board's front edge, and the area below it
    const double edge = ground + random.uniform(.02, .06);
    canvas.fill(across(edge, high + kOutside), smooth_paint(random));
  }
  return ground;
}

double outdoors(Canvas& canvas, Random& random) {
  const double high = canvas.height();
  const double ground = high * random.uniform(.68, .86);
  const Color sky = {random.uniform(.5, .85), random.uniform(.65, .9), random.uniform(.8, .97)};
  canvas.fill(across(-kOutside, ground),
              {.color = sky, .contrast = random.uniform(.05, .3), .towards_rad = -CV_PI / 2});
  const Color earth = random.pick(std::array<Color, 5>{
      {{.35, .45, .2}, {.5, .42, .3}, {.42, .42, .43}, {.7, .62, .48}, {.9, .91, .93}}});
  if (random.chance(.5)) hills(canvas, ground, times(earth, random.uniform(.8, 1.3)), random);
  canvas.fill(across(ground, high + kOutside), {.color = times(earth, random.uniform(.7, 1.2)),
                                                .pattern = Pattern::noise,
                                                .pattern_strength = random.uniform(.03, .2),
                                                .pattern_scale = random.uniform(.001, .004)});
  return ground;
}

void stand_box(Canvas& canvas, double left, double ground, double width, double height,
               const Paint& paint, Random& random) {
  const double back = random.uniform(.1, .4) * width * (random.chance(.5) ? 1 : -1);
  const double up = random.uniform(.05, .2) * width;
  const double top = ground - height;
  const double right = left + width;
  const double side = back > 0 ? right : left;
  Paint lid = paint;
  lid.color = times(paint.color, 1.2);
  Paint flank = paint;
  flank.color = times(paint.color, .7);
  canvas.fill({{left, top}, {right, top}, {right + back, top - up}, {left + back, top - up}}, lid);
  canvas.fill({{side, top}, {side + back, top - up}, {side + back, ground - up}, {side, ground}},
              flank);
  canvas.fill(rectangle({left, top}, {right, ground}), paint);
}

void ground_shadow(Canvas& canvas, double left, double right, double ground, Random& random) {
  const double width = right - left;
  const double aside = width * random.uniform(-.2, .2);
  canvas.darken(
      ellipse({(left + right) / 2 + aside, ground + .01 * width}, .55 * width, .03 * width),
      random.uniform(.2, .6), .02 * width);
}

}  // namespace repose::testing
