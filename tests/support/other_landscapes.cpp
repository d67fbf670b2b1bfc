#include <algorithm>
#include <cmath>

#include "tests/support/other_kinds.h"
#include "tests/support/other_sites.h"

namespace repose::testing {
namespace {

/// Repeatedly halves every edge and moves its middle up or down.
Places rugged(Places ridge, double roughness, Random& random) {
  for (int round = 0; round < 6; ++round) {
    Places finer = {ridge.front()};
    for (std::size_t i = 1; i < ridge.size(); ++i) {
      const double length = cv::norm(ridge[i] - ridge[i - 1]);
      const double aside = roughness * length * random.uniform(-1, 1);
      finer.push_back((ridge[i] + ridge[i - 1]) / 2 + Place(0, aside));
      finer.push_back(ridge[i]);
    }
    ridge = std::move(finer);
  }
  return ridge;
}

void conifer(Canvas& canvas, Place foot, double high, const Paint& paint, Random& random) {
  const double half = high * random.uniform(.18, .35);
  canvas.fill(rectangle({foot.x - .04 * high, foot.y - .15 * high}, {foot.x + .04 * high, foot.y}),
              {.color = {.3, .2, .12}});
  const int tiers = random.integer(1, 4);
  for (int i = 0; i < tiers; ++i) {
    const double low = foot.y - high * (.1 + .6 * i / tiers);
    const double wide = half * (1 - .75 * i / tiers);
    const double top = low - high * .9 * (i + 1 == tiers ? 1 - .6 * i / tiers : .5);
    canvas.fill({{foot.x - wide, low}, {foot.x, top}, {foot.x + wide, low}}, paint);
  }
}

void leafy_tree(Canvas& canvas, Place foot, double high, const Paint& paint, Random& random) {
  canvas.fill(rectangle({foot.x - .03 * high, foot.y - .5 * high}, {foot.x + .03 * high, foot.y}),
              {.color = {.3, .22, .15}});
  const int puffs = random.integer(6, 14);
  for (int i = 0; i < puffs; ++i) {
    const double angle = random.uniform(0, 2 * CV_PI);
    const double out = high * random.uniform(0, .22);
    const double half_height = high * random.uniform(.1, .2);
    const double half_width = high * random.uniform(.1, .2);
    canvas.fill(
        ellipse({foot.x + out * std::cos(angle), foot.y - .7 * high + out * std::sin(angle)},
                half_width, half_height),
        paint);
  }
}

}  // namespace

/// Ridges one behind another, hazier with distance; sometimes one great peak.
void draw_mountains(Canvas& canvas, Random& random) {
  const double ground = outdoors(canvas, random);
  const int layers = random.integer(1, 4);
  const Color near = any_color(random);
  for (int i = layers; i > 0; --i) {
    Places ridge = {{-.1, ground - random.uniform(0, .1)}};
    const int peaks = i == 1 && random.chance(.5) ? 1 : random.integer(2, 4);
    for (int k = 0; k < peaks; ++k) {
      ridge.push_back({(k + random.uniform(.3, .7)) / peaks,
                       ground - random.uniform(.12, .3) * (.6 + .4 * i / layers)});
      ridge.push_back({(k + 1.) / peaks, ground - random.uniform(0, .08)});
    }
    ridge.push_back({1.1, ground});
    Places outline = rugged(ridge, random.uniform(.02, .15), random);
    outline.push_back({1.1, ground + .01});
    outline.push_back({-.1, ground + .01});
    const double haze = .75 * (i - 1) / layers;
    const Color color = {near.r + haze * (.75 - near.r), near.g + haze * (.82 - near.g),
                         near.b + haze * (.9 - near.b)};
    canvas.fill(outline, {.color = color,
                          .contrast = random.uniform(.05, .4),
                          .pattern = random.chance(.6) ? Pattern::noise : Pattern::plain,
                          .pattern_strength = random.uniform(.03, .2),
                          .pattern_scale = random.uniform(.002, .01)});
  }
}

void draw_trees(Canvas& canvas, Random& random) {
  const double ground = outdoors(canvas, random);
  const int count = random.integer(1, 6);
  for (int i = 0; i < count; ++i) {
    const double foot_y = ground + random.uniform(0, .03);
    const Place foot((i + random.uniform(.2, .8)) / count, foot_y);
    const Paint paint = {.color = {random.uniform(.1, .35), random.uniform(.25, .5), .15},
                         .contrast = random.uniform(.1, .5),
                         .pattern = Pattern::noise,
                         .pattern_strength = random.uniform(.1, .35),
                         .pattern_scale = random.uniform(.002, .006)};
    const double high = std::min(random.uniform(.2, .5), .85 * ground);
    if (random.chance(.5)) {
      conifer(canvas, foot, high, paint, random);
    } else {
      leafy_tree(canvas, foot, high, paint, random);
    }
  }
}

void draw_clouds(Canvas& canvas, Random& random) {
  const double ground = outdoors(canvas, random);
  const int clouds = random.integer(1, 5);
  for (int i = 0; i < clouds; ++i) {
    const double middle_y = ground * random.uniform(.2, .7);
    const Place middle(random.uniform(.15, .85), middle_y);
    const double size = random.uniform(.05, .16);
    const double grey = random.uniform(.75, .98);
    for (int k = 0; k < 12; ++k) {
      const double aside = size * random.uniform(-1.4, 1.4);
      const double radius = size * random.uniform(.25, .6) * (1 - .3 * std::abs(aside) / size);
      canvas.fill(ellipse(middle + Place(aside, -.5 * radius), radius, .8 * radius),
                  {.color = {grey, grey, grey}, .contrast = .3, .opacity = random.uniform(.4, .8)});
    }
  }
}

/// Runs to the horizon: a triangle that stands on the picture's lower edge.
void draw_road(Canvas& canvas, Random& random) {
  const double horizon = outdoors(canvas, random) - random.uniform(.1, .3);
  const double high = canvas.height();
  const Color field = any_color(random);
  canvas.fill(rectangle({-.1, horizon}, {1.1, high + .1}),
              {.color = field, .pattern = Pattern::noise, .pattern_scale = .003});
  const double vanish = random.uniform(.35, .65);
  const double half = random.uniform(.3, .6);
  canvas.fill({{vanish - half, high + .1}, {vanish, horizon}, {vanish + half, high + .1}},
              {.color = times({.4, .4, .41}, random.uniform(.6, 1.5)),
               .pattern = Pattern::noise,
               .pattern_strength = .06,
               .pattern_scale = .002});
  canvas.fill({{vanish - .02, high + .1}, {vanish, horizon}, {vanish + .02, high + .1}},
              {.color = {.92, .9, .8}});
}

}  // namespace repose::testing
