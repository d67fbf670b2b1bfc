#include "render/photo/tone_mapping.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "render/scene/counter_random.h"

namespace repose::render {

namespace {

double linear_of(double value) {
  return value <= .04045 ? value / 12.92 : std::pow((value + .055) / 1.055, 2.4);
}

double screen_of(double light) {
  return light <= .0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - .055;
}

/// Linear up to the knee, then compressed so that 1 is never quite reached: highlights keep their
/// colour.
double shouldered(double light) {
  constexpr double kKnee = .8;
  if (light <= kKnee) return light;
  const double over = (light - kKnee) / (1 - kKnee);
  return kKnee + (1 - kKnee) * over / (1 + over);
}

/// Light to bytes, by a table finer than a byte's steps.
class ToneCurve {
 public:
  ToneCurve() {
    for (std::size_t k = 0; k < table_.size(); ++k) {
      const double light = kBrightest * static_cast<double>(k) / (kSteps - 1);
      table_[k] = static_cast<std::uint8_t>(std::lround(255 * screen_of(shouldered(light))));
    }
  }
  std::uint8_t operator()(double light) const {
    const double at = std::clamp(light / kBrightest, 0.0, 1.0) * (kSteps - 1);
    return table_[static_cast<std::size_t>(std::lround(at))];
  }

 private:
  static constexpr int kSteps = 65536;
  static constexpr double kBrightest = 4;
  std::array<std::uint8_t, kSteps> table_{};
};

/// Half of a normalised Gaussian, centre first.
std::vector<float> kernel(double sd_px) {
  const int reach = std::max(1, static_cast<int>(std::ceil(3 * sd_px)));
  std::vector<double> weights;
  double sum = 0;
  for (int k = 0; k <= reach; ++k) {
    weights.push_back(std::exp(-.5 * k * k / (sd_px * sd_px)));
    sum += (k == 0 ? 1 : 2) * weights.back();
  }
  std::vector<float> normalised;
  for (const double weight : weights) normalised.push_back(static_cast<float>(weight / sum));
  return normalised;
}

/// Blurs in one direction: `count` lines, `line_step` pixels apart, of `length` pixels, `step`
/// apart.
void blur_lines(std::vector<float>& rgb, const std::vector<float>& weights, std::ptrdiff_t count,
                std::ptrdiff_t line_step, std::ptrdiff_t length, std::ptrdiff_t step) {
  const auto reach = static_cast<std::ptrdiff_t>(weights.size()) - 1;
  std::vector<float> line(static_cast<std::size_t>(3 * (length + 2 * reach)));
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    float* first = rgb.data() + 3 * i * line_step;
    for (std::ptrdiff_t k = -reach; k < length + reach; ++k) {
      const float* from = first + 3 * step * std::clamp<std::ptrdiff_t>(k, 0, length - 1);
      std::copy(from, from + 3, line.data() + 3 * (k + reach));
    }
    for (std::ptrdiff_t k = 0; k < length; ++k) {
      for (std::ptrdiff_t c = 0; c < 3; ++c) {
        const float* middle = line.data() + 3 * (k + reach) + c;
        float sum = weights[0] * *middle;
        for (std::ptrdiff_t r = 1; r <= reach; ++r) {
          sum += weights[static_cast<std::size_t>(r)] * (middle[-3 * r] + middle[3 * r]);
        }
        first[3 * step * k + c] = sum;
      }
    }
  }
}

void blur(Light& light, double sd_px) {
  constexpr double kNone = .05;
  if (sd_px < kNone) return;
  const std::vector<float> weights = kernel(sd_px);
  blur_lines(light.rgb, weights, light.height, light.width, light.width, 1);
  blur_lines(light.rgb, weights, light.width, 1, light.height, light.width);
}

}  // namespace

Colour linear(const Colour& colour) {
  return {linear_of(colour[0]), linear_of(colour[1]), linear_of(colour[2])};
}

vision::Picture tone_mapped(const Light& light, const PhotoStyle& style) {
  static const ToneCurve curve;
  Light sharp = light;
  blur(sharp, style.blur_px);
  vision::Picture picture{.width = light.width, .height = light.height, .bgr = {}};
  picture.bgr.resize(sharp.rgb.size());
  const double half_width = .5 * light.width, half_height = .5 * light.height;
  const double corner2 = half_width * half_width + half_height * half_height;
  const std::uint64_t start = mixed(style.seed + (style.frame << 32));
  std::size_t at = 0;
  for (int y = 0; y < light.height; ++y) {
    for (int x = 0; x < light.width; ++x) {
      const double dx = x + .5 - half_width, dy = y + .5 - half_height;
      const double fall = 1 - style.vignette * (dx * dx + dy * dy) / corner2;
      for (std::size_t c = 0; c < 3; ++c) {
        const double value = std::max(0.0, fall * static_cast<double>(sharp.rgb[at + c]));
        // Shot noise: variance grows with the light; some remains in the dark.
        constexpr double kDark = .02;
        const double sd = style.noise * std::sqrt(value + kDark);
        const double noisy = value + sd * nearly_normal(mixed(start + at + c));
        picture.bgr[at + 2 - c] = curve(noisy);
      }
      at += 3;
    }
  }
  return picture;
}

}  // namespace repose::render
