#pragma once

#include <array>
#include <string>

#include "dem/experiment/experiment_table.h"
#include "dem/study/study.h"

/// Default settings of experiments.
namespace repose::calibrate {

/// A round number of mm, about six grains across; the tube is three times as high.
double usual_tube_diameter_mm(const std::array<double, 3>& grain_mm);

/// Grains that touch each other are softened to about 10 MPa, those of a fill to 100 MPa, unless
/// that would change the readings.
dem::StudyExperiment usual_experiment(const dem::ExperimentEntry& entry,
                                      const dem::UsualBench& bench);

/// An experiment's section of a study file: the heading and the keys of its protocol, a line each.
std::string protocol_lines(const dem::ExperimentEntry& entry, dem::Protocol protocol);

/// The whole section: those lines, the softening unless grains are as stiff as real ones, and the
/// sheet of its readings with the required columns.
std::string study_section(const dem::ExperimentEntry& entry, const dem::StudyExperiment& described);

}  // namespace repose::calibrate
