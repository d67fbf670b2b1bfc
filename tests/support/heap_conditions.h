#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "tests/support/heap_scene.h"

namespace repose::testing {

enum class Group {
  clean,           ///< well-lit pictures
  degraded,        ///< one defect each, as in laboratory practice
  hollow,          ///< flanks that are not straight, or made of few grains
  sample,          ///< the hazelnut pictures
  misplaced,       ///< the camera stands where the instructions forbid it
  not_measurable,  ///< no angle exists: a measurement must be refused
};

struct Condition {
  std::string_view name;
  Group group;
  HeapScene (*scene)(std::uint64_t seed);
};

/// All conditions, in the order of reports.
std::span<const Condition> conditions();

/// @throws std::invalid_argument  no condition has this name.
const Condition& condition_named(std::string_view name);

/// Heaps of 18 mm hazelnuts from a 100 x 400 mm cylinder: few large grains, means of 23.38 +- 0.72
/// degrees.
HeapScene hazelnut_scene(std::uint64_t seed);

}  // namespace repose::testing
