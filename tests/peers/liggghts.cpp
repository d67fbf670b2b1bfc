#include "tests/peers/liggghts.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <variant>

#include <fmt/format.h>

namespace repose::testing {
namespace {

using dem::Vector;

/// LIGGGHTS numbers its materials from 1.
int type_of(int material) { return material + 1; }

std::string property_commands(const dem::ContactTable& contacts) {
  using dem::Material;
  using dem::PairCoefficients;
  const auto of_materials = [&](const char* name, double Material::*value) {
    std::string command = fmt::format("fix {0} all property/global {0} peratomtype", name);
    for (int a = 0; a < contacts.size(); ++a) {
      command += fmt::format(" {:.17g}", contacts.material(a).*value);
    }
    return command + '\n';
  };
  const auto of_pairs = [&](const char* name, double PairCoefficients::*value) {
    std::string command =
        fmt::format("fix {0} all property/global {0} peratomtypepair {1}", name, contacts.size());
    for (int a = 0; a < contacts.size(); ++a) {
      for (int b = 0; b < contacts.size(); ++b) {
        command += fmt::format(" {:.17g}", contacts.pair(a, b).*value);
      }
    }
    return command + '\n';
  };
  return of_materials("youngsModulus", &Material::young_modulus_pa) +
         of_materials("poissonsRatio", &Material::poisson_ratio) +
         of_pairs("coefficientRestitution", &PairCoefficients::restitution) +
         of_pairs("coefficientFriction", &PairCoefficients::sliding_friction) +
         of_pairs("coefficientRollingFriction", &PairCoefficients::rolling_friction);
}

std::string model_of(dem::RollingModel rolling) {
  const std::string model = "model hertz tangential history";
  if (rolling == dem::RollingModel::none) return model;
  if (rolling == dem::RollingModel::relative_constant_torque)
    return model + " rolling_friction cdt";
  throw std::invalid_argument("deck: LIGGGHTS does not have this definition of rolling friction");
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
    throw std::invalid_argument("deck: a wall is no plane across an axis and no tube");
  }
  return fmt::format("{}plane {:.17g}", "xyz"[axis], wall.pose.position[axis]);
}

}  // namespace

bool has_liggghts() {
  // It knows no option that only tells its version: an empty deck ends at once.
  return run_program("liggghts", {}, {"-in", "/dev/null", "-log", "none"}).exit_code == 0;
}

std::string gravity_command(const Vector& gravity) {
  return fmt::format("fix gravity all gravity {:.17g} vector {:.17g} {:.17g} {:.17g}\n",
                     gravity.norm(), gravity.x(), gravity.y(), gravity.z());
}

std::string deck_of(const dem::SimulationSetup& setup, const DeckOptions& options) {
  const std::string model = model_of(setup.contacts.rolling());
  std::string deck = fmt::format(
      "atom_style granular\natom_modify map array sort 0 0\nboundary f f f\nnewton off\n"
      "communicate single vel yes\nunits si\nhard_particles yes\n{}\n"
      "neighbor {:.17g} bin\nneigh_modify delay 0\n{}"
      "pair_style gran {} {}\npair_coeff * *\ntimestep {:.17g}\n{}",
      options.start, options.skin_m, property_commands(setup.contacts), model,
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
    const double diameter = 2 * kind.shape.spheres.at(0).radius;
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
      "dump frames all custom {} frames.txt id x y z vx vy vz omegax omegay omegaz\n"
      "dump_modify frames sort id format \"%d %.14g %.14g %.14g %.14g %.14g %.14g %.14g %.14g "
      "%.14g\"\n",
      every_steps);
}

std::vector<std::vector<dem::Grain>> frames_of(const std::filesystem::path& folder) {
  std::ifstream file(folder / "frames.txt");
  std::vector<std::vector<dem::Grain>> frames;
  std::string line;
  bool is_table = false;
  while (std::getline(file, line)) {
    if (line.starts_with("ITEM: ")) {
      is_table = line.starts_with("ITEM: ATOMS");
      if (is_table) frames.emplace_back();
    } else if (is_table) {
      std::istringstream words(line);
      int id = 0;
      dem::Grain grain;
      words >> id;
      for (Vector* each : {&grain.position, &grain.velocity, &grain.spin}) {
        words >> each->x() >> each->y() >> each->z();
      }
      if (!words) throw std::runtime_error("LIGGGHTS wrote a line that cannot be read: " + line);
      frames.back().push_back(grain);
    }
  }
  return frames;
}

Finished run_liggghts(const TemporaryFolder& folder, const std::string& deck) {
  folder.write("deck.txt", deck);
  Finished finished = run_program("liggghts", folder, {"-in", "deck.txt", "-log", "none"});
  if (finished.exit_code != 0) {
    constexpr std::size_t kShown = 600;
    const std::size_t size = finished.out.size();
    throw std::runtime_error(
        "LIGGGHTS failed: " + finished.out.substr(size - std::min(size, kShown)) + finished.err);
  }
  return finished;
}

}  // namespace repose::testing
