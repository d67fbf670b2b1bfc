#pragma once

#include <array>
#include <string>

#include "dem/study/experiment_table.h"
#include "dem/study/study.h"

/// How an experiment is done where nobody has said how.
namespace repose::calibrate {

/// What it is done with.
struct UsualBench {
  std::array<double, 3> grain_mm = {};  ///< length, width, thickness
  double young_modulus_pa = 0;          ///< of the grains
  double tube_diameter_mm = 0;          ///< inner; of heaps
  double tube_height_mm = 0;
  bool has_own_tube = false;  ///< fills are made in this one, too
};

/// A round number of mm, about six grains across; three times as high.
double usual_tube_diameter_mm(const std::array<double, 3>& grain_mm);

/// Grains that touch each other are softened to about 10 MPa, those of a fill to 100 MPa, unless
/// that would change what is read.
dem::StudyExperiment usual_experiment(const dem::ExperimentEntry& entry, const UsualBench& bench);

/// Its section of a study file: the heading and the keys of its protocol, a line each.
std::string protocol_lines(const dem::ExperimentEntry& entry, dem::Protocol protocol);

/// The whole section: those lines, how soft its grains are unless they are as stiff as the real
/// ones, and the sheet of its readings with the columns that it needs.
std::string study_section(const dem::ExperimentEntry& entry, const dem::StudyExperiment& described);

}  // namespace repose::calibrate
