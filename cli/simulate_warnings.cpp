#include "cli/simulate_warnings.h"

#include <fmt/format.h>

namespace repose::cli {
namespace {

double reading_of(const Run& run, const std::string& name, double otherwise) {
  const auto found = run.repeat.readings.find(name);
  return found == run.repeat.readings.end() ? otherwise : found->second;
}

}  // namespace

std::vector<RunWarning> warnings_of(const SimulatePlan& plan, const std::vector<Run>& runs) {
  std::vector<RunWarning> warnings;
  for (const Run& run : runs) {
    const std::uint64_t seed = run.repeat.seed;
    if (plan.experiment == dem::Experiment::heap) {
      if (reading_of(run, "no_heap", 0) != 0) {
        warnings.push_back(
            {"no_heap", seed, "the grains spread in a layer; its angle is no angle of repose."});
      }
      if (reading_of(run, "at_rest", 1) == 0) {
        warnings.push_back({"not_at_rest", seed, "grains were still moving when the time was up."});
      }
    }
    const double never_rose = reading_of(run, "never_rose", 0);
    if (plan.experiment == dem::Experiment::drop && never_rose > 0) {
      warnings.push_back(
          {"never_rose", seed,
           fmt::format("{:g} of {} grains did not rise again; they count as 0 in the mean.",
                       never_rose, plan.study.drop->grains)});
    }
  }
  return warnings;
}

}  // namespace repose::cli
