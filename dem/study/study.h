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

/// A coefficient that is known, or one to be found between two bounds, or one to be found that has
/// a value for runs made before.
struct Coefficient {
  std::optional<double> value;
  double min = 0;  ///< both 0: it is known
  double max = 0;
  /// Between the bounds, what is known beforehand: mean and standard deviation. Both or none.
  std::optional<double> known_mean;
  std::optional<double> known_sd;

  /// A 95 % interval of this half-width is narrow enough for what it is needed for.
  std::optional<double> useful_half_width = {};
  /// The bounds are what is known, or no more than convenient to search; none: not said.
  std::optional<bool> are_bounds_known = {};

  bool is_free() const { return max > min; }
};

struct CoefficientSet {
  Coefficient restitution;
  Coefficient sliding_friction;
  Coefficient rolling_friction;
  Coefficient restitution_exponent = {.value = 0, .known_mean = {}, .known_sd = {}};
  std::optional<double> restitution_speed_m_s = {};  ///< given where the exponent is
};

/// An error that all readings of an experiment have in common, so that more of them do not help.
struct Systematic {
  std::string name;       ///< "bias_sd", as results call it
  double sd = 0;          ///< standard uncertainty, in the unit of the readings
  std::string note = {};  ///< what it is of, and what would help; empty: the study states it
};

/// The key of a measured table for what its readings share, and the name of that part.
inline constexpr const char* kBiasKey = "bias_sd";

/// Another reading of an experiment than its own number, measured on the bench: its mean.
struct MeasuredReading {
  std::string name;  ///< as in the readings of the simulation: "base_radius_mm"
  double mean = 0;
  std::optional<double> sd;
  std::optional<int> count;
  std::optional<double> tolerance;  ///< as Measured::tolerance
  std::vector<Systematic> systematic = {};
};

/// What was measured on the bench: readings, or their mean and scatter, or a sheet of readings, or
/// pictures, films or three-dimensional scans to measure. All empty: nothing was. In the unit of
/// the experiment (mm or degrees).
struct Measured {
  std::vector<double> values;
  std::optional<double> mean;
  std::optional<double> sd;
  std::optional<int> count;
  /// A difference between bench and simulation up to this does not matter.
  std::optional<double> tolerance;
  std::optional<std::filesystem::path> sheet;   ///< a table with the columns of its BenchSheet
  std::vector<std::filesystem::path> pictures;  ///< files, folders and patterns ("heaps/*.jpg")
  /// Of each of the `pictures` entries the heap that all its files are of; empty: of a heap each.
  std::vector<std::string> picture_heaps;
  std::vector<std::filesystem::path> videos;  ///< the same
  std::vector<std::filesystem::path> scans;   ///< the same: of a heap each
  /// Standard uncertainty of a single one of the `values`, where it is known: they scatter by as
  /// much at least.
  std::optional<double> value_uncertainty;
  /// Of pictures with several of one heap, once they are measured: how many they are, and by what
  /// standard deviation those of one heap scatter.
  std::optional<std::pair<int, double>> within_heaps;
  /// Of drops: heights were read in air, not corrected for its drag, as films' are.
  bool in_air = true;
  std::vector<Systematic> systematic = {};  ///< of values and mean
  std::vector<MeasuredReading> also;

  /// It is a heap's angle, measured here.
  bool is_seen() const { return !pictures.empty() || !videos.empty() || !scans.empty(); }
};

/// An experiment as a study describes it.
struct StudyExperiment {
  Protocol protocol;
  Measured measured;
  /// By which its angle was measured on the bench, and is in simulations: a name of
  /// base/angle_definition.h. Empty: not said, and the usual one is meant. Pictured ones only.
  std::string definition = {};
  double stiffness_factor = 1;  ///< of the grains and walls in it; 1 is the real material
  /// Its readings are not fitted, but predicted from the fit of the others, and compared.
  bool is_held_out = false;
  /// By what fraction of a reading the model may miss it; none: the experiment's usual one.
  std::optional<double> model_error = {};
};

/// What a report says about a study beside its numbers. Each may be empty.
struct StudyHeading {
  std::string title;
  std::string author;
  std::string date;
  std::string note;
};

/// A study file: the particle, the walls, what is known and what is sought, the experiments.
struct Study {
  std::filesystem::path file;
  StudyHeading heading;
  /// Values that the file states and that nobody has measured, by name: "particle.density_kg_m3".
  std::vector<std::string> assumed;
  /// Fingerprint of the text, the settings, the scan or clump file and the sheets of readings: a
  /// UUID made from their bytes (RFC 4122, version 5). The same study, the same fingerprint.
  std::string hash;
  /// Coefficients that are to be found are NaN in it. `model.grain` is empty: reading takes no
  /// time, making spheres does; `study.model.grain = build_grain(study.grain).shape` when needed.
  Model model;
  GrainSource grain;
  /// Red, green, blue as on a screen, 0 to 1, for pictures; none: they choose one.
  std::optional<std::array<double, 3>> grain_colour;
  CoefficientSet particle_wall;
  std::map<WallPart, CoefficientSet> particle_parts;  ///< of the parts in `model.parts`
  CoefficientSet particle_particle;
  std::map<Experiment, StudyExperiment> experiments;  ///< those that it describes
  /// [uncertainty]: standard uncertainties of numbers that are known, by their keys
  /// ("experiment.roll.incline_deg"), in their units; and whether a calibration looks what they do.
  std::map<std::string, double> stated_sd;
  bool varies_inputs = true;
  int replicates = 1;
  std::uint64_t seed = 1;
  std::optional<int> threads;  ///< when the file says how many
  EngineChoice engine;

  /// How the experiment is done that has this kind of protocol.
  /// @throws std::out_of_range  the study does not describe it.
  template <typename Kind>
  const Kind& protocol() const {
    return experiments.at(experiment_of<Kind>()).protocol.template as<Kind>();
  }
};

/// Reads a study file (TOML). `settings` are "key.path=value" pairs that replace or add values, the
/// value as in TOML; files named in them are looked for beside the study file, like all others.
///
/// Throws base::InputError with every error of the file: line, column, value, rule, fix. Those
/// of a setting are called "setting:N:column", N counting the settings from 1.
Study read_study(const std::filesystem::path& file, const std::vector<std::string>& settings = {});

/// Reads a copy kept elsewhere than the study: the files that it names need not be there any more,
/// and it has no fingerprint.
Study read_study_copy(const std::filesystem::path& file,
                      const std::vector<std::string>& settings = {});

/// The study's own file and all that it names: its scan or clump, sheets of readings, pictures.
std::vector<std::filesystem::path> files_of(const Study& study);

/// Whether the study describes the experiment, and what the bench gave for it: nothing where it
/// does not.
bool has_protocol(const Study& study, Experiment experiment);
Measured measured_in(const Study& study, Experiment experiment);

/// Names ("contact.particle_wall.restitution") of the coefficients that an experiment needs and the
/// study leaves to be found. Grains touch each other only in some experiments; the others need no
/// coefficients between grains.
std::vector<std::string> open_coefficients(const Study& study, Experiment experiment);

/// The bench as one experiment needs it: its stiffness factor, sizes that vary in bulks only, the
/// parts that it has, and coefficients without effect in
/// it (see open_coefficients) set to something where the study leaves them open.
Model model_for(const Study& study, Experiment experiment);

}  // namespace repose::dem
