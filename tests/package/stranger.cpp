#include <cstdint>
#include <iostream>

#include <repose/calibrate/fit/joint_fit.h>
#include <repose/calibrate/statistics/bench/formulas.h>
#include <repose/dem/engine/simulation.h>
#include <repose/vision/measure/repose_angle.h>

namespace {

/// A white picture holds no heap: the library must say so and give no number.
bool refuses_a_blank_picture() {
  constexpr int kWidth = 320;
  constexpr int kHeight = 240;
  const repose::vision::Picture blank{
      .width = kWidth,
      .height = kHeight,
      .bgr = std::vector<std::uint8_t>(std::size_t{kWidth} * kHeight * 3, 255)};

  const repose::vision::ReposeAngle result = repose::vision::measure_repose_angle(blank);
  std::cout << "blank picture: " << result.reason << '\n';
  const bool refused = result.status == repose::vision::MeasureStatus::refused;
  return refused && !result.angle_rad && !result.reason.empty();
}

/// A ball in free fall.
bool falls() {
  using namespace repose::dem;
  const ContactTable contacts(
      {{.name = "glass", .density_kg_m3 = 2500, .young_modulus_pa = 1e8, .poisson_ratio = .25}},
      {PairCoefficients{}}, RollingModel::none);
  SimulationSetup setup{.kinds = {{sphere_shape(.01), 0}}, .contacts = contacts};
  setup.timestep_s = 1e-4;
  Simulation simulation(setup);
  simulation.add({});
  simulation.advance(1000);
  const double fallen_m = -simulation.grain(0).position.z();
  std::cout << "fallen in .1 s: " << fallen_m << " m\n";
  return fallen_m > .049 && fallen_m < .0491;
}

/// A study in which nothing is sought is refused, and a rebound is a restitution.
bool calibrates() {
  using namespace repose::calibrate;
  const bool is_refused = !errors_of(Problem{}).empty();
  const double restitution = restitution_of(.5, .125);
  std::cout << "restitution: " << restitution << '\n';
  return is_refused && restitution > .4999 && restitution < .5001;
}

}  // namespace

int main() { return refuses_a_blank_picture() && falls() && calibrates() ? 0 : 1; }
