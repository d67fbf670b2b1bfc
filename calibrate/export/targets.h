#pragma once

#include <vector>

#include "calibrate/export/export.h"
#include "calibrate/export/facts.h"

/// One file for each target: its decks, without README.txt.
namespace repose::calibrate {

using Conversions = std::vector<Conversion>;

std::vector<ExportedFile> liggghts_files(const ExportFacts& facts, const Conversions& conversions);
std::vector<ExportedFile> lammps_files(const ExportFacts& facts, const Conversions& conversions);
std::vector<ExportedFile> yade_files(const ExportFacts& facts, const Conversions& conversions);
std::vector<ExportedFile> edem_files(const ExportFacts& facts, const Conversions& conversions);

/// What EDEM calls it.
const char* edem_rolling_name(dem::RollingModel model);

}  // namespace repose::calibrate
