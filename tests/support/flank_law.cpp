#include "tests/support/flank_law.h"

#include <cmath>
#include <vector>

#include "tests/support/edge_angle.h"

namespace repose::testing {
namespace {

std::vector<EdgePoint> edge_of(const FlankLaw& law, double chord_slope) {
  constexpr int kPoints = 500;
  std::vector<EdgePoint> edge;
  for (int i = 0; i <= kPoints; ++i) {
    const double out = static_cast<double>(i) / kPoints;
    edge.push_back({.out = out, .height = chord_slope * law.height(out)});
  }
  return edge;
}

}  // namespace

FlankLaw::FlankLaw(Flanks flanks, double hollow)
    : is_power_(flanks != Flanks::exponential), hollow_(flanks == Flanks::straight ? 1 : hollow) {}

double FlankLaw::height(double out) const {
  if (is_power_) return std::pow(1 - out, hollow_);
  return (std::exp(-hollow_ * out) - std::exp(-hollow_)) / (1 - std::exp(-hollow_));
}

double FlankLaw::out_at(double height) const {
  if (is_power_) return 1 - std::pow(height, 1 / hollow_);
  return -std::log(height * (1 - std::exp(-hollow_)) + std::exp(-hollow_)) / hollow_;
}

double FlankLaw::steepness(double height) const {
  const double out = out_at(height);
  if (is_power_) return hollow_ * std::pow(1 - out, hollow_ - 1);
  return hollow_ * std::exp(-hollow_ * out) / (1 - std::exp(-hollow_));
}

double hollow_of_bend(Flanks flanks, double chord_slope, double bend_rad) {
  const bool is_power = flanks != Flanks::exponential;
  double low = is_power ? 1 : 1e-3;  // straight
  double high = is_power ? 4 : 6;    // more concave than any heap
  constexpr int kHalvings = 30;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2;
    const auto edge = edge_of(FlankLaw(flanks, middle), chord_slope);
    (angle_of_edge(edge, chord_slope).bend_rad < bend_rad ? low : high) = middle;
  }
  return low;
}

}  // namespace repose::testing
