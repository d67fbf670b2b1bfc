#include "dem/experiment/course.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

namespace repose::dem {

Course::Course(Simulation simulation, const ProgressReport& report, Work before)
    : simulation_(std::move(simulation)), report_(report), work_(before) {}

std::int64_t Course::steps_of(double duration_s) const {
  const double steps = std::ceil(duration_s / simulation_.setup().timestep_s);
  return static_cast<std::int64_t>(std::max(1.0, steps));
}

void Course::advance(std::int64_t steps) {
  int present = 0;
  for (int k = 0; k < simulation_.grain_count(); ++k) present += simulation_.is_present(k) ? 1 : 0;
  simulation_.advance(steps);
  work_.steps += steps;
  work_.clump_steps += static_cast<double>(present) * static_cast<double>(steps);
}

void Course::tell(double share) const {
  if (!report_ || report_(std::clamp(share, 0.0, 1.0), simulation_)) return;
  throw Interrupted(fmt::format("interrupted at {:.4f} s of the experiment", simulation_.time_s()));
}

Repeat Course::finish(double value, std::uint64_t seed, std::map<std::string, double> readings) {
  const double timestep_s = simulation_.setup().timestep_s;
  return {.value = value,
          .seed = seed,
          .steps = work_.steps,
          .timestep_s = timestep_s,
          .clump_steps = work_.clump_steps,
          .readings = std::move(readings),
          .state = std::make_shared<const Simulation>(std::move(simulation_))};
}

}  // namespace repose::dem
