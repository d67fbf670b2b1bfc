#include "dem/shape/clump/fill.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "dem/shape/clump/clump_errors.h"
#include "dem/shape/clump/sphere_fit.h"
#include "dem/shape/clump/surface.h"
#include "dem/shape/scan/mesh.h"

namespace repose::dem {

namespace {

constexpr int kGridAcross = 36;

/// Points not yet covered by a sphere, by coordinate: each round reads all of them for many
/// candidates.
class OpenPoints {
 public:
  explicit OpenPoints(const std::vector<Vector>& points) {
    for (const Vector& point : points) {
      x_.push_back(point.x());
      y_.push_back(point.y());
      z_.push_back(point.z());
    }
  }

  std::size_t inside(const ClumpSphere& sphere) const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) count += contains(sphere, i) ? 1 : 0;
    return count;
  }

  void take_inside(const ClumpSphere& sphere) {
    std::size_t left = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      if (contains(sphere, i)) continue;
      x_[left] = x_[i];
      y_[left] = y_[i];
      z_[left++] = z_[i];
    }
    for (std::vector<double>* coordinate : {&x_, &y_, &z_}) coordinate->resize(left);
  }

 private:
  bool contains(const ClumpSphere& sphere, std::size_t i) const {
    const double x = x_[i] - sphere.centre.x(), y = y_[i] - sphere.centre.y(),
                 z = z_[i] - sphere.centre.z();
    return x * x + (y * y + z * z) <= sphere.radius * sphere.radius;
  }

  std::vector<double> x_, y_, z_;
};

/// A candidate with an upper bound of its gain, computed in `round`.
struct Promise {
  double gain = 0;
  std::size_t candidate = 0;
  int round = -1;

  bool operator<(const Promise& other) const {
    return std::tie(gain, other.candidate) < std::tie(other.gain, candidate);
  }
};

}  // namespace

std::vector<ClumpSphere> inscribed_spheres(const Mesh& mesh, int count) {
  const Eigen::AlignedBox3d bounds = bounds_of(mesh);
  const ColumnGrid grid(bounds, kGridAcross);
  const std::vector<Vector> points = grid.points_inside(grid.of_surface(mesh));
  const SurfaceDistance surface(mesh);

  std::vector<ClumpSphere> candidates;
  std::priority_queue<Promise> promises;
  const double cell = std::pow(grid.spacing_m(), 3);
  for (const Vector& point : points) {
    const double radius = -surface.signed_distance(point);
    if (radius <= 0) continue;
    promises.push({4.0 / 3 * std::numbers::pi * std::pow(radius, 3) / cell + 1, candidates.size()});
    candidates.push_back({point, radius});
  }

  OpenPoints open(points);
  std::vector<ClumpSphere> chosen;
  while (static_cast<int>(chosen.size()) < count && !promises.empty()) {
    Promise best = promises.top();
    promises.pop();
    const ClumpSphere& sphere = candidates[best.candidate];
    const auto round = static_cast<int>(chosen.size());
    if (best.round == round) {
      chosen.push_back(sphere);
      open.take_inside(sphere);
      continue;
    }
    // Gains only shrink as spheres are added, so an old one is still an upper bound.
    best.gain = static_cast<double>(open.inside(sphere));
    best.round = round;
    if (best.gain > 0) promises.push(best);
  }
  return chosen;
}

namespace {

std::size_t samples_for(int spheres) {
  constexpr int kPerSphere = 120, kFewest = 2500, kMax = 8000;
  return static_cast<std::size_t>(std::clamp(kPerSphere * spheres, kFewest, kMax));
}

/// Points above every other sample, alternately low and high, with their true distance: in a dent,
/// another part of the surface may be nearer.
std::vector<SphereFit::Guard> guards_above(const Mesh& mesh,
                                           const std::vector<SurfaceSample>& samples,
                                           double equal_radius) {
  constexpr double kLow = 0.1, kHigh = 0.3;  // of the radius of the sphere of equal volume
  const SurfaceDistance surface(mesh);
  std::vector<SphereFit::Guard> guards;
  for (std::size_t i = 0; i < samples.size(); i += 2) {
    const double height = (i % 4 == 0 ? kLow : kHigh) * equal_radius;
    const Vector point = samples[i].point + height * samples[i].normal;
    const double distance = surface.signed_distance(point);
    if (distance > 0) guards.push_back({point, distance});
  }
  return guards;
}

/// Initial spheres, at least one: the inscribed ones that are large enough; in a thin body without
/// any, all inscribed ones, to be enlarged by the fit.
std::vector<ClumpSphere> first_spheres(const Mesh& mesh, int count, double smallest_radius,
                                       const Vector& centroid) {
  const std::vector<ClumpSphere> inside = inscribed_spheres(mesh, count);
  std::vector<ClumpSphere> spheres = inside;
  std::erase_if(spheres, [&](const ClumpSphere& s) { return s.radius < smallest_radius; });
  if (!spheres.empty()) return spheres;
  if (!inside.empty()) return inside;
  return {{.centre = centroid, .radius = smallest_radius}};
}

std::vector<ClumpSphere> fitted_spheres(const Mesh& mesh, int count,
                                        double smallest_radius_fraction) {
  const MassProperties body = mass_properties(mesh);
  const double equal_radius = std::cbrt(3 * body.volume_m3 / (4 * std::numbers::pi));
  if (count == 1) return {{body.centroid, equal_radius}};
  const std::vector<SurfaceSample> samples = sample_surface(mesh, samples_for(count));
  const double smallest_radius = smallest_radius_fraction * equal_radius;
  const SphereFit fit(samples, guards_above(mesh, samples, equal_radius), smallest_radius);
  std::vector<ClumpSphere> spheres = first_spheres(mesh, count, smallest_radius, body.centroid);
  relocate_and_fit(fit, samples, static_cast<std::size_t>(count), spheres);
  return spheres;
}

FillReport filled(const Mesh& mesh, int count, double smallest_radius_fraction) {
  FillReport report{.spheres = fitted_spheres(mesh, count, smallest_radius_fraction), .errors = {}};
  report.errors = clump_errors(mesh, report.spheres);
  return report;
}

/// The fewest spheres that reach the error, by doubling, then bisection.
FillReport fill_to_error(const Mesh& mesh, double volume_error, double smallest_radius_fraction) {
  int too_few = 0, enough = 1;
  FillReport best = filled(mesh, enough, smallest_radius_fraction);
  double least_error = best.errors.volume_error;
  while (best.errors.volume_error > volume_error) {
    if (enough == kMaxSpheres) {
      throw base::InputError({.where = "volume error",
                              .value = fmt::format("{:g} is not reached with {} spheres, {:g} is",
                                                   volume_error, kMaxSpheres, least_error),
                              .fix = "ask for no less than that, or smooth the surface."});
    }
    too_few = enough;
    enough = std::min(2 * enough, kMaxSpheres);
    best = filled(mesh, enough, smallest_radius_fraction);
    least_error = std::min(least_error, best.errors.volume_error);
  }
  while (enough - too_few > 1) {
    const int between = (too_few + enough) / 2;
    FillReport report = filled(mesh, between, smallest_radius_fraction);
    if (report.errors.volume_error <= volume_error) {
      best = std::move(report);
      enough = between;
    } else {
      too_few = between;
    }
  }
  return best;
}

/// Largest width-to-thickness ratio for a hundred spheres; twice the ratio takes four times as
/// many.
constexpr double kFlattest = 6.5;

/// Suggested fix if this many spheres are not enough for a surface.
std::string fix_for(const Mesh& mesh, std::size_t spheres) {
  Vector extent_m = bounds_of(mesh).sizes();
  std::sort(extent_m.begin(), extent_m.end());
  const double thickness_m = extent_m[1] / kFlattest;
  if (extent_m[0] < thickness_m) {
    return fmt::format(
        "a body at least {:.2g} mm thick (this one is {:.2g} mm), for which a hundred spheres do; "
        "thinner ones take many more.",
        1e3 * thickness_m, 1e3 * extent_m[0]);
  }
  if (spheres == kMaxSpheres) return "a thicker body; more spheres than these are not made.";
  return fmt::format("{}, or a {}.", base::field("more spheres"),
                     base::field("smaller volume error"));
}

/// Fitting few spheres to a slender body may give spheres larger than the body.
void check_sizes(const Mesh& mesh, const FillReport& report) {
  const Vector centroid = mass_properties(mesh).centroid;
  double reach = 0;
  for (const Vector& vertex : mesh.vertices) reach = std::max(reach, (vertex - centroid).norm());
  for (const ClumpSphere& sphere : report.spheres) {
    if (sphere.radius <= reach) continue;
    throw base::InputError(
        {.where = "spheres",
         .value = fmt::format("{} cannot follow this surface, one came out larger than all of it",
                              report.spheres.size()),
         .fix = fix_for(mesh, report.spheres.size())});
  }
}

void check_hangs_together(const Mesh& mesh, const FillReport& report) {
  const int groups = sphere_groups(report.spheres);
  if (groups <= 1) return;
  throw base::InputError(
      {.where = "spheres",
       .value = fmt::format("these {} fall into {} groups that do not touch each other; other "
                            "grains could pass between them",
                            report.spheres.size(), groups),
       .fix = fix_for(mesh, report.spheres.size())});
}

}  // namespace

std::vector<base::Fault> FillOptions::problems() const {
  std::vector<base::Fault> problems;
  if (spheres < 1 || spheres > kMaxSpheres) {
    problems.push_back({.where = "spheres",
                        .value = fmt::format("{}", spheres),
                        .rule = fmt::format("must be from 1 to {}", kMaxSpheres),
                        .fix = "11 is usual for a nut."});
  }
  if (volume_error && !(*volume_error > 0 && *volume_error < 1)) {
    problems.push_back({.where = "volume error",
                        .value = fmt::format("{:f}", *volume_error),
                        .rule = "must be a fraction between 0 and 1",
                        .fix = "0.02 for 2 %."});
  }
  if (!(smallest_radius_fraction > 0 && smallest_radius_fraction < 1)) {
    problems.push_back({.where = "smallest radius",
                        .value = fmt::format("{:f}", smallest_radius_fraction),
                        .rule = "must be a fraction between 0 and 1",
                        .fix = "0.1 is usual."});
  }
  return problems;
}

FillReport fill(const Mesh& mesh, const FillOptions& options) {
  std::vector<base::Fault> problems = options.problems();
  if (!problems.empty()) throw base::InputError(std::move(problems));
  FillReport report =
      options.volume_error
          ? fill_to_error(mesh, *options.volume_error, options.smallest_radius_fraction)
          : filled(mesh, options.spheres, options.smallest_radius_fraction);
  check_sizes(mesh, report);
  check_hangs_together(mesh, report);
  return report;
}

FilledClump clump_of(const Mesh& surface, const FillOptions& options) {
  const PrincipalFrame frame = principal_frame(surface);
  FilledClump clump;
  clump.shape.surface = in_frame(surface, frame);
  clump.shape.volume_m3 = mass_properties(surface).volume_m3;
  clump.shape.gyration_m2 = frame.gyration_m2;
  FillReport report = fill(clump.shape.surface, options);
  clump.shape.spheres = std::move(report.spheres);
  clump.errors = report.errors;
  return clump;
}

}  // namespace repose::dem
