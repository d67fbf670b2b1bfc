#pragma once

#include <string>
#include <vector>

#include "dem/experiment/experiment.h"
#include "dem/study/study.h"

namespace repose::calibrate {

/// A coefficient of a study by its name in the file.
struct NamedCoefficient {
  std::string name;  ///< "contact.particle_wall.restitution"
  dem::Coefficient coefficient;
};

/// The six of plate and grains, walls first, and those of each part of another material.
std::vector<NamedCoefficient> coefficients_of(const dem::Study& study);

/// Where a bench has it; null where it does not.
double* find_coefficient(const std::string& name, dem::Model& model);
/// Likewise. Throws base::InputError for a name that there is not.
double& coefficient_named(const std::string& name, dem::Model& model);

}  // namespace repose::calibrate
