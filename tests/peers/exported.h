#pragma once

#include <string>
#include <vector>

#include "calibrate/export/export.h"
#include "dem/study/study.h"
#include "tests/support/run_program.h"

/// Exported studies as other programs run them.
namespace repose::testing {

/// Soft grains on a stiffer wall, short ways: a run takes seconds everywhere.
dem::Study short_study(dem::RollingModel rolling, double restitution = .5);

/// What the experiments of a study read: rebound (mm), plate's angle after half a millimetre of
/// slip (degrees), way along the flat (mm).
struct Readings {
  double drop_mm = 0;
  double tilt_deg = 0;
  double roll_mm = 0;
};

Readings our_readings(const dem::Study& study, const dem::ClumpShape& grain);

/// The export, run by its program. Throws std::runtime_error with the last of its output when it
/// fails or reads nothing.
Readings readings_of(const dem::Study& study, const dem::ClumpShape& grain,
                     calibrate::ExportTarget target);

/// The export's deck of one experiment, run with further arguments of its program: the reading that
/// it prints. Throws as above.
double reading_of(const dem::Study& study, const dem::ClumpShape& grain,
                  calibrate::ExportTarget target, const std::string& deck, const std::string& name,
                  const std::vector<std::string>& arguments = {});

/// Runs a deck that lies in the folder, with further arguments of its program. Throws as above.
Finished run_deck(const TemporaryFolder& folder, calibrate::ExportTarget target,
                  const std::string& deck, const std::vector<std::string>& arguments = {});

/// Mean rebound of the export's drop or drop_on_grains, run. Throws as above.
double rebound_mm_of(const dem::Study& study, const dem::ClumpShape& grain,
                     calibrate::ExportTarget target, const std::string& deck, int grains);

/// Whether the program starts.
bool has_program_for(calibrate::ExportTarget target);

}  // namespace repose::testing
