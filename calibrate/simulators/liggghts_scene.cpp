#include "calibrate/simulators/liggghts_scene.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/input_error.h"
#include "calibrate/export/liggghts_decks.h"
#include "calibrate/export/target_entry.h"
#include "calibrate/simulators/program_simulator.h"
#include "dem/verify/case_peer.h"

namespace repose::calibrate {
namespace {

using dem::Vector;

/// LIGGGHTS numbers its materials from 1.
int type_of(int material) { return material + 1; }

using dem::CannotRun;
using dem::Material;
using dem::PairCoefficients;

/// A command with a number for each material.
template <typename Number>
std::string of_materials(const dem::ContactTable& contacts, const char* name, Number number_of) {
  std::string command = fmt::format("fix {0} all property/global {0} peratomtype", name);
  for (int a = 0; a < contacts.size(); ++a) {
    command += fmt::format(" {:.17g}", number_of(contacts.material(a)));
  }
  return command + '\n';
}

/// And one with a number for each pair of materials.
template <typename Number>
std::string of_pairs(const dem::ContactTable& contacts, const char* name, Number number_of) {
  std::string command =
      fmt::format("fix {0} all property/global {0} peratomtypepair {1}", name, contacts.size());
  for (int a = 0; a < contacts.size(); ++a) {
    for (int b = 0; b < contacts.size(); ++b) {
      command += fmt::format(" {:.17g}", number_of(contacts.pair(a, b)));
    }
  }
  return command + '\n';
}

double restitution_of(const PairCoefficients& pair) {
  if (pair.restitution_exponent != 0) throw CannotRun("LIGGGHTS has no restitution by speed");
  return liggghts_target()->restitution(pair.restitution).value;
}

}  // namespace

std::string changed_restitutions(const dem::ContactTable& contacts) {
  std::set<std::string> changes;
  for (int a = 0; a < contacts.size(); ++a) {
    for (int b = a; b < contacts.size(); ++b) {
      const double ours = contacts.pair(a, b).restitution;
      const RestitutionCounterpart theirs = liggghts_target()->restitution(ours);
      if (theirs.value == ours) continue;
      changes.insert(fmt::format("with a restitution of {:g} in place of {:g}: {}", theirs.value,
                                 ours, theirs.limits));
    }
  }
  return fmt::format("{}", fmt::join(changes, " "));
}

namespace {

std::string property_commands(const dem::ContactTable& contacts) {
  const auto value = [](auto member) { return [member](const auto& of) { return of.*member; }; };
  std::string commands =
      of_materials(contacts, "youngsModulus", value(&Material::young_modulus_pa)) +
      of_materials(contacts, "poissonsRatio", value(&Material::poisson_ratio)) +
      of_pairs(contacts, "coefficientRestitution", restitution_of) +
      of_pairs(contacts, "coefficientFriction", value(&PairCoefficients::sliding_friction)) +
      of_pairs(contacts, "coefficientRollingFriction", value(&PairCoefficients::rolling_friction));
  if (contacts.rolling() == dem::RollingModel::elastic_plastic) {
    commands += of_pairs(contacts, "coefficientRollingViscousDamping",
                         [](const PairCoefficients&) { return kLiggghtsRollingDamping; });
  }
  return commands;
}

std::string model_of(dem::RollingModel rolling) {
  if (rolling == dem::RollingModel::constant_torque) {
    throw CannotRun("LIGGGHTS does not have this definition of rolling friction");
  }
  return "model hertz tangential history" + liggghts_rolling_words(rolling);
}

std::string primitive_of(const dem::Wall& wall) {
  if (const auto* tube = std::get_if<dem::Tube>(&wall.shape)) {
    return fmt::format("zcylinder {:.17g} {:.17g} {:.17g}", tube->inner_radius,
                       wall.pose.position.x(), wall.pose.position.y());
  }
  const Vector normal = wall.pose.orientation * Vector::UnitZ();
  Vector::Index axis = 0;
  constexpr double kStraight = 1e-12;
  if (!std::holds_alternative<dem::Plane>(wall.shape) ||
      normal.cwiseAbs().maxCoeff(&axis) < 1 - kStraight) {
    throw CannotRun("LIGGGHTS needs walls that are planes across an axis, or tubes");
  }
  return fmt::format("{}plane {:.17g}", "xyz"[axis], wall.pose.position[axis]);
}

}  // namespace

std::string installed_liggghts(base::Faults& faults) {
  const auto printed = printed_by({kLiggghts, "-in", "/dev/null", "-log", "none"});
  const std::string key = "Version ";
  const std::size_t begin = printed ? printed->find(key) : std::string::npos;
  faults.require(begin != std::string::npos,
                 {.subject = "engine.program",
                  .value = "= \"liggghts\" is not installed, or does not start",
                  .rule = "the command liggghts starts LIGGGHTS-PUBLIC 3.8",
                  .fix = "apt-get install liggghts, or put its folder into PATH."});
  if (begin == std::string::npos) return {};
  const std::size_t end = printed->find(',', begin);
  return printed->substr(begin + key.size(), end - begin - key.size());
}

std::string gravity_command(const Vector& gravity) {
  if (gravity.isZero()) return {};
  return fmt::format("fix gravity all gravity {:.17g} vector {:.17g} {:.17g} {:.17g}\n",
                     gravity.norm(), gravity.x(), gravity.y(), gravity.z());
}

std::string deck_of(const dem::SimulationSetup& setup, const DeckOptions& options) {
  const std::string model = model_of(setup.contacts.rolling());
  std::string deck = fmt::format(
      "atom_style granular\natom_modify map array sort 0 0\nboundary f f f\nnewton off\n"
      "communicate single vel yes\nunits si\nhard_particles yes\n{}\n"
      "neighbor {:.17g} {}\nneigh_modify delay 0\n{}"
      "pair_style gran {} {}\npair_coeff * *\ntimestep {:.17g}\n{}",
      options.start, options.skin_m, options.search, property_commands(setup.contacts), model,
      options.model_settings, setup.timestep_s, gravity_command(setup.gravity));
  for (std::size_t k = 0; k < setup.walls.size(); ++k) {
    deck += fmt::format("fix wall{} all wall/gran {} primitive type {} {} {}\n", k, model,
                        type_of(setup.walls[k].material), primitive_of(setup.walls[k]),
                        options.model_settings);
  }
  return deck + options.insertion + fmt::format("fix motion all {}\n", options.integrator);
}

std::string data_of(const dem::SimulationSetup& setup, const std::vector<dem::Grain>& grains,
                    const Vector& room) {
  const double infinity = std::numeric_limits<double>::infinity();
  Vector low = Vector::Constant(infinity);
  Vector high = -low;
  std::string atoms = "\nAtoms\n\n";
  std::string velocities = "\nVelocities\n\n";
  for (std::size_t k = 0; k < grains.size(); ++k) {
    const dem::Grain& grain = grains[k];
    const dem::GrainKind& kind = setup.kinds[static_cast<std::size_t>(grain.kind)];
    if (kind.shape.spheres.size() != 1)
      throw CannotRun("only single spheres are set up in LIGGGHTS");
    const double diameter = 2 * kind.shape.spheres[0].radius;
    const Vector& at = grain.position;
    atoms += fmt::format(
        "{} {} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", k + 1, type_of(kind.material), diameter,
        setup.contacts.material(kind.material).density_kg_m3, at.x(), at.y(), at.z());
    velocities += fmt::format("{} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\n", k + 1,
                              grain.velocity.x(), grain.velocity.y(), grain.velocity.z(),
                              grain.spin.x(), grain.spin.y(), grain.spin.z());
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  std::string box;
  for (int axis = 0; axis < 3; ++axis) {
    box += fmt::format("{0:.17g} {1:.17g} {2}lo {2}hi\n", low[axis] - room[axis],
                       high[axis] + room[axis], "xyz"[axis]);
  }
  return fmt::format("grains\n\n{} atoms\n{} atom types\n{}", grains.size(), setup.contacts.size(),
                     box) +
         atoms + velocities;
}

std::string dump_command(int every_steps) {
  return fmt::format(
      "dump frames all custom {0} frames.txt id x y z vx vy vz omegax omegay omegaz fx fy fz\n"
      "dump_modify frames sort id format \"%d{1}\"\n",
      every_steps, [] {
        std::string numbers;
        for (int k = 0; k < 12; ++k) numbers += " %.14g";
        return numbers;
      }());
}

std::vector<std::vector<FrameGrain>> frames_of(const std::filesystem::path& folder) {
  std::ifstream file(folder / "frames.txt");
  std::vector<std::vector<FrameGrain>> frames;
  std::string line;
  bool is_table = false;
  while (std::getline(file, line)) {
    if (line.starts_with("ITEM: ")) {
      is_table = line.starts_with("ITEM: ATOMS");
      if (is_table) frames.emplace_back();
    } else if (is_table) {
      std::istringstream words(line);
      int id = 0;
      FrameGrain grain;
      words >> id;
      for (Vector* each : {&grain.position, &grain.velocity, &grain.spin, &grain.force}) {
        words >> each->x() >> each->y() >> each->z();
      }
      if (!words) {
        base::refuse(folder / "frames.txt", fmt::format("has the line \"{}\"", line),
                     "see output.txt there for what LIGGGHTS says.");
      }
      frames.back().push_back(grain);
    }
  }
  return frames;
}

}  // namespace repose::calibrate
