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
  double density_kg_m3 = 0;  ///< > 0; no effect on walls
  double young_modulus_pa = 0;
  double poisson_ratio = 0;  ///< 0 <= nu < .5
};

/// How the torque that resists rolling is defined. The coefficient's meaning differs between
/// models.
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

/// How simultaneous contacts between the same two bodies are damped.
enum class DampingModel {
  /// Each as if alone, with the whole reduced mass: the more spheres of a clump touch, the less it
  /// rebounds.
  per_contact,
  /// Each with its share of the reduced mass, so that together they rebound like a single contact.
  shared,
};

/// Lowest restitution of impacts; lower ones are indistinguishable from 0.
inline constexpr double kMinRestitution = .01;
/// Limit if restitution depends on impact speed: without it slow impacts would create energy.
inline constexpr double kMaxRestitutionBySpeed = .99;
/// Limit of the speed exponent: a fully plastic contact has e ~ v^(-1/4) (Johnson 1985, Contact
/// Mechanics, eq. 11.47), others less.
inline constexpr double kMaxRestitutionExponent = .25;

/// Contact coefficients between two materials.
struct PairCoefficients {
  double restitution = 1;       ///< .01 ... 1: speed ratio of a central impact of two spheres
  double sliding_friction = 0;  ///< >= 0
  double rolling_friction = 0;  ///< >= 0
  /// 0: restitution is the same at all speeds. Otherwise, up to kMaxRestitutionExponent:
  /// restitution holds at restitution_speed_m_s, and at other speeds as restitution_at() gives.
  double restitution_exponent = 0;
  double restitution_speed_m_s = 0;
};

/// Parts of an apparatus that may be of another material than its plate.
enum class WallPart {
  tube,     ///< of a heap or a fill
  incline,  ///< of a roll, down to the plate
  pane      ///< the upright walls of a draw-down's boxes
};

/// Their names in files: [wall.tube], [contact.particle_tube].
inline constexpr std::array<std::pair<WallPart, std::string_view>, 3> kWallParts = {
    {{WallPart::tube, "tube"}, {WallPart::incline, "incline"}, {WallPart::pane, "pane"}}};

inline std::string name_of(WallPart part) {
  return std::string(kWallParts[static_cast<std::size_t>(part)].second);
}

/// Material of such a part, and its coefficients with grains.
struct WallSurface {
  Material material;
  PairCoefficients with_grain;
};

/// The parts whose material is not that of the plate.
using WallSurfaces = std::map<WallPart, WallSurface>;

}  // namespace repose::dem
