#pragma once

#include <string>
#include <vector>

#include "calibrate/export/export.h"
#include "dem/experiment/drop.h"
#include "dem/experiment/experiment_table.h"
#include "dem/experiment/heap.h"
#include "dem/experiment/roll.h"
#include "dem/experiment/tilt.h"
#include "dem/study/study.h"
#include "tests/dem/experiment_model.h"

// A study to export, and access to the files of the export.
namespace repose::calibrate::test {

inline constexpr const char* kWallRolling = "contact.particle_wall.rolling_friction";

/// Nuts that are dropped, tilted, rolled and heaped.
inline dem::Study hazelnuts(
    dem::RollingModel rolling = dem::RollingModel::relative_constant_torque) {
  dem::Study study;
  study.model = dem::test::clump_bench();
  study.model.rolling = rolling;
  study.experiments[dem::experiment_of<dem::DropProtocol>()].protocol = dem::DropProtocol{};
  study.experiments[dem::experiment_of<dem::TiltProtocol>()].protocol = dem::TiltProtocol{};
  study.experiments[dem::experiment_of<dem::RollProtocol>()].protocol = dem::RollProtocol{};
  study.experiments[dem::experiment_of<dem::HeapProtocol>()].protocol = dem::HeapProtocol{};
  study.experiments[dem::experiment_of<dem::HeapProtocol>()].stiffness_factor = .01;
  return study;
}

inline StudyExport exported(const dem::Study& study, ExportTarget target, bool approximate = true) {
  return export_study(study, study.model.grain, {},
                      {.target = target, .takes_approximate = approximate});
}

/// Empty if there is no such file.
inline std::string file_text(const StudyExport& made, const std::string& name) {
  for (const ExportedFile& file : made.files) {
    if (file.name == name) return file.text;
  }
  return "";
}

inline std::vector<std::string> names_of(const StudyExport& made) {
  std::vector<std::string> names;
  for (const ExportedFile& file : made.files) names.push_back(file.name);
  return names;
}

}  // namespace repose::calibrate::test
