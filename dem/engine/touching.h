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
/// spheres touch. Small: of many grains these do not stay in the caches from step to step.
struct TouchingPair {
  int a = 0;  ///< a body
  int b = 0;  ///< a body, or a wall
  const ContactLaw* law = nullptr;
  int number = 0;           ///< among the pairs that are worked on together
  int touching = 0;         ///< how many spheres
  double reduced_mass = 0;  ///< of both bodies, kg
  double damper_limit = 0;  ///< see damper_limit(), N s/m
};

/// A sphere of body a that touches something: numbers.
struct Touching {
  int sphere = 0;
  int other = 0;   ///< a sphere of body b, or a facet of a wall
  int memory = 0;  ///< its ContactMemory
  int pair = 0;    ///< its TouchingPair
};

/// The contacts of up to kPairsTogether pairs of grains.
struct TouchingChunk {
  bool is_known = false;  ///< false: what follows is to be looked up
  std::vector<TouchingPair> pairs;
  std::vector<Touching> contacts;
};

}  // namespace repose::dem
