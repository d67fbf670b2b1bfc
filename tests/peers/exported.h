#pragma once

#include <string>
#include <vector>

#include "calibrate/export/export.h"
#include "dem/study/study.h"
#include "tests/support/run_program.h"

/// Exported studies, run by the programs they were exported for.
namespace repose::testing {

/// Soft grains on a stiffer wall, short distances: a run takes seconds in every program.
dem::Study short_study(dem::RollingModel rolling, double restitution = .5);

/// Readings of a study's experiments: rebound (mm), angle of the plate after half a millimetre of
/// slip (degrees), distance along the flat (mm).
struct Readings {
  double drop_mm = 0;
  double tilt_deg = 0;
  double roll_mm = 0;
};

Readings our_readings(const dem::Study& study, const dem::ClumpShape& grain);

/// Runs the export in its program. Throws std::runtime_error with the end of its output if it fails
/// or gives no reading.
Readings readings_of(const dem::Study& study, const dem::ClumpShape& grain,
                     calibrate::ExportTarget target);

/// Runs the exported deck of one experiment, with additional program arguments, and returns the
/// reading it prints. Throws as above.
double reading_of(const dem::Study& study, const dem::ClumpShape& grain,
                  calibrate::ExportTarget target, const std::string& deck, const std::string& name,
                  const std::vector<std::string>& arguments = {});

/// Runs a deck in the folder, with additional program arguments. Throws as above.
Finished run_deck(const TemporaryFolder& folder, calibrate::ExportTarget target,
                  const std::string& deck, const std::vector<std::string>& arguments = {});

/// Mean rebound in the exported drop or drop_on_grains. Throws as above.
double rebound_mm_of(const dem::Study& study, const dem::ClumpShape& grain,
                     calibrate::ExportTarget target, const std::string& deck, int grains);

/// Whether the program can be started.
bool has_program_for(calibrate::ExportTarget target);

}  // namespace repose::testing
