#include <cmath>

#include "tests/support/other_kinds.h"
#include "tests/support/other_sites.h"

namespace repose::testing {

/// Stands, or lies with its legs tucked under.
void draw_animal(Canvas& canvas, Random& random) {
  const double ground = random.chance(.6) ? outdoors(canvas, random) : indoors(canvas, random);
  const double size = random.uniform(.4, .7);
  const double facing = random.chance(.5) ? 1 : -1;
  const double legs = random.chance(.7) ? random.uniform(.15, .35) : 0;
  const auto at = [&](double x, double y) {
    return Place(.5 + facing * x * size, ground - y * size);
  };
  Paint fur = smooth_paint(random);
  if (random.chance(.5)) {
    fur.pattern = Pattern::noise;
    fur.pattern_scale = random.uniform(.001, .006);
  }
  ground_shadow(canvas, .5 - .4 * size, .5 + .4 * size, ground, random);
  if (legs > 0) {
    for (const double x : {-.3, -.22, .2, .28}) {
      canvas.fill(
          rounded({at(x - .04, 0), at(x - .05, legs + .1), at(x + .05, legs + .1), at(x + .04, 0)},
                  2),
          fur);
    }
  }
  const double back = legs + random.uniform(.25, .4);
  canvas.fill(rounded({at(-.42, legs), at(-.44, .9 * back), at(-.2, back), at(.1, .95 * back),
                       at(.34, back), at(.4, legs + .1), at(.3, legs - .02), at(-.2, legs)}),
              fur);
  const Place head = at(.46, back + random.uniform(-.05, .15));
  canvas.stroke({at(.33, .88 * back), head}, .11 * size, fur);
  canvas.fill(ellipse(head, .12 * size, .09 * size), fur);
  canvas.fill({head + Place(-.05, -.05) * size, head + Place(-.02, -.16) * size,
               head + Place(.02, -.07) * size},
              fur);
  canvas.stroke({at(-.43, .85 * back), at(-.55, .7 * back), at(-.58, .4 * back)}, .03 * size, fur);
}

/// A forearm from one side, and a hand with spread fingers.
void draw_hand(Canvas& canvas, Random& random) {
  indoors(canvas, random);
  const double high = canvas.height();
  const double tan = random.uniform(.5, 1.1);
  const Paint skin = {.color = {.75 * tan, .55 * tan, .43 * tan},
                      .shading = Shading::slope,
                      .contrast = random.uniform(.2, .6),
                      .towards_rad = random.uniform(0, 2 * CV_PI),
                      .pattern = Pattern::noise,
                      .pattern_strength = .03,
                      .pattern_scale = .003};
  const double wrist_y = high * random.uniform(.4, .65);
  const Place wrist(random.uniform(.4, .55), wrist_y);
  const double size = random.uniform(.16, .28);
  const double turn_rad = random.uniform(-.8, .8);
  const auto put = [&](const Places& part) { canvas.fill(turned(part, wrist, turn_rad), skin); };
  put(rounded({{-.4, wrist.y - .5 * size},
               {wrist.x, wrist.y - .28 * size},
               {wrist.x, wrist.y + .28 * size},
               {-.4, wrist.y + .6 * size}},
              1));
  put(rounded({{wrist.x - .1 * size, wrist.y - .3 * size},
               {wrist.x + .5 * size, wrist.y - .5 * size},
               {wrist.x + .7 * size, wrist.y},
               {wrist.x + .5 * size, wrist.y + .45 * size},
               {wrist.x - .1 * size, wrist.y + .3 * size}}));
  for (int i = 0; i < 5; ++i) {
    const double spread = (i - 2) * random.uniform(.12, .3);
    const Place root(wrist.x + .5 * size, wrist.y + (i - 2) * .17 * size);
    const Places finger = ellipse(root + Place(.35 * size, 0), .45 * size, .09 * size);
    put(turned(finger, root, spread));
  }
}

}  // namespace repose::testing
