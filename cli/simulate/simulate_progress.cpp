#include "cli/simulate/simulate_progress.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

namespace repose::cli {

void RepeatsProgress::report(std::size_t repeat, double fraction) {
  if (!line_.is_shown()) return;
  const std::lock_guard lock(mutex_);
  fractions_[repeat] = std::clamp(fraction, 0., 1.);
  const std::size_t repeats = fractions_.size();
  const double done =
      std::accumulate(fractions_.begin(), fractions_.end(), 0.) / static_cast<double>(repeats);
  line_.report(fmt::format("simulated {:.0f} % of {} {}", 100 * done, repeats,
                           repeats == 1 ? "repeat" : "repeats"),
               done);
}

}  // namespace repose::cli
