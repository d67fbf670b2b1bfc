#include "tests/bench/heap_race.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "calibrate/experiment/heap_views.h"
#include "dem/engine/time_step.h"
#include "dem/experiment/experiment.h"
#include "dem/experiment/placing.h"
#include "dem/experiment/rain.h"
#include "dem/study/grain_source.h"
#include "dem/study/study.h"
#include "render/scene/scene.h"
#include "tests/bench/cpu_time.h"
#include "tests/bench/liggghts_race.h"
#include "tests/peers/liggghts.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace repose::bench {
namespace {

using dem::Vector;

constexpr int kViews = 18;
/// Of the stable step of falling grains.
constexpr double kTheirFraction = .175;

/// The inside of a tube as an STL file.
std::string tube_file(double radius_m, double height_m) {
  constexpr int kSides = 96;
  const auto corner = [&](int side, double z) {
    const double turn = 2 * std::numbers::pi * side / kSides;
    return fmt::format("vertex {:.9g} {:.9g} {:.9g}\n", radius_m * std::cos(turn),
                       radius_m * std::sin(turn), z);
  };
  std::string text = "solid tube\n";
  const auto add = [&text](const std::string& corners) {
    text += "facet normal 0 0 0\nouter loop\n" + corners + "endloop\nendfacet\n";
  };
  for (int k = 0; k < kSides; ++k) {
    add(corner(k, 0) + corner(k + 1, 0) + corner(k + 1, height_m));
    add(corner(k, 0) + corner(k + 1, height_m) + corner(k, height_m));
  }
  return text + "endsolid tube\n";
}

/// CPU time of LIGGGHTS's own heap.
double time_theirs(const dem::HeapProtocol& protocol, const dem::Repeat& ours, int grains) {
  const testing::TemporaryFolder folder;
  dem::SimulationSetup setup = ours.state->setup();
  setup.walls = {{.shape = dem::Plane{}, .material = 1}};
  setup.timestep_s =
      dem::accurate_timestep_s(setup, dem::fastest_rain_m_s(dem::reach_m(setup)), kTheirFraction);
  const dem::ClumpShape& shape = setup.kinds.front().shape;
  const double radius = .5 * protocol.tube_diameter_m;
  const double cloud = .05 + .003 * grains;  // loose enough to find a place for each
  const double fall_s = std::sqrt(2 * cloud / dem::kStandardGravity_m_s2) + .3;
  folder.write("clump.txt", clump_file(shape));
  folder.write("tube.stl", tube_file(radius, cloud + .05));
  testing::DeckOptions options;
  options.start = fmt::format(
      "region box block -{0} {0} -{0} {0} -.02 {1} units box\n"
      "create_box {2} box",
      2 * protocol.plate_m, 2 * cloud + .5, setup.contacts.size());
  options.insertion =
      "fix tube all mesh/surface file tube.stl type 2\n"
      "fix tube_wall all wall/gran model hertz tangential history rolling_friction cdt mesh "
      "n_meshes 1 meshes tube\n" +
      pouring_commands(shape, setup.contacts.material(0).density_kg_m3, radius, cloud, grains);
  options.integrator = "multisphere";
  const auto steps = [&setup](double s) { return static_cast<int>(s / setup.timestep_s); };
  const std::string runs = fmt::format(
      "thermo 1000000\nrun 1\nunfix pour\nrun {}\n"
      "fix lift all move/mesh mesh tube linear 0 0 {:.17g}\nrun {}\n",
      steps(fall_s), protocol.lift_speed_m_s, steps(ours.readings.at("time_s")));
  return testing::run_liggghts(folder, testing::deck_of(setup, options) + runs).cpu_s;
}

}  // namespace

HeapTimes race_heaps(const std::vector<std::string>& settings, int rounds) {
  std::vector<std::string> all = {"contact.rolling_model=\"relative_constant_torque\""};
  all.insert(all.end(), settings.begin(), settings.end());
  const dem::Study study =
      dem::read_study(testing::source_folder() / "samples/hazelnut/study.toml", all);
  dem::Model model = dem::model_for(study, dem::Experiment::heap);
  model.grain = dem::build_grain(study.grain).shape;
  model.threads = 1;
  const auto protocol = study.protocol<dem::HeapProtocol>();
  HeapTimes times;
  for (int round = 0; round < rounds; ++round) {
    const double start = cpu_s();
    const dem::Repeat ours = dem::run_heap(model, protocol, static_cast<std::uint64_t>(round) + 1);
    const double done = cpu_s();
    times.ours_s.push_back(done - start);
    measure_views(calibrate::HeapViewSession(render::scene_of(*ours.state), {.views = kViews}), 1,
                  [](double /*fraction*/) { return true; });
    times.views_s.push_back(cpu_s() - done);
    times.grains = static_cast<int>(ours.readings.at("grains"));
    if (testing::has_liggghts())
      times.theirs_s.push_back(time_theirs(protocol, ours, times.grains));
  }
  return times;
}

}  // namespace repose::bench
