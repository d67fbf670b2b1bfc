#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "dem/shape/clump/clump_errors.h"
#include "dem/shape/clump/clump_shape.h"
#include "dem/shape/scan/mesh.h"

namespace repose::dem {

/// Up to `count` spheres inside a watertight surface, each chosen to add the most volume to the
/// previous ones. The classical method, which leaves corners and tips empty: fill() starts from it
/// and improves on it. Source: greedy cover with lazy evaluation, Minoux, Accelerated greedy
/// algorithms for maximizing submodular set functions (1978); candidates are centred on the points
/// of a grid.
std::vector<ClumpSphere> inscribed_spheres(const Mesh& mesh, int count);

inline constexpr int kMaxSpheres = 200;

/// How a body is filled with spheres.
struct FillOptions {
  /// More spheres follow the surface more closely but make every contact search more expensive.
  int spheres = 11;
  /// If set, the fewest spheres found with at most this volume error are used instead (see
  /// ClumpErrors::volume_error). Halving it takes three to four times as many spheres.
  std::optional<double> volume_error = std::nullopt;
  /// Smallest radius, as a fraction of that of the sphere of equal volume. Smaller ones follow tips
  /// and edges more closely but shorten the simulation's time step in proportion.
  double smallest_radius_fraction = 0.1;

  /// Empty if usable. Otherwise one line per problem.
  std::vector<base::Fault> problems() const;
};

/// The spheres and how well they represent the body.
struct FillReport {
  std::vector<ClumpSphere> spheres;
  ClumpErrors errors;
};

/// Fills a watertight surface with spheres that together follow its surface as closely as their
/// number allows: they may stick out a little. A single sphere has equal volume and is centred at
/// the centre of mass. Several start inscribed, are fitted to the surface, and then the least
/// useful ones are moved, one at a time, to where the error is largest, as long as that helps.
/// Deterministic.
/// @throws base::InputError  the options are not usable, the volume error cannot be reached, or so
/// few spheres are disconnected or do not follow the surface.
FillReport fill(const Mesh& mesh, const FillOptions& options);

/// A grain for the engine: mass properties of the surface, spheres for contacts.
struct FilledClump {
  ClumpShape shape;
  ClumpErrors errors;
};

/// Moves a watertight surface into its principal frame and fills it there.
FilledClump clump_of(const Mesh& surface, const FillOptions& options);

}  // namespace repose::dem
