#include "tests/bench/depth_scanner.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "tests/support/heap_random.h"

namespace repose::bench {
namespace {

using Vector = Eigen::Vector3d;
using testing::Random;

struct Ball {
  Vector centre;
  double radius = 0;
};

std::vector<Ball> balls_of(const render::Scene& scene) {
  std::vector<Ball> balls;
  for (const render::PlacedGrain& grain : scene.grains) {
    for (const dem::ClumpSphere& sphere :
         scene.shapes[static_cast<std::size_t>(grain.shape)].spheres) {
      balls.push_back(
          {grain.pose.position + grain.pose.orientation * sphere.centre, sphere.radius});
    }
  }
  return balls;
}

/// Radius within which 98 % of the spheres lie. Callers add the ground around it.
double reach_of(const std::vector<Ball>& balls) {
  std::vector<double> reaches;
  for (const Ball& ball : balls) reaches.push_back(ball.centre.head<2>().norm() + ball.radius);
  std::sort(reaches.begin(), reaches.end());
  return reaches[reaches.size() * 98 / 100];
}

/// A camera that looks at the heap's middle.
struct Stand {
  Vector eye;
  Eigen::Matrix3d axes;  ///< columns: right, down, forward
  double focal_px = 0;

  Stand(const Vector& from, double half_field, int width) : eye(from) {
    const Vector forward = -from.normalized();
    const Vector side =
        std::abs(forward.z()) > .99 ? Vector::UnitX() : Vector(Vector::UnitZ().cross(forward));
    axes.col(2) = forward;
    axes.col(0) = side.normalized();
    axes.col(1) = forward.cross(axes.col(0));
    focal_px = width / 2.0 * from.norm() / half_field;
  }
  Vector ray(double x, double y) const { return axes * Vector(x / focal_px, y / focal_px, 1); }
};

/// Where the ray first meets the ball, in lengths of the ray.
double meeting(const Vector& eye, const Vector& ray, const Ball& ball) {
  const Vector from = eye - ball.centre;
  const double a = ray.squaredNorm(), b = from.dot(ray);
  const double c = from.squaredNorm() - ball.radius * ball.radius;
  const double root = b * b - a * c;
  return root < 0 ? std::numeric_limits<double>::infinity() : (-b - std::sqrt(root)) / a;
}

/// Depth of each pixel along its ray; the ground is z = 0.
std::vector<double> depths(const Stand& stand, const std::vector<Ball>& balls,
                           const DepthScanner& scanner) {
  const auto pixels =
      static_cast<std::size_t>(scanner.width) * static_cast<std::size_t>(scanner.height);
  std::vector<double> depth(pixels, std::numeric_limits<double>::infinity());
  const double half_x = scanner.width / 2.0, half_y = scanner.height / 2.0;
  const auto at = [&](int x, int y) -> double& {
    return depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(scanner.width) +
                 static_cast<std::size_t>(x)];
  };
  for (int y = 0; y < scanner.height; ++y) {
    for (int x = 0; x < scanner.width; ++x) {
      const Vector ray = stand.ray(x + .5 - half_x, y + .5 - half_y);
      if (ray.z() < 0) at(x, y) = -stand.eye.z() / ray.z();
    }
  }
  for (const Ball& ball : balls) {
    const Vector seen = stand.axes.transpose() * (ball.centre - stand.eye);
    const double reach = 1.2 * stand.focal_px * ball.radius / seen.z() + 1;
    const double u = stand.focal_px * seen.x() / seen.z() + half_x;
    const double v = stand.focal_px * seen.y() / seen.z() + half_y;
    const int left = std::max(0, static_cast<int>(u - reach));
    const int right = std::min(scanner.width - 1, static_cast<int>(u + reach));
    const int bottom = std::min(scanner.height - 1, static_cast<int>(v + reach));
    for (int y = std::max(0, static_cast<int>(v - reach)); y <= bottom; ++y) {
      for (int x = left; x <= right; ++x) {
        const Vector ray = stand.ray(x + .5 - half_x, y + .5 - half_y);
        at(x, y) = std::min(at(x, y), meeting(stand.eye, ray, ball));
      }
    }
  }
  return depth;
}

Eigen::Affine3d registration(const DepthScanner& scanner, Random& random) {
  Vector turn, shift;
  for (int axis = 0; axis < 3; ++axis) {
    turn[axis] = random.normal(0, scanner.turn_rad);
    shift[axis] = random.normal(0, scanner.shift_m);
  }
  Eigen::Affine3d moved = Eigen::Affine3d::Identity();
  moved.translate(shift);
  const double angle = turn.norm();
  if (angle > 0) moved.rotate(Eigen::AngleAxisd(angle, turn / angle));
  return moved;
}

void add_view(const Stand& stand, const std::vector<Ball>& balls, const DepthScanner& scanner,
              Random& random, std::vector<Vector>& points) {
  const std::vector<double> depth = depths(stand, balls, scanner);
  const Eigen::Affine3d moved = registration(scanner, random);
  for (int y = 0; y < scanner.height; ++y) {
    for (int x = 0; x < scanner.width; ++x) {
      const double at =
          depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(scanner.width) +
                static_cast<std::size_t>(x)];
      const double noise_m = random.normal(0, scanner.noise_m);
      const double part = random.uniform(.7, 1.1);
      const bool is_flying = random.chance(scanner.flying);
      if (!std::isfinite(at)) continue;
      const Vector ray = stand.ray(x + .5 - scanner.width / 2.0, y + .5 - scanner.height / 2.0);
      const double length = at * (is_flying ? part : 1) + noise_m / ray.norm();
      points.push_back(moved * (stand.eye + length * ray));
    }
  }
}

constexpr double kMmPerM = 1000;

}  // namespace

std::vector<base::Corner> scanned(const render::Scene& scene, const DepthScanner& scanner) {
  constexpr double kFar = 4, kLowest_rad = .6, kHighest_rad = 1.05, kField = 1.7;
  const std::vector<Ball> balls = balls_of(scene);
  const double reach = reach_of(balls);
  Random random(scanner.seed);
  std::vector<Vector> points;
  const double start_rad = random.uniform(0, 2 * std::numbers::pi);
  for (int k = 0; k < scanner.stands; ++k) {
    const bool is_above = k + 1 == scanner.stands;
    const double turn_rad = start_rad + 2 * std::numbers::pi * k / (scanner.stands - 1);
    const double up_rad =
        is_above ? std::numbers::pi / 2 - .02 : random.uniform(kLowest_rad, kHighest_rad);
    const Vector from(std::cos(up_rad) * std::cos(turn_rad), std::cos(up_rad) * std::sin(turn_rad),
                      std::sin(up_rad));
    add_view(Stand(kFar * reach * from, kField * reach, scanner.width), balls, scanner, random,
             points);
  }
  const Eigen::AngleAxisd any(random.uniform(0, 2 * std::numbers::pi),
                              Vector(random.uniform(-1, 1), random.uniform(-1, 1), 1).normalized());
  std::vector<base::Corner> turned;
  turned.reserve(points.size());
  for (const Vector& point : points) {
    const Vector place = kMmPerM * (any * point);
    turned.push_back({place.x(), place.y(), place.z()});
  }
  return turned;
}

ExactSurface surface_from_above(const render::Scene& scene) {
  constexpr int kAcross = 1200;
  constexpr double kBeyond = 1.6;
  const std::vector<Ball> balls = balls_of(scene);
  const double half = kBeyond * reach_of(balls), step = 2 * half / kAcross;
  std::vector<double> heights(std::size_t{kAcross} * kAcross, 0.0);
  for (const Ball& ball : balls) {
    const auto first = [&](double middle) {
      return std::max(0, static_cast<int>((middle - ball.radius + half) / step));
    };
    const auto last = [&](double middle) {
      return std::min(kAcross - 1, static_cast<int>((middle + ball.radius + half) / step));
    };
    for (int y = first(ball.centre.y()); y <= last(ball.centre.y()); ++y) {
      for (int x = first(ball.centre.x()); x <= last(ball.centre.x()); ++x) {
        const double dx = (x + .5) * step - half - ball.centre.x();
        const double dy = (y + .5) * step - half - ball.centre.y();
        const double rise = ball.radius * ball.radius - dx * dx - dy * dy;
        double& height =
            heights[static_cast<std::size_t>(y) * kAcross + static_cast<std::size_t>(x)];
        if (rise > 0) height = std::max(height, ball.centre.z() + std::sqrt(rise));
      }
    }
  }
  ExactSurface exact;
  constexpr double kMlPerM3 = 1e6;
  for (int y = 0; y < kAcross; ++y) {
    for (int x = 0; x < kAcross; ++x) {
      const double height =
          heights[static_cast<std::size_t>(y) * kAcross + static_cast<std::size_t>(x)];
      exact.volume_ml += height * step * step * kMlPerM3;
      exact.points.push_back({kMmPerM * ((x + .5) * step - half),
                              kMmPerM * ((y + .5) * step - half), kMmPerM * height});
    }
  }
  return exact;
}

}  // namespace repose::bench
