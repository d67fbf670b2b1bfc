#pragma once

#include <optional>
#include <string>

#include <fmt/format.h>

namespace repose::bench {

/// Fraction of hits among the cases that have an answer.
struct Share {
  int hits = 0;
  int all = 0;

  void add(std::optional<bool> hit) {
    if (!hit) return;
    ++all;
    hits += *hit ? 1 : 0;
  }

  std::string percent() const { return all == 0 ? "-" : fmt::format("{:.0f}", 100.0 * hits / all); }
};

}  // namespace repose::bench
