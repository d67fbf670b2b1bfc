#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dem/experiment/experiment.h"
#include "dem/experiment/experiment_table.h"
#include "dem/study/engine_choice.h"
#include "dem/study/grain_source.h"

namespace repose::dem {

/// A coefficient that is known, or to be fitted between two bounds, possibly with a value for runs
/// made beforehand.
struct Coefficient {
  std::optional<double> value;
  double min = 0;  ///< both 0: known
  double max = 0;
  /// Prior mean and standard deviation, within the bounds. Both or neither.
  std::optional<double> known_mean;
  std::optional<double> known_sd;

  /// Half-width of a 95 % interval that is narrow enough for its purpose.
  std::optional<double> useful_half_width = {};
  /// Whether the bounds are prior knowledge, or merely convenient for the search; std::nullopt: not
  /// stated.
  std::optional<bool> are_bounds_known = {};

  bool is_free() const { return max > min; }
};

struct CoefficientSet {
  Coefficient restitution;
  Coefficient sliding_friction;
  Coefficient rolling_friction;
  Coefficient restitution_exponent = {.value = 0, .known_mean = {}, .known_sd = {}};
  std::optional<double> restitution_speed_m_s = {};  ///< given if the exponent is
};

/// An error common to all readings of an experiment, so that more readings do not reduce it.
struct Systematic {
  std::string name;       ///< as in results: "bias_sd"
  double sd = 0;          ///< standard uncertainty, in the unit of the readings
  std::string note = {};  ///< cause and remedy; empty if stated by the study
};

/// Key in a measured table for the error that all its readings share, and that error's name.
inline constexpr const char* kBiasKey = "bias_sd";

/// A further reading of an experiment besides its value, measured on the bench: its mean.
struct MeasuredReading {
  std::string name;  ///< as in the readings of the simulation: "base_radius_mm"
  double mean = 0;
  std::optional<double> sd;
  std::optional<int> count;
  std::optional<double> tolerance;  ///< as Measured::tolerance
  std::vector<Systematic> systematic = {};
};

/// What was measured on the bench: readings, or their mean and scatter, or a sheet of readings, or
/// pictures, films or 3-D scans to be measured. All empty: nothing. In the unit of the experiment
/// (such as mm or degrees).
struct Measured {
  std::vector<double> values;
  std::optional<double> mean;
  std::optional<double> sd;
  std::optional<int> count;
  /// Difference between bench and simulation that does not matter.
  std::optional<double> tolerance;
  std::optional<std::filesystem::path> sheet;   ///< a table with the columns of its BenchSheet
  std::vector<std::filesystem::path> pictures;  ///< files, folders and patterns ("heaps/*.jpg")
  /// For each entry of `pictures`, the heap that all its files show; empty: one heap per file.
  std::vector<std::string> picture_heaps;
  std::vector<std::filesystem::path> videos;  ///< likewise
  std::vector<std::filesystem::path> scans;   ///< likewise, one heap per file
  /// Standard uncertainty of each of the `values`, if known: a lower limit for their scatter.
  std::optional<double> value_uncertainty;
  /// If there are several pictures per heap, once measured: the number of pictures, and the
  /// standard deviation within a heap.
  std::optional<std::pair<int, double>> within_heaps;
  /// For drops: heights were read in air and not corrected for drag, as those from films are.
  bool in_air = true;
  std::vector<Systematic> systematic = {};  ///< of `values` and `mean`
  std::vector<MeasuredReading> also;

  /// Whether it is a heap's angle to be measured from images or scans.
  bool is_seen() const { return !pictures.empty() || !videos.empty() || !scans.empty(); }
};

/// An experiment as a study describes it.
struct StudyExperiment {
  Protocol protocol;
  Measured measured;
  /// How its angle is measured, on the bench and in simulations: a name from
  /// base/angle_definition.h. Empty: not stated, the default applies. Only if pictured.
  std::string definition = {};
  double stiffness_factor = 1;  ///< of the grains and walls in it; 1 is the real material
  /// Its readings are not fitted, but compared with predictions from the fit of the others.
  bool is_held_out = false;
  /// Model error as a fraction of a reading; std::nullopt: the experiment's default.
  std::optional<double> model_error = {};
};

/// What a report says about a study besides its numbers. Each may be empty.
struct StudyHeading {
  std::string title;
  std::string author;
  std::string date;
  std::string note;
};

/// A study file: particle, walls, known and unknown coefficients, experiments.
struct Study {
  std::filesystem::path file;
  StudyHeading heading;
  /// Values in the file that were assumed, not measured, by name: "particle.density_kg_m3".
  std::vector<std::string> assumed;
  /// Fingerprint of the text, the settings, the scan or clump file and the sheets of readings: a
  /// UUID made from their bytes (RFC 4122, version 5). Equal studies have equal fingerprints.
  std::string hash;
  /// Coefficients without a value are NaN. `model.grain` is empty, as filling with spheres takes
  /// time; if needed, set `study.model.grain = build_grain(study.grain).shape`.
  Model model;
  GrainSource grain;
  /// Display red, green, blue, 0 to 1, for rendered images; std::nullopt: chosen by the renderer.
  std::optional<std::array<double, 3>> grain_colour;
  CoefficientSet particle_wall;
  std::map<WallPart, CoefficientSet> particle_parts;  ///< of the parts in `model.parts`
  CoefficientSet particle_particle;
  std::map<Experiment, StudyExperiment> experiments;  ///< those described in the file
  /// [uncertainty]: standard uncertainties of known numbers, by key
  /// ("experiment.roll.incline_deg"), in their units; and whether a calibration varies these
  /// numbers.
  std::map<std::string, double> stated_sd;
  bool varies_inputs = true;
  int replicates = 1;
  std::uint64_t seed = 1;
  std::optional<int> threads;  ///< if the file sets it
  EngineChoice engine;

  /// Protocol of the experiment with this protocol type.
  /// @throws std::out_of_range  the study does not describe it.
  template <typename Kind>
  const Kind& protocol() const {
    return experiments.at(experiment_of<Kind>()).protocol.template as<Kind>();
  }
};

/// Reads a study file (TOML). `settings` are "key.path=value" pairs that replace or add values, in
/// TOML syntax; files named in them are relative to the study file, like all others.
///
/// Throws base::InputError with every error of the file: line, column, value, rule, fix. Those in a
/// setting are located as "setting:N:column", N counting settings from 1.
Study read_study(const std::filesystem::path& file, const std::vector<std::string>& settings = {});

/// Reads a copy stored apart from the study: the files it names need not exist, and it has no
/// fingerprint.
Study read_study_copy(const std::filesystem::path& file,
                      const std::vector<std::string>& settings = {});

/// The study file and all files it names: scan or clump, sheets of readings, pictures.
std::vector<std::filesystem::path> files_of(const Study& study);

/// Whether the study describes the experiment, and what was measured for it (empty if not
/// described).
bool has_protocol(const Study& study, Experiment experiment);
Measured measured_in(const Study& study, Experiment experiment);

/// Names ("contact.particle_wall.restitution") of the coefficients that an experiment needs and the
/// study leaves open. Grains touch each other only in some experiments; the others need no
/// coefficients between grains.
std::vector<std::string> open_coefficients(const Study& study, Experiment experiment);

/// The model for one experiment: its stiffness factor, varying sizes only in bulks, its parts, and
/// open coefficients without effect in it (see open_coefficients) set to those with the plate.
Model model_for(const Study& study, Experiment experiment);

}  // namespace repose::dem
