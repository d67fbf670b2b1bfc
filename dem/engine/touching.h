#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dem/contact/contact_table.h"
#include "dem/engine/bodies.h"
#include "dem/engine/contact_force.h"

/// Who touches whom: looked up when the first sphere of a pair touches or parts, and kept until the
/// next one does.
namespace repose::dem {

/// Pairs of grains worked on together: few enough for their loads to stay in the nearest cache.
inline constexpr std::size_t kPairsTogether = 64;

/// What all contacts of a pair of grains, or of a grain and a wall, share for as long as the same
/// spheres touch. Rows are all 0 but their w: they are added to rows of vectors.
struct TouchingPair {
  const BodyMotion* a = nullptr;
  const BodyMotion* b = nullptr;
  const Row* position_a = nullptr;
  const Row* position_b = nullptr;
  const double* touching_a = nullptr;  ///< of all that body a touched at the last step
  const double* touching_b = nullptr;  ///< none: a wall
  const ContactLaw* law = nullptr;
  std::size_t number = 0;    ///< among the pairs that are worked on together
  double touching = 0;       ///< how many spheres
  Row reduced_mass = {};     ///< w: of both bodies, kg
  Row damper_limit = {};     ///< w: see damper_limit(), N s/m
  Row reduced_inertia = {};  ///< w: of both bodies about their centres, kg m^2
};

/// A sphere of body a that touches the Other: a PlacedSphere of body b, or the FacetContact of a
/// wall.
template <typename Other>
struct Touching {
  const PlacedSphere* sphere = nullptr;
  const Other* other = nullptr;
  ContactMemory* memory = nullptr;
  std::size_t pair = 0;  ///< number of its TouchingPair
};

/// The contacts of up to kPairsTogether pairs of grains.
struct TouchingChunk {
  bool is_known = false;  ///< false: what follows is to be looked up
  std::vector<TouchingPair> pairs;
  std::vector<Touching<PlacedSphere>> contacts;
};

}  // namespace repose::dem
