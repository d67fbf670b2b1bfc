#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dem/study/section.h"
#include "dem/study/study.h"

namespace repose::dem {

/// A number of a study that is known, so not fitted, but has an uncertainty.
struct HeldInput {
  std::string name;         ///< path in the study: "experiment.roll.incline_deg"
  std::string unit;         ///< "deg", "kg/m3"; "" for a pure number
  double value = 0;         ///< in that unit
  double sd = 0;            ///< standard uncertainty
  bool is_assumed = false;  ///< the study does not state it
  double step = 0;          ///< sd, or -sd if value + sd is not allowed
};

/// Standard uncertainties assumed if a study does not state them, as relative values, for inputs
/// that always matter: 100 % for Young's moduli (literature values of one material differ by as
/// much), 2 % for sizes and density.
inline constexpr double kAssumedModulusFraction = 1;
inline constexpr double kAssumedSizeFraction = .02;
inline constexpr double kAssumedDensityFraction = .02;

/// Reads [uncertainty], after the rest of the study.
void read_uncertainty(Section uncertainty, Study& study);

/// All inputs with an uncertainty above 0, stated or assumed, in the order of the study's sections;
/// empty if the study sets vary = false.
std::vector<HeldInput> held_inputs(const Study& study);

/// Numbers of the experiments without stated uncertainty, which are taken as exact.
std::vector<std::string> inputs_taken_as_exact(const Study& study);

/// Adds `change` to one of the inputs, in its unit.
/// @throws base::InputError  the study has no such number.
void change_input(Study& study, const std::string& name, double change);

/// Whether the input affects the simulation of an experiment.
bool has_effect(std::string_view input, Experiment experiment);

}  // namespace repose::dem
