#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <opencv2/imgproc.hpp>

#include "tests/support/other_kinds.h"
#include "tests/support/other_sites.h"

namespace repose::testing {
namespace {

void plain_sheet(Canvas& canvas, Random& random) {
  canvas.fill(rectangle({-.1, -.1}, {1.1, canvas.height() + .1}), smooth_paint(random));
}

Places triangle(Place middle, double half, double high) {
  return {middle + Place(-half, high / 2), middle + Place(0, -high / 2),
          middle + Place(half, high / 2)};
}

}  // namespace

/// On a post or on a sheet.
void draw_warning_sign(Canvas& canvas, Random& random) {
  const bool is_outdoors = random.chance(.6);
  const double ground = is_outdoors ? outdoors(canvas, random) : canvas.height();
  if (!is_outdoors) plain_sheet(canvas, random);
  const double half = random.uniform(.12, .3);
  const double high = half * random.uniform(1.2, 1.8);
  const Place middle(random.uniform(.35, .65), ground * .45);
  if (is_outdoors) {
    canvas.fill(rectangle({middle.x - .008, middle.y}, {middle.x + .008, ground}),
                {.color = {.5, .5, .52}, .shading = Shading::cylinder, .contrast = .5});
  }
  const bool is_yellow = random.chance(.5);
  const Color border = is_yellow ? Color{.08, .08, .08} : Color{.75, .08, .1};
  const Color inside = is_yellow ? Color{.95, .78, .1} : Color{.95, .95, .93};
  canvas.fill(rounded(triangle(middle, half, high), random.integer(0, 1)), {.color = border});
  canvas.fill(triangle(middle + Place(0, .06 * high), .62 * half, .6 * high), {.color = inside});
  canvas.fill(
      rectangle(middle + Place(-.04 * half, -.1 * high), middle + Place(.04 * half, .18 * high)),
      {.color = {.06, .06, .06}});
  canvas.fill(ellipse(middle + Place(0, .28 * high), .06 * half, .06 * half),
              {.color = {.06, .06, .06}});
}

/// Large, many with sloping strokes.
void draw_letters(Canvas& canvas, Random& random) {
  if (random.chance(.5)) {
    plain_sheet(canvas, random);
  } else {
    indoors(canvas, random);
  }
  static const std::array<std::string, 12> kWords = {"A",  "AV", "M",  "W",    "VIA", "AHA",
                                                     "NO", "Z7", "XK", "STOP", "R2",  "LAVA"};
  const std::string word = random.pick(kWords);
  const double size = std::min(.8 * canvas.height(), 1.1 / static_cast<double>(word.size() + 1)) *
                      random.uniform(.6, 1);
  const int font = random.pick(std::array{static_cast<int>(cv::FONT_HERSHEY_SIMPLEX),
                                          static_cast<int>(cv::FONT_HERSHEY_DUPLEX),
                                          static_cast<int>(cv::FONT_HERSHEY_TRIPLEX)});
  const double y = canvas.height() * random.uniform(.6, .85);
  const Place at(random.uniform(.05, .2), y);
  canvas.write(word, at, size, font, {.color = any_color(random), .contrast = .1});
}

/// Flat shapes in a few colours, some standing on a line.
void draw_logo(Canvas& canvas, Random& random) {
  plain_sheet(canvas, random);
  const double base = canvas.height() * random.uniform(.6, .8);
  if (random.chance(.5)) {
    canvas.fill(rectangle({.1, base}, {.9, base + random.uniform(.01, .05)}),
                {.color = any_color(random), .contrast = 0});
  }
  const int count = random.integer(1, 3);
  for (int i = 0; i < count; ++i) {
    const double half = random.uniform(.1, .3) / (count > 1 ? 1.4 : 1);
    const double high = half * random.uniform(.5, 1.6);
    const double middle = (i + random.uniform(.4, .6)) / count;
    const double top = random.chance(.5) ? 0 : random.uniform(.2, .7) * half;
    Places shape = {{middle - half, base},
                    {middle - top, base - high},
                    {middle + top, base - high},
                    {middle + half, base}};
    if (random.chance(.2)) shape = rounded(shape, 2);
    canvas.fill(shape, {.color = any_color(random), .contrast = random.uniform(0, .2)});
  }
  canvas.write("REPUS", {.2, base + .12}, .05, cv::FONT_HERSHEY_DUPLEX,
               {.color = any_color(random)});
}

}  // namespace repose::testing
