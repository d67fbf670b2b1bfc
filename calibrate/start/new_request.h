#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "calibrate/start/new_study.h"

/// What a person says of a study that is yet to be measured, and the study that it makes: what
/// `repose new` and the page ask for.
namespace repose::calibrate {

/// As a person says it; what is empty was not said, and the usual is meant.
struct NewRequest {
  std::filesystem::path study;                      ///< "soybean.toml"
  std::string grains = {};                          ///< a kind of grain
  std::string plate = {};                           ///< a kind of plate
  std::map<dem::WallPart, std::string> parts = {};  ///< of what else they are than of the plate's
  std::optional<std::array<double, 3>> grain_mm = {};
  std::optional<double> density_kg_m3 = {};
  std::optional<std::array<double, 2>> tube_mm = {};  ///< inner diameter and height
  std::vector<std::string> experiments = {};          ///< names
};

inline constexpr const char* kUsualGrain = "other";
inline constexpr const char* kUsualPlate = "steel";

/// Fields of a request, as faults name them, and their options of `repose new`.
inline constexpr std::array<base::FieldName, 9> kNewFields{{{"kind of grain", "--grains"},
                                                            {"plate", "--plate"},
                                                            {"tube", "--tube"},
                                                            {"incline", "--incline"},
                                                            {"pane", "--pane"},
                                                            {"size", "--grain-mm"},
                                                            {"density", "--density-kg-m3"},
                                                            {"size of the tube", "--tube-mm"},
                                                            {"experiments", "--experiments"}}};

/// What it makes, and what is wrong with it: of a field with a fault the usual is taken.
struct RequestedStudy {
  NewStudy study;
  std::vector<base::Fault> faults;  ///< empty: it can be written
};

/// Whether its files have a place is among the faults.
RequestedStudy requested_study(const NewRequest& request);

/// What is not measured yet, and stands in the study all the same, a few words each: "grains of
/// 7.6 x 6.9 x 6.2 mm".
struct Assumption {
  std::string text;
  std::string field;  ///< that says it; empty: the study alone does
};
std::vector<Assumption> assumptions_of(const NewStudy& study);

/// That the grains would stick to each other, which is not simulated, as a sentence.
std::optional<std::string> sticking_of(const NewStudy& study);

/// The command line that starts the study, as a shell takes it.
std::string new_command(const NewRequest& request);

}  // namespace repose::calibrate
