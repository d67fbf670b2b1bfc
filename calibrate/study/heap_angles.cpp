#include "calibrate/study/heap_angles.h"

#include <map>

#include "base/angle_definition.h"
#include "calibrate/experiment/run_result.h"

namespace repose::calibrate {

NamedAngles heap_angles_deg(const StudyContext& context, const std::vector<Run>& runs) {
  std::map<std::string, std::vector<double>> angles;
  std::size_t heaps = 0;
  for (const Run& run : runs) {
    if (!run.failure.empty()) continue;
    const auto saved = context.folder.find(context.simulator.spec(run.job), run.job.seed);
    if (!saved) continue;
    const auto values = values_by_definition(*saved);
    heaps += values.empty() ? 0 : 1;
    for (const auto& [name, value] : values) angles[name].push_back(value);
  }
  NamedAngles means;
  for (const base::AngleDefinition& definition : base::kAngleDefinitions) {
    const auto found = angles.find(std::string(definition.name));
    if (found == angles.end() || found->second.size() < heaps) continue;
    means.emplace_back(definition.name, summarise(found->second).mean);
  }
  return means;
}

}  // namespace repose::calibrate
