#pragma once

#include <array>
#include <string>

#include "dem/experiment/experiment_table.h"
#include "dem/study/study.h"

/// How an experiment is done where nobody has said how.
namespace repose::calibrate {

/// A round number of mm, about six grains across; three times as high.
double usual_tube_diameter_mm(const std::array<double, 3>& grain_mm);

/// Grains that touch each other are softened to about 10 MPa, those of a fill to 100 MPa, unless
/// that would change what is read.
dem::StudyExperiment usual_experiment(const dem::ExperimentEntry& entry,
                                      const dem::UsualBench& bench);

/// Its section of a study file: the heading and the keys of its protocol, a line each.
std::string protocol_lines(const dem::ExperimentEntry& entry, dem::Protocol protocol);

/// The whole section: those lines, how soft its grains are unless they are as stiff as the real
/// ones, and the sheet of its readings with the columns that it needs.
std::string study_section(const dem::ExperimentEntry& entry, const dem::StudyExperiment& described);

}  // namespace repose::calibrate
