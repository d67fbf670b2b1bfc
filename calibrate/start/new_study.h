#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dem/experiment/experiment_table.h"

/// A study not measured yet: its commented file, a sheet for each experiment to fill in at the
/// bench, and typical values for kinds of particle and plate until they are measured.

namespace repose::calibrate {

struct CoefficientBounds {
  double min = 0;
  double max = 0;
};

/// Bounds of a contact's coefficients.
struct ContactBounds {
  CoefficientBounds restitution;
  CoefficientBounds sliding_friction;
  CoefficientBounds rolling_friction;
};

struct GrainKind {
  std::string_view name;             ///< as typed: "soybean"
  std::string_view plural;           ///< "soybeans"
  std::array<double, 3> sizes = {};  ///< length, width, thickness, mm
  double density_kg_m3 = 0;
  double young_modulus_pa = 0;  ///< apparent, of a whole grain
  double poisson_ratio = 0;
  ContactBounds with_wall;
  ContactBounds with_grain;
  std::array<int, 3> colour = {};  ///< about that of the grains: red, green, blue, 0 to 255
  std::string_view source;  ///< of the bounds; empty: they are wide and not specific to a kind
};

struct PlateKind {
  std::string_view name;  ///< as typed: "acrylic"
  double density_kg_m3 = 0;
  double young_modulus_pa = 0;
  double poisson_ratio = 0;
};

/// The last is "other": any grain.
std::span<const GrainKind> grain_kinds();
std::span<const PlateKind> plate_kinds();

struct NewStudy {
  GrainKind grain;
  PlateKind plate;
  std::map<dem::WallPart, PlateKind> parts = {};  ///< those of another material than the plate's
  std::array<double, 3> sizes_mm = {};            ///< of the grain: length, width, thickness
  bool has_own_sizes = false;                     ///< otherwise those of its kind
  double density_kg_m3 = 0;
  bool has_own_density = false;
  double tube_diameter_mm = 0;  ///< inner
  double tube_height_mm = 0;
  bool has_own_tube = false;  ///< for heaps and fills; otherwise the default one for heaps
  std::vector<dem::Experiment> experiments;  ///< at least one
};

/// Approximate number of grains that fill the tube.
double grains_in_tube(const NewStudy& study);

/// A sheet of readings.
struct NewSheet {
  dem::Experiment experiment = nullptr;
  std::string name;                  ///< without its folder: "drops.csv"
  std::vector<std::string> columns;  ///< each with its unit: "rebound_mm"
};

std::vector<NewSheet> sheets_of(const NewStudy& study);

/// "Soybeans on acrylic".
std::string title_of(const NewStudy& study);

bool needs_tube(const NewStudy& study);

/// Names of assumed values, as in the study file's list.
std::vector<std::string> assumed_names(const NewStudy& study);

/// The text of the study file. Its sheets are in `folder`, which lies beside it.
std::string study_text(const NewStudy& study, const std::string& folder);

/// FOLDER/soybean for FOLDER/soybean.toml.
std::filesystem::path sheet_folder_of(const std::filesystem::path& file);

/// @throws base::InputError  the study or its folder exists already, or they cannot be created: all
///   errors.
void check_new_places(const std::filesystem::path& file);

/// Writes the study and its folder of sheets, all or nothing.
/// @throws base::InputError  as check_new_places(); or one of them cannot be written.
void write_new_study(const NewStudy& study, const std::filesystem::path& file);

}  // namespace repose::calibrate
