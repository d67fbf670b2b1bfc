#include "tests/support/heap_palette.h"

#include <algorithm>
#include <cmath>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/support/heap_paint.h"

namespace repose::testing {
namespace {

struct Kind {
  Color color;
  double gloss = 0;
  double elongation = 1;
};

constexpr std::array<Kind, 9> kGrains = {{
    {{0.55, 0.36, 0.19}, 0.10, 1.5},  // brown seed
    {{0.80, 0.68, 0.50}, 0.08, 1.6},  // wheat
    {{0.45, 0.52, 0.24}, 0.15, 1.3},  // mung bean
    {{0.15, 0.14, 0.13}, 0.25, 1.2},  // black bead
    {{0.93, 0.92, 0.88}, 0.30, 1.1},  // white bead
    {{0.52, 0.22, 0.16}, 0.20, 1.5},  // red bean
    {{0.48, 0.47, 0.45}, 0.04, 1.5},  // gravel
    {{0.88, 0.67, 0.25}, 0.15, 1.4},  // maize
    {{0.70, 0.58, 0.42}, 0.03, 1.3},  // sand
}};

constexpr std::array<Color, 9> kBackdrops = {{
    {0.74, 0.75, 0.76},
    {0.91, 0.91, 0.90},
    {0.22, 0.38, 0.62},
    {0.25, 0.50, 0.33},
    {0.09, 0.09, 0.10},
    {0.46, 0.47, 0.49},
    {0.84, 0.80, 0.72},
    {0.13, 0.18, 0.33},
    {0.55, 0.66, 0.75},
}};

constexpr std::array<Color, 7> kPlates = {{
    {0.65, 0.66, 0.68},  // steel
    {0.62, 0.45, 0.28},  // wood
    {0.88, 0.88, 0.86},  // white board
    {0.14, 0.14, 0.15},  // black rubber
    {0.34, 0.34, 0.36},
    {0.78, 0.82, 0.84},  // acrylic
    {0.30, 0.36, 0.42},
}};

constexpr std::array<Color, 4> kTables = {{
    {0.20, 0.20, 0.21},
    {0.55, 0.42, 0.28},
    {0.70, 0.70, 0.70},
    {0.36, 0.30, 0.26},
}};

/// A shaded grain reflects this fraction of its colour's light, on average.
constexpr float kShadedPart = 0.55F;

cv::Vec3f lab_of(const Color& color, float part) {
  cv::Vec3f light = light_of(color) * part;
  for (int c = 0; c < 3; ++c) light[c] = std::pow(light[c], 1 / 2.2F);
  const cv::Mat3f pixel(1, 1, light);
  cv::Mat3f lab;
  cv::cvtColor(pixel, lab, cv::COLOR_BGR2Lab);
  return lab(0, 0);
}

Color varied(const Color& color, Random& random) {
  const double light = random.uniform(0.9, 1.08);
  const auto channel = [&](double value) {
    return std::clamp(value * light * random.uniform(0.96, 1.04), 0.03, 0.96);
  };
  Color result;
  result.r = channel(color.r);
  result.g = channel(color.g);
  result.b = channel(color.b);
  return result;
}

}  // namespace

double contrast(const Color& grain, const Color& flat) {
  return cv::norm(lab_of(grain, kShadedPart) - lab_of(flat, 1));
}

void choose_colors(HeapScene& scene, double least_contrast, double most_contrast, Random& random) {
  constexpr int kTrials = 500;
  for (int i = 0; i < kTrials; ++i) {
    const Kind& kind = random.pick(kGrains);
    scene.grain.color = varied(kind.color, random);
    scene.grain.gloss = kind.gloss;
    scene.grain.elongation = kind.elongation;
    scene.around.backdrop = varied(random.pick(kBackdrops), random);
    scene.around.plate = varied(random.pick(kPlates), random);
    scene.around.table = varied(random.pick(kTables), random);
    const double against_backdrop = contrast(scene.grain.color, scene.around.backdrop);
    const double against_plate = contrast(scene.grain.color, scene.around.plate);
    if (against_backdrop >= least_contrast && against_backdrop <= most_contrast &&
        against_plate >= least_contrast / 2) {
      return;
    }
  }
}

}  // namespace repose::testing
