#include "calibrate/plan/smallest_set.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace repose::calibrate {
namespace {

constexpr double kNearlyWhole = .97;

/// Of two sets the better one has the higher score; narrow intervals decide among equals.
struct Score {
  double determined = 0;
  double narrow = 0;

  auto operator<=>(const Score&) const = default;
};

Score score_of(const Outlook& outlook) {
  Score score;
  for (const double part : outlook.determined) score.determined += std::min(part, kEnough);
  for (const double width : outlook.widths) score.narrow += 1 - width;
  return score;
}

std::vector<std::size_t> to_be_done(const Foresight& foresight) {
  std::vector<std::size_t> places;
  const std::vector<Prospect>& prospects = foresight.prospects();
  for (std::size_t i = 0; i < prospects.size(); ++i) {
    if (!prospects[i].is_measured && prospects[i].is_known) places.push_back(i);
  }
  return places;
}

/// Those of `places` whose bits are set.
std::vector<std::size_t> chosen(const std::vector<std::size_t>& places, unsigned bits) {
  std::vector<std::size_t> set;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if ((bits >> i & 1U) != 0) set.push_back(places[i]);
  }
  return set;
}

std::vector<std::size_t> best_set(const Foresight& foresight,
                                  const std::vector<std::size_t>& places) {
  const double enough = kNearlyWhole * score_of(foresight.with(places)).determined;
  std::vector<std::size_t> best = places;
  Score best_score = score_of(foresight.with(places));
  for (unsigned bits = 0; bits < 1U << places.size(); ++bits) {
    if (static_cast<std::size_t>(std::popcount(bits)) > best.size()) continue;
    const std::vector<std::size_t> set = chosen(places, bits);
    const Score score = score_of(foresight.with(set));
    if (score.determined < enough) continue;
    if (set.size() == best.size() && score.narrow <= best_score.narrow) continue;
    best = set;
    best_score = score;
  }
  return best;
}

}  // namespace

std::vector<PlannedStep> smallest_set(const Foresight& foresight) {
  std::vector<std::size_t> left = best_set(foresight, to_be_done(foresight));
  std::vector<std::size_t> done;
  std::vector<PlannedStep> steps;
  while (!left.empty()) {
    const auto score_with = [&](std::size_t next) {
      std::vector<std::size_t> set = done;
      set.push_back(next);
      return score_of(foresight.with(set));
    };
    const auto next = std::max_element(
        left.begin(), left.end(), [&](auto a, auto b) { return score_with(a) < score_with(b); });
    done.push_back(*next);
    left.erase(next);
    steps.push_back({done.back(), foresight.with(done)});
  }
  return steps;
}

}  // namespace repose::calibrate
