#include "base/closest_word.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace repose::base {
namespace {

/// Levenshtein's distance: letters to insert, remove or replace.
std::size_t distance(std::string_view from, std::string_view to) {
  std::vector<std::size_t> row(to.size() + 1);  // distances of from's beginning to to's beginnings
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < from.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < to.size(); ++j) {
      const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

}  // namespace

std::string closest_word(std::string_view mistyped, std::span<const std::string> known) {
  const std::size_t most = std::max<std::size_t>(1, mistyped.size() / 3);
  std::size_t least = most + 1;
  std::string best;
  for (const std::string& word : known) {
    const std::size_t steps = distance(mistyped, word);
    if (steps >= least) continue;
    least = steps;
    best = word;
  }
  return best;
}

}  // namespace repose::base
