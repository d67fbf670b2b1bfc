// The cases of `repose verify` in LIGGGHTS: a deck for each scene, recorded at every step.

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "calibrate/simulators/case_peers.h"
#include "calibrate/simulators/liggghts_scene.h"
#include "calibrate/simulators/program_simulator.h"

namespace repose::calibrate {
namespace {

using dem::Grain;
using dem::SimulationSetup;
using dem::Vector;
using Frames = std::vector<std::vector<FrameGrain>>;

constexpr const char* kGrainsFile = "grains.txt";

double radius_of(const SimulationSetup& setup, const Grain& grain) {
  return setup.kinds[static_cast<std::size_t>(grain.kind)].shape.spheres[0].radius;
}

double mass_of(const SimulationSetup& setup, const Grain& grain) {
  const dem::GrainKind& kind = setup.kinds[static_cast<std::size_t>(grain.kind)];
  return setup.contacts.material(kind.material).density_kg_m3 * kind.shape.volume_m3;
}

/// A grain rotated about the origin.
Grain turned(const Grain& grain, const dem::Quaternion& turn) {
  Grain other = grain;
  other.position = turn * grain.position;
  other.velocity = turn * grain.velocity;
  other.spin = turn * grain.spin;
  return other;
}

/// A scene with at most one plane, rotated so that it is z = 0: LIGGGHTS only has planes normal to
/// the axes.
struct LevelScene {
  SimulationSetup setup;
  std::vector<Grain> grains;
  dem::Quaternion turn_back = dem::Quaternion::Identity();

  LevelScene(SimulationSetup given, const std::vector<Grain>& all) : setup(std::move(given)) {
    if (setup.walls.size() == 1 && std::holds_alternative<dem::Plane>(setup.walls[0].shape) &&
        setup.walls[0].pose.position.isZero()) {
      turn_back = setup.walls[0].pose.orientation;
      setup.walls[0].pose.orientation = dem::Quaternion::Identity();
      setup.gravity = turn_back.conjugate() * setup.gravity;
    }
    for (const Grain& grain : all) grains.push_back(turned(grain, turn_back.conjugate()));
  }
};

/// Duration of an elastic Hertz impact of two bodies, Johnson (1985), eq. 11.24: T = 2.87 (m^2 / (R
/// E*^2 v))^(1/5).
double hertz_duration_s(const SimulationSetup& setup, const dem::Meeting& grains) {
  const Grain& one = grains[0];
  const bool is_pair = grains.size() > 1;
  double per_mass = 1 / mass_of(setup, one);
  double per_radius = 1 / radius_of(setup, one);
  double speed = -one.velocity.z();
  int other_material = setup.walls.empty() ? 0 : setup.walls[0].material;
  if (is_pair) {
    const Grain& other = grains[1];
    per_mass += 1 / mass_of(setup, other);
    per_radius += 1 / radius_of(setup, other);
    speed += other.velocity.z();
    other_material = setup.kinds[static_cast<std::size_t>(other.kind)].material;
  }
  const int material = setup.kinds[static_cast<std::size_t>(one.kind)].material;
  const double young = setup.contacts.law(material, other_material).reduced_young_pa;
  return 2.87 * std::pow(per_radius / (per_mass * per_mass * young * young * speed), .2);
}

/// The collision of the grains from `first` on, one meeting among several: one frame per step.
/// @return  std::nullopt: they still touch in the last frame
std::optional<dem::Collision> collision_in(const Frames& frames, const SimulationSetup& setup,
                                           std::size_t first, const dem::Meeting& meeting) {
  constexpr std::size_t kFew = 4;  // as in our own engine
  // Numbers in the file have 14 digits: differences this small are not overlaps.
  constexpr double kRounding = 1e-12;
  dem::CollisionSamples samples{.timestep_s = setup.timestep_s, .overlaps_m = {0}, .pushes_n = {0}};
  const bool is_pair = meeting.size() > 1;
  const double radius = radius_of(setup, meeting[0]);
  for (std::size_t k = 1; k < frames.size(); ++k) {
    const FrameGrain& ball = frames[k].at(first);
    const double gap = is_pair ? (ball.position - frames[k].at(first + 1).position).norm() -
                                     radius - radius_of(setup, meeting[1])
                               : ball.position.z() - radius;
    samples.overlaps_m.push_back(gap < -kRounding * radius ? -gap : 0);
    samples.pushes_n.push_back(ball.force.z());
    if (samples.overlaps_m.back() > 0 || samples.overlaps_m.size() < kFew) continue;
    return dem::collision_of(samples, ball, is_pair ? Grain(frames[k][first + 1]) : Grain{});
  }
  return std::nullopt;
}

/// All meetings in one scene, far enough apart not to interact.
std::vector<Grain> side_by_side(const SimulationSetup& setup,
                                const std::vector<dem::Meeting>& meetings, double duration_s) {
  double apart_m = 0;
  for (const dem::Meeting& meeting : meetings) {
    for (const Grain& grain : meeting) {
      apart_m =
          std::max(apart_m, 4 * (radius_of(setup, grain) + grain.velocity.norm() * duration_s));
    }
  }
  std::vector<Grain> all;
  for (std::size_t k = 0; k < meetings.size(); ++k) {
    for (Grain grain : meetings[k]) {
      grain.position.y() += static_cast<double>(k) * apart_m;
      all.push_back(grain);
    }
  }
  return all;
}

class LiggghtsCases : public dem::CasePeer {
 public:
  explicit LiggghtsCases(std::string version) : version_(std::move(version)) {}

  std::string title() const override { return version_; }
  std::string changes_to(const SimulationSetup& setup) const override {
    return changed_restitutions(setup.contacts);
  }

  std::vector<dem::Collision> collide_each(
      const SimulationSetup& setup, const std::vector<dem::Meeting>& meetings) const override {
    constexpr double kLongest =
        64;  // damped impacts take longer than elastic ones, but by far less
    double touching_s = 0;
    for (const dem::Meeting& meeting : meetings) {
      touching_s = std::max(touching_s, hertz_duration_s(setup, meeting));
    }
    for (double longer = 2; longer <= kLongest; longer *= 2) {
      const double duration_s = longer * touching_s;
      const int steps = static_cast<int>(duration_s / setup.timestep_s) + 2;
      const Frames frames = run({setup, side_by_side(setup, meetings, duration_s)}, steps, 1);
      std::vector<dem::Collision> collisions;
      std::size_t first = 0;
      for (const dem::Meeting& meeting : meetings) {
        const auto collision = collision_in(frames, setup, first, meeting);
        if (!collision) break;
        collisions.push_back(*collision);
        first += meeting.size();
      }
      if (collisions.size() == meetings.size()) return collisions;
    }
    throw base::InputError(
        {.where = title(),
         .value = fmt::format("two bodies touch for more than {:g} times as long "
                              "as in an elastic impact",
                              kLongest)});
  }

  dem::Path follow(const SimulationSetup& setup, const std::vector<Grain>& grains,
                   double duration_s, int every_steps) const override {
    const LevelScene scene(setup, grains);
    const double frame_s = every_steps * setup.timestep_s;
    const int count = static_cast<int>(std::ceil(duration_s / frame_s));
    dem::Path path;
    for (const auto& frame : run(scene, count * every_steps, every_steps)) {
      path.push_back({.time_s = static_cast<double>(path.size()) * frame_s,
                      .grain = turned(frame.at(0), scene.turn_back)});
    }
    return path;
  }

 private:
  Frames run(const LevelScene& scene, int steps, int every_steps) const {
    if (scene.setup.contacts.damping() != dem::DampingModel::per_contact) {
      throw dem::CannotRun("LIGGGHTS has no shared damping");
    }
    // The largest possible travel, plus the grains' own size.
    const double duration_s = steps * scene.setup.timestep_s;
    double room = .5 * scene.setup.gravity.norm() * duration_s * duration_s;
    for (const Grain& grain : scene.grains) {
      room = std::max(room, room + grain.velocity.norm() * duration_s);
      room += 4 * radius_of(scene.setup, grain);
    }
    WorkFolder folder;
    base::write_whole_file(folder.path() / kGrainsFile,
                           data_of(scene.setup, scene.grains, Vector::Constant(room)));
    const DeckOptions options{.start = fmt::format("read_data {}", kGrainsFile),
                              .skin_m = .1 * radius_of(scene.setup, scene.grains[0]),
                              .search = "nsq"};
    base::write_whole_file(folder.path() / "deck.txt",
                           deck_of(scene.setup, options) + dump_command(every_steps) +
                               fmt::format("thermo {0}\nrun {0}\n", steps));
    run_to_end(
        {.words = {kLiggghts, "-in", "deck.txt", "-log", "none"}, .folder = {}, .output = {}},
        folder, {.title = title(), .timeout_s = std::nullopt});
    Frames frames = frames_of(folder.path());
    const auto expected = static_cast<std::size_t>(steps / every_steps) + 1;
    if (frames.size() != expected || frames.back().size() != scene.grains.size()) {
      folder.keep();
      base::refuse(folder.path(),
                   fmt::format("has {} frames of {}, or lost a grain", frames.size(), expected),
                   "start it again in that folder to look into it.");
    }
    return frames;
  }

  std::string version_;
};

}  // namespace

std::unique_ptr<const dem::CasePeer> liggghts_cases() {
  base::Faults faults;
  std::string version = installed_liggghts(faults);
  faults.throw_if_any();
  return std::make_unique<const LiggghtsCases>(std::move(version));
}

}  // namespace repose::calibrate
