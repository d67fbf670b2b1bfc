#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "tests/support/canvas.h"
#include "vision/picture/picture.h"

/// Pictures without a heap, as people might measure by mistake.
namespace repose::testing {

struct OtherKind {
  std::string_view name;
  void (*draw)(Canvas& canvas, Random& random);
};

/// All kinds, in the order of reports.
std::span<const OtherKind> other_kinds();

/// The same kind and seed give the same picture.
vision::Picture draw_other(const OtherKind& kind, std::uint64_t seed);

}  // namespace repose::testing
