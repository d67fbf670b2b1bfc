#include "tests/support/heap_grains.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace repose::testing {
namespace {

using vision::Point;

/// Mean distance between neighbours in the outline / grain diameter, for a smooth heap, and the
/// addition for a rough one. A heap is many grains deep, so its outline shows more grains than fit
/// side by side.
constexpr double kSmoothSpacing = 0.2;
constexpr double kRoughSpacing = 0.2;
constexpr double kDeepestOutline = 0.45;  ///< below the profile of a rough heap / grain diameter
constexpr double kDeeperPart = 0.6;       ///< fraction of the outline's grains that lie deeper
constexpr double kInnerSpacing = 0.66;    ///< of rows inside / grain diameter
constexpr double kApronSpacing = 0.8;

Grain random_grain(const GrainLook& look, double diameter_px, Random& random) {
  Grain grain;
  const double radius =
      diameter_px / 2 * random.uniform(1 - look.size_spread, 1 + look.size_spread);
  const double stretch = std::sqrt(random.uniform(1, look.elongation));
  grain.long_axis = radius * stretch;
  grain.short_axis = radius / stretch;
  grain.turn_rad = random.uniform(0, std::numbers::pi);
  const double light = std::max(0.35, random.normal(1, look.brightness_spread));
  const auto channel = [&](double value) {
    return std::clamp(value * light * (1 + random.normal(0, look.hue_spread)), 0.01, 1.0);
  };
  grain.color.r = channel(look.color.r);
  grain.color.g = channel(look.color.g);
  grain.color.b = channel(look.color.b);
  return grain;
}

/// Outline: grains tangent to the profile, some deeper if the heap is rough.
void add_outline(const HeapScene& scene, const HeapProfile& profile, Random& random,
                 std::vector<Grain>& grains) {
  const auto& curve = profile.curve();
  const double diameter = profile.grain_px();
  const double spacing = diameter * (kSmoothSpacing + kRoughSpacing * scene.form.roughness);
  const double deepest = diameter * kDeepestOutline * scene.form.roughness;
  double until_next = 0;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    const double dx = curve[i].x - curve[i - 1].x;
    const double dy = curve[i].y - curve[i - 1].y;
    const double step = std::hypot(dx, dy);
    until_next -= step;
    if (until_next > 0 || step == 0) continue;
    until_next = spacing * random.uniform(0.5, 1.5);

    Grain grain = random_grain(scene.grain, diameter, random);
    const Point normal = {-dy / step, dx / step};
    double depth = grain.support(normal);
    if (random.chance(kDeeperPart)) depth += random.uniform(0, deepest);
    grain.center = {curve[i].x - depth * normal.x, curve[i].y - depth * normal.y};
    const double lowest = (1 - scene.form.toe_sink) * grain.support({0, 1});
    if (grain.center.y < lowest) continue;
    grain.order = grain.center.y + 2 * diameter;
    grains.push_back(grain);
  }
}

bool lies_inside(const Grain& grain, const HeapProfile& profile) {
  constexpr int kDirections = 8;
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2 * std::numbers::pi * i / kDirections;
    const double x = grain.center.x + grain.long_axis * std::cos(angle);
    const double y = grain.center.y + grain.long_axis * std::sin(angle);
    if (profile.height_at(x) < y + 0.08 * grain.long_axis) return false;
  }
  return true;
}

/// Rows of grains from the ground to the outline; lower ones are nearer to the camera.
void add_inside(const HeapScene& scene, const HeapProfile& profile, Random& random,
                std::vector<Grain>& grains) {
  if (profile.curve().empty()) return;
  const double spacing = kInnerSpacing * profile.grain_px();
  const double from = profile.curve().front().x;
  const double to = profile.curve().back().x;
  int row = 0;
  for (double y = 0.5 * profile.grain_px(); y < profile.height_px(); y += 0.8 * spacing, ++row) {
    for (double x = from + (row % 2) * spacing / 2; x < to; x += spacing) {
      Grain grain = random_grain(scene.grain, profile.grain_px(), random);
      grain.center = {x + random.uniform(-0.4, 0.4) * spacing,
                      std::max(y + random.uniform(-0.4, 0.4) * spacing, grain.support({0, 1}))};
      if (!lies_inside(grain, profile)) continue;
      grain.order = grain.center.y;
      grains.push_back(grain);
    }
  }
}

Grain grain_on_ground(const HeapScene& scene, const HeapProfile& profile, double x,
                      Random& random) {
  Grain grain = random_grain(scene.grain, profile.grain_px(), random);
  grain.turn_rad = random.uniform(-0.25, 0.25);  // an elongated grain lies flat
  grain.center = {x, grain.support({0, 1})};
  grain.order = -random.uniform(0, 1);
  return grain;
}

/// One to two grains thick, thinning out away from the toe.
void add_apron(const HeapScene& scene, const HeapProfile& profile, Random& random,
               std::vector<Grain>& grains) {
  const double diameter = profile.grain_px();
  const double half_base = (profile.right_toe_x() - profile.left_toe_x()) / 2;
  for (const double out : {-1.0, 1.0}) {
    const double toe =
        (out < 0 ? profile.left_toe_x() : profile.right_toe_x()) - out * 4 * diameter;
    const double length = scene.form.apron * half_base * random.uniform(0.85, 1.15) + 4 * diameter;
    for (double t = 0; t < length; t += kApronSpacing * diameter * random.uniform(0.4, 1.2)) {
      Grain grain = grain_on_ground(scene, profile, toe + out * t, random);
      grains.push_back(grain);
      if (!random.chance(0.75 * (1 - t / length))) continue;
      grain = grain_on_ground(scene, profile, toe + out * (t + diameter / 2), random);
      grain.center.y += diameter * random.uniform(0.6, 0.8);
      grain.order = grain.center.y;
      grains.push_back(grain);
    }
  }
}

/// A cone's surface seen from above, and its round base.
void add_oblique(const HeapScene& scene, const HeapProfile& profile, Random& random,
                 std::vector<Grain>& grains) {
  const double radius = (profile.right_toe_x() - profile.left_toe_x()) / 2;
  const double middle = (profile.right_toe_x() + profile.left_toe_x()) / 2;
  const double diameter = profile.grain_px();
  const int count = static_cast<int>(20 * radius * radius / (diameter * diameter));
  const double sine = std::sin(scene.form.elevation_rad);
  const double cosine = std::cos(scene.form.elevation_rad);
  for (int i = 0; i < count; ++i) {
    const double r = radius * std::sqrt(random.uniform(0, 1));
    const double azimuth = random.uniform(0, 2 * std::numbers::pi);
    const double towards = r * std::sin(azimuth);
    const double rounded = std::hypot(r, 0.1 * radius) - 0.1 * radius;
    const double height = (radius - rounded) * std::tan(scene.form.left_rad);
    Grain grain = random_grain(scene.grain, diameter, random);
    grain.center = {middle + r * std::cos(azimuth), height * cosine - towards * sine};
    grain.order = -towards;
    grains.push_back(grain);
  }
}

/// Rests on the ground, as wide as the base.
void add_ball(const HeapScene& scene, const HeapProfile& profile, Random& random,
              std::vector<Grain>& grains) {
  Grain ball = random_grain(scene.grain, 1, random);
  ball.long_axis = ball.short_axis = (profile.right_toe_x() - profile.left_toe_x()) / 2;
  ball.center = {(profile.right_toe_x() + profile.left_toe_x()) / 2, ball.long_axis};
  grains.push_back(ball);
}

}  // namespace

double Grain::support(Point normal) const {
  const double along = normal.x * std::cos(turn_rad) + normal.y * std::sin(turn_rad);
  const double across = normal.y * std::cos(turn_rad) - normal.x * std::sin(turn_rad);
  return std::hypot(long_axis * along, short_axis * across);
}

double Grain::top_at(double x) const {
  const double dx = x - center.x;
  const double half_width = support({1, 0});
  if (std::abs(dx) >= half_width) return 0;
  const double square = half_width * half_width;
  const double shear =
      (long_axis * long_axis - short_axis * short_axis) * std::sin(turn_rad) * std::cos(turn_rad);
  return center.y + (shear * dx + long_axis * short_axis * std::sqrt(square - dx * dx)) / square;
}

std::vector<Grain> heap_grains(const HeapScene& scene, const HeapProfile& profile,
                               double stage_width_px, Random& random) {
  std::vector<Grain> grains;
  if (scene.form.shape == Shape::ball) add_ball(scene, profile, random, grains);
  if (scene.form.shape == Shape::oblique) add_oblique(scene, profile, random, grains);
  add_outline(scene, profile, random, grains);
  add_inside(scene, profile, random, grains);
  if (scene.form.apron > 0) add_apron(scene, profile, random, grains);
  std::erase_if(grains, [&](const Grain& grain) {
    return grain.center.x < -grain.long_axis || grain.center.x > stage_width_px + grain.long_axis;
  });
  std::stable_sort(grains.begin(), grains.end(),
                   [](const Grain& a, const Grain& b) { return a.order > b.order; });
  return grains;
}

std::vector<Grain> stray_grains(const HeapScene& scene, const HeapProfile& profile,
                                double stage_width_px, Random& random) {
  std::vector<Grain> grains;
  const double diameter = profile.grain_px();
  for (int i = 0; i < scene.form.strays; ++i) {
    const bool left = random.chance(0.5);
    const double room = left ? profile.left_toe_x() : stage_width_px - profile.right_toe_x();
    // Squared: most strays lie near the toe.
    const double t = random.uniform(0, 1);
    const double distance = diameter * 0.6 + t * t * std::max(room - diameter, 0.0);
    const double x = left ? profile.left_toe_x() - distance : profile.right_toe_x() + distance;
    grains.push_back(grain_on_ground(scene, profile, x, random));
  }
  return grains;
}

std::vector<Point> envelope(const std::vector<Grain>& grains) {
  if (grains.empty()) return {};
  constexpr double kStep = 0.5;
  double first = std::numeric_limits<double>::max();
  double last = std::numeric_limits<double>::lowest();
  for (const Grain& grain : grains) {
    first = std::min(first, grain.center.x - grain.support({1, 0}));
    last = std::max(last, grain.center.x + grain.support({1, 0}));
  }
  first = std::ceil(first / kStep) * kStep;
  std::vector<Point> points;
  for (double x = first; x <= last; x += kStep) points.push_back({x, 0});
  for (const Grain& grain : grains) {
    const double half_width = grain.support({1, 0});
    const double from = std::max((grain.center.x - half_width - first) / kStep, 0.0);
    const double to = (grain.center.x + half_width - first) / kStep;
    for (auto i = static_cast<std::size_t>(std::ceil(from)); i < points.size(); ++i) {
      if (static_cast<double>(i) > to) break;
      points[i].y = std::max(points[i].y, grain.top_at(points[i].x));
    }
  }
  return points;
}

}  // namespace repose::testing
