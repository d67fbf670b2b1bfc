#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <typeinfo>
#include <utility>
#include <vector>

#include "base/input_error.h"
#include "dem/experiment/experiment.h"
#include "dem/experiment/protocol_key.h"
#include "dem/shape/clump/clump_shape.h"

/// All metadata on the experiments, one entry each, defined in the experiment's own source. Used by
/// study files, reports, the fit and the run store.
namespace repose::dem {

struct ExperimentEntry;
/// An experiment as a key: its entry. Keys compare in listing order.
using Experiment = const ExperimentEntry*;

/// Upper limit of a reading, in its unit.
struct ReadingLimit {
  double most = 0;
  std::string reason;  ///< "low_height_mm = 50 and from lying to standing with this grain"
};

/// A number that a run gives besides its value.
struct Reading {
  std::string_view name;  ///< with its unit, as in Repeat::readings
  std::string_view unit;  ///< "mm", "deg", "g", "s"; empty: a pure number
  /// Can also be measured on the bench: a key of [experiment.NAME.also_measured].
  bool is_measurable = false;
  std::string_view needs = "";     ///< protocol key without which the reading does not exist
  bool shares_systematic = false;  ///< also has the experiment's SystematicFraction
  /// The bench reads it in separate trials: its random errors are independent of the value's.
  bool has_own_trials = false;
  /// Null, or returns std::nullopt: no limit.
  std::optional<ReadingLimit> (*limit)(const Model& model, const Protocol& protocol) = nullptr;
};

/// How far all readings of a bench may differ from the simulation for a known reason, which more
/// readings do not reduce.
struct SystematicFraction {
  std::string_view name = "";  ///< as in results: "pouring_rate"
  double sd = 0;               ///< standard uncertainty as a fraction of the reading
  std::string_view note = "";  ///< the reason, and the remedy
  /// The warning of `repose simulate`: name and text.
  std::string_view warning_name = "";
  std::string_view warning = "";
};

/// A test of `repose bench` without a formula: its result is the mean of the readings.
struct MeanOfReadings {
  std::string_view what;      ///< the quantity read, for display: "angle of repose"
  Range readable;             ///< possible values
  std::string_view quantity;  ///< name of the mean in results: "angle_of_repose"
  std::string_view source = "mean of the readings";
  std::string_view validity;  ///< what the mean represents, and what not
};

/// The sheet filled in at the bench, one row per repeat: the columns of a test of `repose bench`.
struct BenchSheet {
  std::string_view test;   ///< "restitution"
  std::string_view value;  ///< the column with the experiment's value: "rebound_mm"
  /// Columns that repeat protocol keys, in their unit: {"drop_mm", "height_mm"}.
  std::vector<std::pair<std::string_view, std::string_view>> protocol = {};
  /// The test itself; std::nullopt: it has a formula, in calibrate/statistics/bench.
  std::optional<MeanOfReadings> mean = {};
};

/// A protocol key that can be read from films and is optional in sheets.
struct FilmedSetting {
  std::string_view column;  ///< of the row read from a film: "rate_deg_s"
  std::string_view key;
  double tolerance = 0;  ///< allowed difference, as a fraction of the key's value
};

/// What a film of an experiment shows, which determines how it is read.
enum class FilmedMotion { none, fall, slide, roll, rest };

/// A level camera on a stand in front of the plate.
struct LevelCamera {
  double distance_m = 0;  ///< from the middle of the heap, horizontally
  double height_m = 0;    ///< of the lens above the ground

  bool operator==(const LevelCamera&) const = default;
};

/// Two boxes, one above the other, seen from the front after the discharge: the slopes that remain
/// above and the heap below are measured in an image of them.
struct BoxesFront {
  double length_m = 0;       ///< of both
  double upper_floor_m = 0;  ///< above the lower floor
  double fill_m = 0;         ///< height of the grains in the upper box, before
  double drop_m = 0;         ///< from the slot's lower edge to the lower floor
};

/// Default equipment for experiments, if not specified.
struct UsualBench {
  std::array<double, 3> grain_mm = {};  ///< length, width, thickness
  double young_modulus_pa = 0;          ///< of the grains
  double tube_diameter_mm = 0;          ///< inner; of heaps
  double tube_height_mm = 0;
  bool has_own_tube = false;  ///< fills are made in this tube, too
};

struct ExperimentEntry {
  std::string_view name;              ///< in study files, jobs and results: "drop"
  std::string_view unit;              ///< of its value: "mm", "deg", "kg/m3" or "%"
  std::string_view value_name;        ///< name of its value, for display: "rebound height"
  std::string_view description = "";  ///< procedure, in a sentence or two
  std::vector<Reading> readings;
  /// Study names of the coefficients that affect its readings.
  std::vector<std::string_view> coefficients;
  /// Parts of its apparatus besides the plate; their coefficients affect its readings, too.
  std::vector<WallPart> parts = {};
  /// The coefficient that it identifies; empty if none.
  std::string_view tells = "";
  BenchSheet sheet;
  bool is_stochastic = true;  ///< false: the seed changes nothing
  bool is_bulk = false;       ///< many loose grains, of all sizes
  bool is_default = true;     ///< part of a new study unless experiments are named
  bool is_pictured = false;   ///< its value is measured in images, both real and simulated
  bool is_in_air = false;     ///< air drag lowers its readings, and is not simulated
  bool has_plate = true;      ///< false: without any wall
  bool needs_tube = false;    ///< done in a tube; a default one if the bench has none
  /// A film of it gives a row of its sheet or, if FilmedMotion::rest, a picture.
  FilmedMotion filmed = FilmedMotion::none;
  std::vector<FilmedSetting> filmed_settings = {};
  /// Number of bench readings that one run's value is the mean of; null: one.
  int (*readings_per_run)(const Protocol& protocol) = nullptr;
  /// Number of grains requested, if that many fit; null, or returns std::nullopt: as many as fit.
  std::optional<int> (*grains_asked)(const Protocol& protocol) = nullptr;
  /// Null: none, whatever the protocol.
  SystematicFraction (*systematic)(const Protocol& protocol) = nullptr;
  /// Effect of softened grains on its value, phrased to follow "a drop with
  /// stiffness_factor = 0.1"; empty: negligible.
  std::string_view softening_effect = "";
  /// Typical scatter of single bench readings as a fraction of their mean, assumed if not measured.
  /// Source: docs/study-file.md.
  double usual_scatter = .05;
  /// Typical model error (standard deviation) as a fraction of its readings, whatever the
  /// coefficients. Source: docs/study-file.md.
  double usual_model_error = 0;
  /// Young's modulus, Pa, to which a new study softens grains if they touch each other: softer
  /// heaps move, stiffer ones take long.
  double soft_pa = 1.25e7;

  Protocol usual;  ///< with the default values of all keys
  std::vector<ProtocolKey> (*keys)(Protocol& protocol) = nullptr;
  Repeat (*run)(const Model& model, const Protocol& protocol, std::uint64_t seed,
                const ProgressReport& report, const RunRecord& record) = nullptr;
  /// Resumes an interrupted run; null: it must start again.
  Repeat (*resume)(const Model& model, const Protocol& protocol, std::uint64_t seed,
                   const Restart& from, const ProgressReport& report,
                   const RunRecord& record) = nullptr;
  /// If it can be resumed: names of RunProgress::stage in restart files.
  std::vector<std::string_view> stages = {};
  /// Adapts the default protocol to a bench; null: the same everywhere.
  void (*adapt)(Protocol& protocol, const UsualBench& bench) = nullptr;
  /// If pictured, where its camera stands; null, or returns std::nullopt: far away.
  std::optional<LevelCamera> (*camera)(const Protocol& protocol) = nullptr;
  /// The image that some of its readings are measured in; null: none.
  BoxesFront (*front)(const Protocol& protocol) = nullptr;
  /// The moving body; null: a single grain.
  ClumpShape (*body)(const ClumpShape& grain, const Protocol& protocol) = nullptr;
  /// Height of a free fall that ends at the speed of its fastest impact, m; for one in air, that on
  /// the bench.
  double (*fall_m)(const ClumpShape& grain, const Protocol& protocol) = nullptr;
  /// Possible range of its value, in its unit: anything else is an error of the run, not a reading.
  Range (*possible)(const Model& model, const Protocol& protocol) = nullptr;
  /// Bench readings are at least this fraction of the possible maximum.
  double least_of_possible = 0;
  /// Approximate duration of a run on a core of about 2020, s: depends only on the model (all
  /// coefficients set) and the protocol, not on the machine. Mainly the ratios matter.
  double (*cost_s)(const Model& model, const Protocol& protocol) = nullptr;
  /// Factor by which grains may be enlarged, with fewer of them in the same vessels, so that a run
  /// costs much less but still shows the dependencies; std::nullopt: not here. Null: never.
  std::optional<double> (*coarse_size)(const ClumpShape& grain, const Protocol& protocol) = nullptr;
  /// Adapts the protocol to grains enlarged by that factor. Null if coarse_size is.
  void (*coarsen)(Protocol& protocol, double size) = nullptr;
  /// How much its readings may change with that, as a fraction of them (standard deviation) for
  /// each time the size that is added: double the size has once this. Source: docs/simulating.md.
  double coarse_error = 0;
};

/// All experiments, in listing order.
std::span<const ExperimentEntry> all_experiments();

/// The experiment with this protocol type. @throws std::logic_error  there is none.
const ExperimentEntry& entry_of(const std::type_info& protocol);
const ExperimentEntry& entry_of(const Protocol& protocol);
template <typename Kind>
Experiment experiment_of() {
  return &entry_of(typeid(Kind));
}

/// The experiment measured in images: a study has images of no other.
const ExperimentEntry& pictured_experiment();

/// Null if there is no such name.
const ExperimentEntry* find_experiment(std::string_view name);
/// @throws base::InputError  there is no such experiment.
const ExperimentEntry& experiment_named(std::string_view name);
/// How names are listed: "drop, tilt or roll".
struct NameList {
  bool (*is_meant)(const ExperimentEntry& entry) = nullptr;  ///< null: all
  std::string_view before = "";                              ///< each name: "[experiment."
  std::string_view after = "";
  std::string_view last = " or ";  ///< before the last of them
};
std::string experiment_names(const NameList& list = {});

std::string name_of(Experiment experiment);

/// Errors in a protocol as thrown by run_drop() and the others, with study-file keys and values
/// added, so that users see which key to set and whether it has its default value.
base::InputError with_study_keys(const base::InputError& error, const Protocol& protocol);

/// One of entry.readings, by name.
const Reading& reading_named(const ExperimentEntry& entry, std::string_view name);

/// Range of bench readings in a unit: lengths, angles and counts are 0 or more, angles at most 90.
Range readable_in(std::string_view unit);

/// Whether a coefficient of the study affects the experiment's readings.
bool depends_on(const ExperimentEntry& entry, std::string_view coefficient);

/// Approximate time per grain and step in a bulk of a few hundred, s, on the core that cost_s
/// refers to.
double bulk_step_s(const Model& model);

/// How many times as long a step of each grain takes in a bulk of so many as in one of a few
/// hundred, whose data fit into the caches: measured, dem/PERFORMANCE.md, "So repose has little
/// advantage for large boxes". cost_s of a bulk has it as a factor.
double many_grains_factor(double grains);

/// Whether grains touch each other in it, so that it needs the coefficients between grains.
bool has_grain_contacts(Experiment experiment);

}  // namespace repose::dem
