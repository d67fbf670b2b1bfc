#include "tests/bench/liggghts_race.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/units.h"
#include "tests/bench/clock.h"
#include "tests/bench/packing.h"
#include "tests/peers/liggghts.h"

namespace repose::bench {
namespace {

std::vector<dem::Grain> last_frame(const std::filesystem::path& folder) {
  const std::vector<calibrate::FrameGrain> frame = calibrate::frames_of(folder).back();
  return {frame.begin(), frame.end()};
}

using dem::Vector;

constexpr double kSphereStepsARun = 6e6;
constexpr double kClumpStepsARun = 6e5;
constexpr int kMaxPoured = 10000;
constexpr const char* kRestart = "read_restart packing.restart";

std::int64_t steps_for(double grain_steps, std::size_t grains) {
  return std::max<std::int64_t>(
      5, static_cast<std::int64_t>(grain_steps) / static_cast<std::int64_t>(grains));
}

dem::SimulationSetup with_their_rolling(dem::SimulationSetup setup) {
  const dem::ContactTable& table = setup.contacts;
  std::vector<dem::Material> materials;
  std::vector<dem::PairCoefficients> pairs;
  for (int a = 0; a < table.size(); ++a) {
    materials.push_back(table.material(a));
    for (int b = 0; b < table.size(); ++b) pairs.push_back(table.pair(a, b));
  }
  setup.contacts = dem::ContactTable(std::move(materials), std::move(pairs),
                                     dem::RollingModel::relative_constant_torque);
  return setup;
}

dem::Simulation simulation_of(const dem::SimulationSetup& setup,
                              const std::vector<dem::Grain>& grains) {
  dem::Simulation simulation(setup);
  for (const dem::Grain& grain : grains) simulation.add(grain);
  return simulation;
}

double contacts_a_grain(const dem::Simulation& simulation) {
  return static_cast<double>(simulation.contacts().size()) / simulation.grain_count();
}

/// The poses of clumps whose spheres lie in a row along x, from LIGGGHTS's sphere positions.
std::vector<dem::Grain> clumps_from(const dem::ClumpShape& shape,
                                    const std::vector<dem::Grain>& spheres) {
  const std::size_t each = shape.spheres.size();
  const double length = shape.spheres.back().centre.x() - shape.spheres.front().centre.x();
  std::vector<dem::Grain> clumps;
  for (std::size_t first = 0; first + each <= spheres.size(); first += each) {
    const Vector& from = spheres[first].position;
    const Vector axis = spheres[first + each - 1].position - from;
    if (std::abs(axis.norm() - length) > 1e-6 * length) {
      throw std::runtime_error("LIGGGHTS's spheres do not come clump by clump");
    }
    clumps.push_back({.position = from + axis / 2,
                      .orientation = dem::Quaternion::FromTwoVectors(Vector::UnitX(), axis)});
  }
  return clumps;
}

/// Of the run that has `later` runs after it.
double loop_time_s(const std::string& output, int later) {
  const std::string words = "Loop time of ";
  std::size_t at = output.rfind(words);
  for (int k = 0; k < later && at != std::string::npos && at > 0; ++k) {
    at = output.rfind(words, at - 1);
  }
  if (at == std::string::npos) throw std::runtime_error("LIGGGHTS tells no time");
  return std::stod(output.substr(at + words.size()));
}

/// Commands that let clumps fall into a tube from a loose cloud `height_m` high.
std::string pouring_commands(const dem::ClumpShape& shape, double density_kg_m3,
                             double tube_radius_m, double height_m, int grains) {
  // Seeds must be prime numbers.
  return fmt::format(
      "fix template all particletemplate/multisphere 15485863 atom_type 1 density constant {:.17g} "
      "nspheres {} ntry 1000000 spheres file clump.txt scale 1 type 1\n"
      "fix mix all particledistribution/discrete 49979687 1 template 1\n"
      "region cloud cylinder z 0 0 {:.17g} 0 {:.17g} units box\n"
      "fix pour all insert/pack seed 32452843 distributiontemplate mix maxattempt 500 insert_every "
      "once overlapcheck yes orientation random all_in yes vel constant 0 0 -.5 region cloud "
      "particles_in_region {}\n",
      density_kg_m3, shape.spheres.size(), tube_radius_m, height_m, grains);
}

/// The file clump.txt that these commands read.
std::string clump_file(const dem::ClumpShape& shape) {
  std::string text;
  for (const dem::ClumpSphere& sphere : shape.spheres) {
    const Vector& at = sphere.centre;
    text += fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}\n", at.x(), at.y(), at.z(), sphere.radius);
  }
  return text;
}

}  // namespace

Packing settled_spheres(const testing::TemporaryFolder& folder, int grains) {
  const dem::Simulation poured = grains > kMaxPoured ? testing::wide_box_of_spheres(grains, 1)
                                                     : testing::box_of_spheres(grains, 1);
  Packing packing = {.setup = with_their_rolling(poured.setup()),
                     .grains = {},
                     .start = "read_data spheres.txt",
                     .integrator = "nve/sphere"};
  for (int k = 0; k < poured.grain_count(); ++k) packing.grains.push_back(poured.grain(k));
  packing.steps = steps_for(kSphereStepsARun, packing.grains.size());
  const Vector room = Vector::Constant(3 * packing.setup.kinds[0].shape.reach_m());
  folder.write("spheres.txt", calibrate::data_of(packing.setup, packing.grains, room));
  return packing;
}

Packing settled_clumps(const testing::TemporaryFolder& folder, int grains) {
  Packing packing = {.setup = with_their_rolling(testing::tube_setup(1)),
                     .grains = {},
                     .start = kRestart,
                     .integrator = "multisphere"};
  const dem::ClumpShape& shape = packing.setup.kinds[0].shape;
  const double radius = std::get<dem::Tube>(packing.setup.walls.back().shape).inner_radius;
  const double height = .05 + .003 * grains;  // loose enough to place every one
  const double fall_s = std::sqrt(2 * height / kStandardGravity_m_s2);
  const auto steps = static_cast<int>((fall_s + .3) / packing.setup.timestep_s);
  folder.write("clump.txt", clump_file(shape));
  calibrate::DeckOptions options;
  options.start =
      fmt::format("region box block -{0} {0} -{0} {0} -.02 {1} units box\ncreate_box {2} box",
                  1.2 * radius, height + .05, packing.setup.contacts.size());
  options.insertion = pouring_commands(shape, packing.setup.contacts.material(0).density_kg_m3,
                                       radius, height, grains);
  options.integrator = packing.integrator;
  testing::run_liggghts(folder, calibrate::deck_of(packing.setup, options) +
                                    fmt::format("run 1\nunfix pour\nrun {}\nwrite_restart "
                                                "packing.restart\n{}run 1\n",
                                                steps, calibrate::dump_command(1)));
  packing.grains = clumps_from(shape, last_frame(folder.path()));
  if (std::ssize(packing.grains) != grains) {
    throw std::runtime_error(
        fmt::format("LIGGGHTS got {} of {} clumps into the tube", packing.grains.size(), grains));
  }
  packing.steps = steps_for(kClumpStepsARun, packing.grains.size());
  return packing;
}

Race::Race(const testing::TemporaryFolder& folder, Packing packing, double skin_m)
    : folder_(folder), packing_(std::move(packing)), skin_m_(skin_m) {
  const std::int64_t warm_up = std::max<std::int64_t>(500, packing_.steps);
  dem::Simulation ours = simulation_of(packing_.setup, packing_.grains);
  ours.advance(warm_up);
  start_ = ours.checkpoint();
  testing::run_liggghts(
      folder_,
      their_deck(packing_.start) + fmt::format("run {}\nwrite_restart packing.restart\n", warm_up));
  their_overhead_s_ = run_theirs(0).cpu_s;
}

std::string Race::their_deck(const std::string& start) const {
  calibrate::DeckOptions options;
  options.start = start;
  options.integrator = packing_.integrator;
  options.skin_m = skin_m_;
  return calibrate::deck_of(packing_.setup, options) + "thermo 1000000\n";
}

Timing Race::time_ours() {
  dem::Simulation simulation(packing_.setup, start_);
  simulation.advance(1);  // builds the neighbour lists
  const auto start = Clock::now();
  const double cpu_start_s = cpu_s();
  simulation.advance(packing_.steps);
  const Timing timing = {seconds_since(start), cpu_s() - cpu_start_s};
  our_contacts_ = contacts_a_grain(simulation);
  return timing;
}

Timing Race::time_theirs() {
  Timing timing = run_theirs(packing_.steps);
  timing.cpu_s -= their_overhead_s_;
  const std::vector<dem::Grain> spheres = last_frame(folder_.path());
  const dem::ClumpShape& shape = packing_.setup.kinds[0].shape;
  // Our engine counts the contacts at LIGGGHTS's final positions, so that both are counted alike.
  dem::Simulation simulation = simulation_of(
      packing_.setup, shape.spheres.size() == 1 ? spheres : clumps_from(shape, spheres));
  simulation.advance(1);
  their_contacts_ = contacts_a_grain(simulation);
  return timing;
}

Timing Race::run_theirs(std::int64_t steps) {
  const testing::Finished finished = testing::run_liggghts(
      folder_, their_deck(kRestart) +
                   fmt::format("run 1\nrun {}\n{}run 1\n", steps, calibrate::dump_command(1)));
  return {loop_time_s(finished.out, 1), finished.cpu_s};
}

}  // namespace repose::bench
