#include <atomic>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include <repose/calibrate/report/study_report.h>
#include <repose/calibrate/result/result.h>
#include <repose/calibrate/statistics/bench/formulas.h>
#include <repose/calibrate/study/executor.h>
#include <repose/calibrate/study/study_run.h>
#include <repose/dem/engine/simulation.h>
#include <repose/dem/study/grain_source.h>
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

/// A soft ball whose restitution a drop tells: some tens of runs of hundredths of a second.
constexpr const char* kStudy = R"([particle]
size_mm = [20, 20, 20]
spheres = 1
density_kg_m3 = 1000
young_modulus_pa = 1e6
poisson_ratio = 0.3
[wall]
young_modulus_pa = 1e8
poisson_ratio = 0.3
[contact.particle_wall]
restitution = { min = 0.2, max = 0.9 }
sliding_friction = 0.3
rolling_friction = 0.01
[contact.particle_particle]
restitution = 0.2
sliding_friction = 0.2
rolling_friction = 0.04
[experiment.drop]
height_mm = 100
grains = 1
measured = { mean = 25, sd = 1, n = 5 }
)";

/// From a study file by simulations and a fit to a result, its text and its report.
bool runs_a_study(const std::filesystem::path& folder) {
  using namespace repose::calibrate;
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "ball.toml") << kStudy;
  StudyRecord record;
  record.study = repose::dem::read_study(folder / "ball.toml", {});
  record.grain = repose::dem::build_grain(record.study.grain);
  record.method = "joint";
  record.budget = budget_named("quick");
  record.budget.settings.max_jobs = 20;
  const StudyProblem problem = problem_of(record.study, record.grain, record.budget);
  const StudySimulator simulator(record.study, record.grain, problem.problem.parameters);
  const RunStore runs(folder / "calibration");
  ThreadExecutor executor(simulator, 2);
  const std::atomic<bool> is_interrupted = false;
  const std::optional<StudyOutcome> outcome =
      run_study(problem.problem, record.budget, {simulator, runs, executor, is_interrupted});
  if (!outcome) return false;

  const StudyResult result = result_of(record, problem, *outcome);
  const double restitution = std::get<JointResult>(result.found).parameters.at(0).value;
  std::cout << "a ball that rebounds 25 mm has the restitution " << restitution << '\n';
  const StudyResult read = result_from_json(to_json(result), "result.json");
  const report::Report page = report::study_report(read);
  std::ofstream(folder / "report.html") << page.html;
  return restitution > .4 && restitution < .6 && read == result &&
         page.html.find("The answer") != std::string::npos && !page.tables.empty();
}

}  // namespace

int main(int, char* arguments[]) {
  const std::filesystem::path folder = std::filesystem::path(arguments[0]).parent_path() / "study";
  return refuses_a_blank_picture() && falls() && calibrates() && runs_a_study(folder) ? 0 : 1;
}
