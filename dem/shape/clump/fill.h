#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "dem/shape/clump/clump_errors.h"
#include "dem/shape/clump/clump_shape.h"
#include "dem/shape/scan/mesh.h"

namespace repose::dem {

/// Up to `count` spheres inside a watertight surface, each the one that adds most volume to those
/// before it. The classical way to fill a grain, which leaves its corners and tips empty: fill()
/// starts from it and improves on it.
/// Source: greedy cover with lazy evaluation, Minoux, Accelerated greedy algorithms for maximizing
/// submodular set functions (1978); candidates are centred on the points of a grid.
std::vector<ClumpSphere> inscribed_spheres(const Mesh& mesh, int count);

inline constexpr int kMaxSpheres = 200;

/// How a body is filled with spheres.
struct FillOptions {
  /// More spheres follow the surface closer, and every contact search costs more.
  int spheres = 11;
  /// When set, the fewest spheres found with at most this volume error are taken instead (see
  /// ClumpErrors::volume_error). Halving it takes three to four times the spheres.
  std::optional<double> volume_error = std::nullopt;
  /// Smallest radius, as a fraction of that of the sphere of equal volume. Smaller ones follow tips
  /// and edges closer, and the simulation's time step shrinks in proportion.
  double smallest_radius_fraction = 0.1;

  /// Empty when usable. Otherwise one line per problem.
  std::vector<base::Fault> problems() const;
};

/// The spheres and how well they stand for the body.
struct FillReport {
  std::vector<ClumpSphere> spheres;
  ClumpErrors errors;
};

/// Fills a watertight surface with spheres that together follow its surface as closely as their
/// number allows: they may stick out a little. One sphere is the one of equal volume about the
/// centre of mass. Several start inscribed, are fitted to the surface, and then, one at a time,
/// those that matter least are moved to where the error is largest, as long as that helps. The same
/// mesh gives the same spheres.
/// @throws base::InputError  the options are not usable, the volume error cannot be reached,
/// or so few spheres do not hang together or do not follow the surface.
FillReport fill(const Mesh& mesh, const FillOptions& options);

/// A grain of the engine: mass properties of the surface, spheres to touch with.
struct FilledClump {
  ClumpShape shape;
  ClumpErrors errors;
};

/// Moves a watertight surface into its principal frame and fills it there.
FilledClump clump_of(const Mesh& surface, const FillOptions& options);

}  // namespace repose::dem
