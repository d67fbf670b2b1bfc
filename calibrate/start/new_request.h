#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "calibrate/start/new_study.h"

/// What the user states about a study not measured yet, and the study made from it: for `repose
/// new` and the studio's page.
namespace repose::calibrate {

/// The user's entries; empty ones take the default.
struct NewRequest {
  std::filesystem::path study;                      ///< "soybean.toml"
  std::string grains = {};                          ///< name of a kind of grain
  std::string plate = {};                           ///< name of a kind of plate
  std::map<dem::WallPart, std::string> parts = {};  ///< those of another material than the plate's
  std::optional<std::array<double, 3>> grain_mm = {};
  std::optional<double> density_kg_m3 = {};
  std::optional<std::array<double, 2>> tube_mm = {};  ///< inner diameter and height
  std::vector<std::string> experiments = {};          ///< names
};

inline constexpr const char* kUsualGrain = "other";
inline constexpr const char* kUsualPlate = "steel";

/// Fields of a request as named in error messages, and the matching options of `repose new`.
inline constexpr std::array<base::FieldName, 9> kNewFields{{{"kind of grain", "--grains"},
                                                            {"plate", "--plate"},
                                                            {"tube", "--tube"},
                                                            {"incline", "--incline"},
                                                            {"pane", "--pane"},
                                                            {"size", "--grain-mm"},
                                                            {"density", "--density-kg-m3"},
                                                            {"size of the tube", "--tube-mm"},
                                                            {"experiments", "--experiments"}}};

/// The resulting study, and the errors: fields with an error take the default.
struct RequestedStudy {
  NewStudy study;
  std::vector<base::Fault> faults;  ///< empty: the study can be written
};

/// The errors include those about the places of its files.
RequestedStudy requested_study(const NewRequest& request);

/// A value that the study assumes because it is not measured yet, in a few words: "grains of 7.6 x
/// 6.9 x 6.2 mm".
struct Assumption {
  std::string text;
  std::string field;  ///< request field that sets it; empty: it is set only in the study
};
std::vector<Assumption> assumptions_of(const NewStudy& study);

/// A warning sentence if the grains would stick to each other, which is not simulated.
std::optional<std::string> sticking_of(const NewStudy& study);

/// The command line that creates the study, quoted for a shell.
std::string new_command(const NewRequest& request);

}  // namespace repose::calibrate
