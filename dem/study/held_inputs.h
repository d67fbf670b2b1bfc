#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "dem/study/section.h"
#include "dem/study/study.h"

namespace repose::dem {

/// A number of a study that is known, so that no fit seeks it, but not exactly.
struct HeldInput {
  std::string name;         ///< where the study has it: "experiment.roll.incline_deg"
  std::string unit;         ///< "deg", "kg/m3"; "" for a pure number
  double value = 0;         ///< in it
  double sd = 0;            ///< standard uncertainty
  bool is_assumed = false;  ///< the study does not state it
  double step = 0;          ///< the sd, or less the sd where it cannot be so much more
};

/// What a study does not state and matters always is assumed: Young's moduli may be of twice the
/// value (literature values of one material differ by as much), sizes and density of 2 % more.
inline constexpr double kAssumedModulusFraction = 1;
inline constexpr double kAssumedSizeFraction = .02;
inline constexpr double kAssumedDensityFraction = .02;

/// [uncertainty], once the rest of the study has been read.
void read_uncertainty(Section uncertainty, Study& study);

/// All that have an uncertainty above 0, stated ones or assumed ones, in the order of the study's
/// sections; none where the study says vary = false.
std::vector<HeldInput> held_inputs(const Study& study);

/// Numbers of the experiments whose uncertainty is not stated: taken as exact.
std::vector<std::string> inputs_taken_as_exact(const Study& study);

/// Adds to the value of one of them, in its unit.
/// @throws base::InputError  the study has no such number.
void change_input(Study& study, const std::string& name, double change);

/// Whether an experiment of the study is simulated otherwise with another value.
bool has_effect(std::string_view input, Experiment experiment);

}  // namespace repose::dem
