#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <repose/calibrate.h>
#include <repose/measure.h>
#include <repose/report.h>
#include <repose/simulate.h>

namespace {

namespace fs = std::filesystem;

/// A white picture contains no heap: the library must say so and give no number.
bool refuses_a_blank_picture() {
  constexpr int kWidth = 320;
  constexpr int kHeight = 240;
  const repose::Picture blank{
      .width = kWidth,
      .height = kHeight,
      .bgr = std::vector<std::uint8_t>(std::size_t{kWidth} * kHeight * 3, 255)};

  const repose::ReposeAngle result = repose::measure_repose_angle(blank);
  std::cout << "blank picture: " << result.reason << '\n';
  const bool refused = result.status == repose::MeasureStatus::refused;
  return refused && !result.angle_rad && !result.reason.empty();
}

/// A ball in free fall.
bool falls() {
  const repose::ContactTable contacts(
      {{.name = "glass", .density_kg_m3 = 2500, .young_modulus_pa = 1e8, .poisson_ratio = .25}},
      {repose::PairCoefficients{}}, repose::RollingModel::none);
  repose::SimulationSetup setup{.kinds = {{repose::sphere_shape(.01), 0}}, .contacts = contacts};
  setup.timestep_s = 1e-4;
  repose::Simulation simulation(setup);
  simulation.add({});
  simulation.advance(1000);
  const double fallen_m = -simulation.grain(0).position.z();
  std::cout << "fallen in .1 s: " << fallen_m << " m\n";
  return fallen_m > .049 && fallen_m < .0491;
}

/// Soft rough balls, few and fast: a heap takes a fifth of a second.
constexpr const char* kBalls = R"([particle]
size_mm = [18, 18, 18]
spheres = 1
density_kg_m3 = 850
young_modulus_pa = 1e6
poisson_ratio = 0.38
[wall]
young_modulus_pa = 1e9
poisson_ratio = 0.3
[contact.particle_wall]
restitution = 0.3
sliding_friction = 0.8
rolling_friction = 0.3
[contact.particle_particle]
restitution = 0.2
sliding_friction = 0.5
rolling_friction = { value = 0.3, min = 0.1, max = 0.5 }
[uncertainty]
vary = false
[experiment.heap]
grains = 40
stiffness_factor = 0.3
lift_speed_mm_s = 100
)";

/// A heap, its angle, and a picture of it.
bool simulates_a_heap(const fs::path& folder) {
  std::ofstream(folder / "heap.toml") << kBalls;
  const repose::Study study = repose::read_study(folder / "heap.toml");
  const repose::SimulatedRun run = repose::simulate_study(study, "heap", 1, folder / "heaps");
  const std::optional<double> angle_deg = repose::value_of(run.result);
  if (!angle_deg) return false;
  std::cout << "a simulated heap has " << *angle_deg << " degrees\n";
  const repose::Scene scene = repose::scene_of(repose::read_state(run.state));
  repose::Renderer renderer;
  const repose::Picture picture =
      renderer
          .draw(scene, repose::OrthographicCamera{}, {.width = 640, .height = 360},
                repose::SilhouetteStyle{})
          .picture;
  repose::write_picture(folder / "heap.png", picture);
  return *angle_deg > 10 && *angle_deg < 60 &&
         repose::read_picture(folder / "heap.png").width == 640;
}

/// From photographs of heaps to a coefficient, and a report of it.
bool calibrates_from_pictures(const fs::path& photos, const fs::path& folder) {
  std::ofstream(folder / "study.toml")
      << kBalls << "measured = { pictures = ['" << (photos / "heap_01.jpg").string() << "', '"
      << (photos / "heap_03.jpg").string() << "'] }\n";
  repose::StudyRequest request{.study = folder / "study.toml", .folder = folder / "calibration"};
  request.budget.settings.max_jobs = 6;
  request.budget.verification_repeats = 2;
  request.budget.family_sets = 0;
  std::vector<std::string> said;
  const std::optional<repose::StudyResult> result =
      repose::run_study(request, {.note = [&](const std::string& text) { said.push_back(text); }});
  if (!result) return false;
  const auto& joint = std::get<repose::JointResult>(result->found);
  std::cout << joint.observables.at(0).measured
            << " degrees in photographs: " << joint.parameters.at(0).name << ' '
            << joint.parameters.at(0).value << '\n';
  const fs::path page = repose::write_report(request.folder);
  return std::abs(joint.observables.at(0).measured - 23) < 2 && !said.empty() &&
         repose::read_result(request.folder) == result && fs::file_size(page) > 100'000;
}

/// A study without free coefficients is refused with a reason, and a rebound gives a restitution.
bool refuses_a_study_without_unknowns(const fs::path& folder) {
  try {
    repose::run_study({.study = folder / "heap.toml",
                       .settings = {"contact.particle_particle.rolling_friction = 0.1"},
                       .folder = folder / "none"});
    return false;
  } catch (const repose::InputError& error) {
    std::cout << error.what() << '\n';
  }
  const double restitution = repose::restitution_of(.5, .125);
  return restitution > .4999 && restitution < .5001;
}

}  // namespace

int main(int, char* arguments[]) {
  const fs::path folder = fs::path(arguments[0]).parent_path() / "made";
  fs::remove_all(folder);
  fs::create_directories(folder);
  return refuses_a_blank_picture() && falls() && simulates_a_heap(folder) &&
                 calibrates_from_pictures(arguments[1], folder) &&
                 refuses_a_study_without_unknowns(folder)
             ? 0
             : 1;
}
