#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace repose::dem {

/// What a grain or a wall is made of.
struct Material {
  std::string name;
  double density_kg_m3 = 0;  ///< > 0; of no effect on walls
  double young_modulus_pa = 0;
  double poisson_ratio = 0;  ///< 0 <= nu < .5
};

/// How the torque that resists rolling is defined. The coefficient means something else in each.
enum class RollingModel {
  none,
  /// EDEM's standard rolling friction: on each body, mu_r F_n times its own distance from the
  /// centre of mass to the contact, against its own spin.
  constant_torque,
  /// LIGGGHTS's `cdt`: mu_r F_n times the reduced radius, against the relative spin.
  relative_constant_torque,
  /// Rolling spring with a plastic limit (EPSD): comes to rest.
  elastic_plastic,
};

/// How the contacts damp that two bodies have with each other at the same time.
enum class DampingModel {
  /// Each as if it were alone, with the whole reduced mass: the more spheres of a clump touch, the
  /// less it rebounds.
  per_contact,
  /// Each with its share of the reduced mass, so that all together rebound as one would.
  shared,
};

/// Of impacts; textbook restitutions below that cannot be told from 0.
inline constexpr double kMinRestitution = .01;
/// Where restitution depends on the speed of impact: slow ones would make energy without a limit.
inline constexpr double kMaxRestitutionBySpeed = .99;
/// Of the speed: a contact that yields all over has e ~ v^(-1/4) (Johnson 1985, Contact Mechanics,
/// eq. 11.47), others less.
inline constexpr double kMaxRestitutionExponent = .25;

/// What two materials do to each other.
struct PairCoefficients {
  double restitution = 1;       ///< .01 ... 1: what comes out of a central impact of two spheres
  double sliding_friction = 0;  ///< >= 0
  double rolling_friction = 0;  ///< >= 0
  /// 0: restitution is the same at all speeds. Else, 0 ... kMaxRestitutionExponent, it is that of
  /// an impact at restitution_speed_m_s, and of others as speed_damping.h says.
  double restitution_exponent = 0;
  double restitution_speed_m_s = 0;
};

/// Parts of a bench that may be of another material than its plate.
enum class WallPart {
  tube,     ///< of a heap, of a fill
  incline,  ///< of a roll, down to the plate
  pane      ///< the upright walls of a draw-down's boxes
};

/// What files call them: [wall.tube], [contact.particle_tube].
inline constexpr std::array<std::pair<WallPart, std::string_view>, 3> kWallParts = {
    {{WallPart::tube, "tube"}, {WallPart::incline, "incline"}, {WallPart::pane, "pane"}}};

inline std::string name_of(WallPart part) {
  return std::string(kWallParts[static_cast<std::size_t>(part)].second);
}

/// What such a part is made of, and what it does to grains.
struct WallSurface {
  Material material;
  PairCoefficients with_grain;
};

/// The parts whose material is not that of the plate.
using WallSurfaces = std::map<WallPart, WallSurface>;

}  // namespace repose::dem
