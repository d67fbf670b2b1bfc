#include "dem/experiment/filling_height.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace repose::dem {
namespace {

/// Plumb lines from one side of the tube to the other.
constexpr int kLines = 200;

/// The highest point on each line of a square around the tube.
class Surface {
 public:
  explicit Surface(double diameter_m)
      : spacing_m_(diameter_m / kLines), heights_m_(std::size_t{kLines} * kLines, 0.0) {}

  void raise(const ClumpSphere& sphere) {
    for (int row = first(sphere, sphere.centre.y()); row <= last(sphere, sphere.centre.y());
         ++row) {
      for (int column = first(sphere, sphere.centre.x()); column <= last(sphere, sphere.centre.x());
           ++column) {
        const double off_x = place_m(column) - sphere.centre.x();
        const double off_y = place_m(row) - sphere.centre.y();
        const double rest = sphere.radius * sphere.radius - off_x * off_x - off_y * off_y;
        if (rest < 0) continue;
        double& height_m = heights_m_[at(row, column)];
        height_m = std::max(height_m, sphere.centre.z() + std::sqrt(rest));
      }
    }
  }

  double mean_m() const {
    const double radius_m = spacing_m_ * kLines / 2;
    double sum = 0;
    int lines = 0;
    for (int row = 0; row < kLines; ++row) {
      for (int column = 0; column < kLines; ++column) {
        if (std::hypot(place_m(row), place_m(column)) > radius_m) continue;
        sum += heights_m_[at(row, column)];
        ++lines;
      }
    }
    return sum / lines;
  }

 private:
  static std::size_t at(int row, int column) {
    return static_cast<std::size_t>(row) * kLines + static_cast<std::size_t>(column);
  }

  double place_m(int line) const { return (line + .5 - kLines / 2.) * spacing_m_; }

  double line_at(double place_m) const { return place_m / spacing_m_ + kLines / 2. - .5; }

  int first(const ClumpSphere& sphere, double centre_m) const {
    return std::max(0, static_cast<int>(std::ceil(line_at(centre_m - sphere.radius))));
  }

  int last(const ClumpSphere& sphere, double centre_m) const {
    return std::min(kLines - 1, static_cast<int>(std::floor(line_at(centre_m + sphere.radius))));
  }

  double spacing_m_;
  std::vector<double> heights_m_;
};

}  // namespace

double filling_height_m(std::span<const ClumpSphere> spheres, double tube_diameter_m) {
  Surface surface(tube_diameter_m);
  for (const ClumpSphere& sphere : spheres) surface.raise(sphere);
  return surface.mean_m();
}

}  // namespace repose::dem
