#include "dem/verify/scene.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "dem/engine/time_step.h"

namespace repose::dem {

namespace {

Simulation simulation_of(SimulationSetup setup, const std::vector<Grain>& grains) {
  Simulation simulation(std::move(setup));
  for (const Grain& grain : grains) simulation.add(grain);
  return simulation;
}

}  // namespace

Trial::Trial(const VerifyCase& which, double timestep_fraction, const CasePeer* peer)
    : peer_(peer), name_(which.name), source_(which.source), timestep_share_(timestep_fraction) {}

double Trial::timestep_s(const SimulationSetup& setup, double speed_m_s) const {
  return timestep_share_ * accurate_timestep_s(setup, speed_m_s);
}

void Trial::take_timestep(SimulationSetup& setup, double speed_m_s) {
  timestep_s_ = setup.timestep_s = timestep_s(setup, speed_m_s);
}

std::vector<Collision> Trial::collide_each(SimulationSetup setup,
                                           const std::vector<Meeting>& meetings, double speed_m_s,
                                           double radius) {
  take_timestep(setup, speed_m_s);
  if (peer_) return peer_->collide_each(setup, meetings);
  std::vector<Collision> collisions;
  for (const Meeting& meeting : meetings) {
    Simulation simulation = simulation_of(setup, meeting);
    collisions.push_back(dem::collide(simulation, radius));
  }
  return collisions;
}

Path Trial::follow(SimulationSetup setup, const std::vector<Grain>& grains, double speed_m_s,
                   double duration_s, int every_steps) {
  take_timestep(setup, speed_m_s);
  if (peer_) return peer_->follow(setup, grains, duration_s, every_steps);
  Simulation simulation = simulation_of(std::move(setup), grains);
  Path path = {{.time_s = 0, .grain = simulation.grain(0)}};
  while (path.back().time_s < duration_s) {
    simulation.advance(every_steps);
    path.push_back({.time_s = simulation.time_s(), .grain = simulation.grain(0)});
  }
  return path;
}

Simulation Trial::simulate(SimulationSetup setup, double speed_m_s) {
  if (peer_) throw CannotRun("the case does more with our engine than to look on");
  take_timestep(setup, speed_m_s);
  return Simulation(std::move(setup));
}

void Trial::expect(const std::string& quantity, double expected, double measured,
                   double tolerance) {
  results_.push_back({.name = name_,
                      .quantity = quantity,
                      .source = source_,
                      .expected = expected,
                      .measured = measured,
                      .tolerance = tolerance,
                      .timestep_s = timestep_s_,
                      .holds = std::abs(measured - expected) <= tolerance});
}

namespace {

/// Maximum of the parabola through three equally spaced samples around the greatest.
double peak_of(const std::vector<double>& samples) {
  const auto top = std::max_element(samples.begin(), samples.end());
  if (top == samples.begin() || top + 1 == samples.end()) return *top;
  const double slope = (top[1] - top[-1]) / 2;
  const double bend = top[1] - 2 * top[0] + top[-1];
  return bend < 0 ? *top - slope * slope / (2 * bend) : *top;
}

}  // namespace

SimulationSetup scene_of(const ClumpShape& shape, const Material& grain, const Material& wall,
                         const PairCoefficients& pair, RollingModel rolling, DampingModel damping) {
  return {.kinds = {{.shape = shape, .material = 0}},
          .walls = {},
          .contacts = ContactTable({grain, wall}, {pair, pair, pair, pair}, rolling, damping),
          .gravity = Vector::Zero()};
}

SimulationSetup ball_scene(const PairCoefficients& pair, RollingModel rolling) {
  const Material rubber{
      .name = "rubber", .density_kg_m3 = 1000, .young_modulus_pa = 5e7, .poisson_ratio = .3};
  return scene_of(sphere_shape(kBallRadius_m), rubber, rubber, pair, rolling);
}

ClumpShape block_shape(const Vector& half_size, double sphere_radius) {
  ClumpShape shape;
  const Vector corner = half_size - Vector::Constant(sphere_radius);
  for (const double x : {-corner.x(), corner.x()}) {
    for (const double y : {-corner.y(), corner.y()}) {
      for (const double z : {-corner.z(), corner.z()}) {
        shape.spheres.push_back({.centre = {x, y, z}, .radius = sphere_radius});
      }
    }
  }
  shape.volume_m3 = 8 * half_size.prod();
  const Vector squares = half_size.cwiseAbs2();
  shape.gyration_m2 = (Vector::Constant(squares.sum()) - squares) / 3;
  return shape;
}

Wall tilted_plane(double tilt_rad) {
  Wall wall;
  wall.shape = Plane{};
  wall.material = 1;
  wall.pose.orientation = Eigen::AngleAxisd(tilt_rad, Vector::UnitY());
  return wall;
}

Grain resting_sphere(const SimulationSetup& setup, double tilt_rad) {
  const ClumpShape& shape = setup.kinds[0].shape;
  const double radius = shape.spheres[0].radius;
  const double weight = shape.volume_m3 * setup.contacts.material(0).density_kg_m3 *
                        setup.gravity.norm() * std::cos(tilt_rad);
  const double young = setup.contacts.law(0, 1).reduced_young_pa;
  const double overlap = std::pow(3 * weight / (4 * young * std::sqrt(radius)), 2.0 / 3);
  const Vector up(std::sin(tilt_rad), 0, std::cos(tilt_rad));
  Grain grain;
  grain.position = up * (radius - overlap);
  return grain;
}

Vector downhill(double tilt_rad) { return {std::cos(tilt_rad), 0, -std::sin(tilt_rad)}; }

Collision collision_of(const CollisionSamples& samples, const Grain& after, const Grain& struck) {
  const std::vector<double>& overlaps = samples.overlaps_m;
  // The first and last overlaps are assumed to change as fast as their neighbours.
  const auto first = static_cast<std::size_t>(
      std::find_if(overlaps.begin(), overlaps.end(), [](double overlap) { return overlap > 0; }) -
      overlaps.begin());
  const std::size_t last = overlaps.size() - 2;
  const double before = overlaps[first] / (overlaps[first + 1] - overlaps[first]);
  const double behind = overlaps[last] / (overlaps[last - 1] - overlaps[last]);
  const double steps = before + static_cast<double>(last - first) + behind;
  const std::vector<double>& pushes = samples.pushes_n;
  return {.after = after,
          .struck = struck,
          .deepest_m = peak_of(overlaps),
          .peak_n = peak_of(pushes),
          .pull_n = std::max(0.0, -*std::min_element(pushes.begin(), pushes.end())),
          .duration_s = steps * samples.timestep_s};
}

Collision collide(Simulation& simulation, double radius) {
  CollisionSamples samples = {
      .timestep_s = simulation.setup().timestep_s, .overlaps_m = {0}, .pushes_n = {0}};
  do {
    simulation.advance(1);
    samples.overlaps_m.push_back(simulation.deepest_overlap() * radius);
    samples.pushes_n.push_back(simulation.force_n(0).z());
  } while (samples.overlaps_m.back() > 0 || samples.overlaps_m.size() < 4);
  return collision_of(samples, simulation.grain(0),
                      simulation.grain_count() > 1 ? simulation.grain(1) : Grain{});
}

Collision strike_wall(Trial& trial, SimulationSetup setup, const Vector& velocity,
                      const Vector& spin) {
  setup.walls = {tilted_plane(0)};
  const double radius = setup.kinds[0].shape.spheres[0].radius;
  Grain grain;
  grain.position.z() = radius;
  grain.velocity = velocity;
  grain.spin = spin;
  return trial.collide(std::move(setup), {grain}, velocity.norm(), radius);
}

}  // namespace repose::dem
