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

/// What there is to know about each experiment, an entry each, which the experiment's own source
/// makes. Study files, reports, the fit and the store of runs ask here.
namespace repose::dem {

struct ExperimentEntry;
/// An experiment, as a key: its entry. They compare as they are listed.
using Experiment = const ExperimentEntry*;

/// What a reading cannot be above, in its unit.
struct ReadingLimit {
  double most = 0;
  std::string reason;  ///< "low_height_mm = 50 and from lying to standing with this grain"
};

/// A number that a run gives beside its value.
struct Reading {
  std::string_view name;  ///< with its unit, as in Repeat::readings
  std::string_view unit;  ///< "mm", "deg", "g", "s"; empty: a pure number
  /// A bench can measure it too: a key of [experiment.NAME.also_measured].
  bool is_measurable = false;
  std::string_view needs = "";     ///< the key of the protocol without which there is none
  bool shares_systematic = false;  ///< has the experiment's SystematicFraction, too
  /// The bench reads it in trials of its own: by chance it differs from its mean alone, and not
  /// together with the value.
  bool has_own_trials = false;
  /// Null, or none: it may be anything.
  std::optional<ReadingLimit> (*limit)(const Model& model, const Protocol& protocol) = nullptr;
};

/// By how much all readings of a bench may differ from the simulation for a reason that is known,
/// and that more of them do not help against.
struct SystematicFraction {
  std::string_view name = "";  ///< as results call it: "pouring_rate"
  double sd = 0;               ///< standard uncertainty as a fraction of the reading
  std::string_view note = "";  ///< the reason, and what would help
  /// What `repose simulate` says of it: the warning's name and its text.
  std::string_view warning_name = "";
  std::string_view warning = "";
};

/// A test of `repose bench` that works nothing out: its result is the mean of the readings.
struct MeanOfReadings {
  std::string_view what;      ///< is read, for people: "angle of repose"
  Range readable;             ///< what it can be
  std::string_view quantity;  ///< the mean, as results call it: "angle_of_repose"
  std::string_view source = "mean of the readings";
  std::string_view validity;  ///< what the mean is, and is not
};

/// What a bench writes down of it, a row for each repeat: the columns of a test of `repose bench`.
struct BenchSheet {
  std::string_view test;   ///< "restitution"
  std::string_view value;  ///< the column with the experiment's value: "rebound_mm"
  /// Columns that repeat keys of the protocol, in their unit: {"drop_mm", "height_mm"}.
  std::vector<std::pair<std::string_view, std::string_view>> protocol = {};
  /// The test itself; none: it has a formula, and is one of calibrate/statistics/bench.
  std::optional<MeanOfReadings> mean = {};
};

/// A key of the protocol that films show and sheets need not have.
struct FilmedSetting {
  std::string_view column;  ///< of what a film gives: "rate_deg_s"
  std::string_view key;
  double tolerance = 0;  ///< how far they may differ, as a fraction of the key's value
};

/// What a film of an experiment shows, and so how it is read.
enum class FilmedMotion { none, fall, slide, roll, rest };

/// A level camera on a stand before what lies on the plate.
struct LevelCamera {
  double distance_m = 0;  ///< from the middle, along the floor
  double height_m = 0;    ///< of the lens above the ground

  bool operator==(const LevelCamera&) const = default;
};

/// Two boxes, one over the other, seen from the front, after grains ran from one into the other:
/// the slopes that stay above and the heap below are measured in a picture of them.
struct BoxesFront {
  double length_m = 0;       ///< of both
  double upper_floor_m = 0;  ///< above the lower floor
  double fill_m = 0;         ///< height of the grains above, before
  double drop_m = 0;         ///< from the upper box's lower edge to the lower floor
};

/// What experiments are done with where nobody has said how.
struct UsualBench {
  std::array<double, 3> grain_mm = {};  ///< length, width, thickness
  double young_modulus_pa = 0;          ///< of the grains
  double tube_diameter_mm = 0;          ///< inner; of heaps
  double tube_height_mm = 0;
  bool has_own_tube = false;  ///< fills are made in this one, too
};

struct ExperimentEntry {
  std::string_view name;              ///< in study files, jobs and results: "drop"
  std::string_view unit;              ///< of its value: "mm", "deg", "kg/m3" or "%"
  std::string_view value_name;        ///< what its value is, for people: "rebound height"
  std::string_view description = "";  ///< how it is done, a sentence or two
  std::vector<Reading> readings;
  /// Names in the study of the coefficients that move its readings.
  std::vector<std::string_view> coefficients;
  /// What its bench has beside the plate; their coefficients move its readings, too.
  std::vector<WallPart> parts = {};
  /// The one of these that it tells from the others; empty: none.
  std::string_view tells = "";
  BenchSheet sheet;
  bool is_stochastic = true;  ///< false: the seed changes nothing
  bool is_bulk = false;       ///< many loose grains, of all the sizes that they have
  bool is_default = true;     ///< part of a new study that names no experiments
  bool is_pictured = false;   ///< its value is measured in pictures, on the bench and simulated
  bool is_in_air = false;     ///< the drag of the air lowers its readings, and is not simulated
  bool has_plate = true;      ///< false: no wall is in it
  bool needs_tube = false;    ///< it is done in a tube, a usual one where the bench has none
  /// A film of it on the bench gives a row of its sheet or, of what comes to rest, a picture.
  FilmedMotion filmed = FilmedMotion::none;
  std::vector<FilmedSetting> filmed_settings = {};
  /// How many readings of a bench a run's number is the mean of; null: one.
  int (*readings_per_run)(const Protocol& protocol) = nullptr;
  /// How many grains it is to have, where that many fit; null, or none: as many as fit.
  std::optional<int> (*grains_asked)(const Protocol& protocol) = nullptr;
  /// Null: there is none, whatever the protocol.
  SystematicFraction (*systematic)(const Protocol& protocol) = nullptr;
  /// What softened grains do to its value, to follow "a drop with stiffness_factor = 0.1"; empty:
  /// nothing that would matter.
  std::string_view softening_effect = "";
  /// By what fraction of their mean single readings of a bench usually scatter: assumed where
  /// nobody measured it. docs/study-file.md says what it is from.
  double usual_scatter = .05;
  /// By what fraction of its readings the model usually misses them (standard deviation), whatever
  /// its coefficients. docs/study-file.md says what it is from.
  double usual_model_error = 0;
  /// Where grains touch each other, a new study makes them about this soft, Pa: softer heaps move,
  /// stiffer ones take long.
  double soft_pa = 1.25e7;

  Protocol usual;  ///< with the usual values of all keys
  std::vector<ProtocolKey> (*keys)(Protocol& protocol) = nullptr;
  Repeat (*run)(const Model& model, const Protocol& protocol, std::uint64_t seed,
                const ProgressReport& report, const RunRecord& record) = nullptr;
  /// Goes on with an interrupted run; null: it starts again.
  Repeat (*resume)(const Model& model, const Protocol& protocol, std::uint64_t seed,
                   const Restart& from, const ProgressReport& report,
                   const RunRecord& record) = nullptr;
  /// Of one that can be resumed: names of RunProgress::stage, as restart files have them.
  std::vector<std::string_view> stages = {};
  /// Fits the usual protocol to a bench; null: the same everywhere.
  void (*adapt)(Protocol& protocol, const UsualBench& bench) = nullptr;
  /// Of one that is pictured, where its camera stands; null, or none: far away.
  std::optional<LevelCamera> (*camera)(const Protocol& protocol) = nullptr;
  /// The picture that some of its readings are measured in; null: there is none.
  BoxesFront (*front)(const Protocol& protocol) = nullptr;
  /// What moves in it; null: single grains.
  ClumpShape (*body)(const ClumpShape& grain, const Protocol& protocol) = nullptr;
  /// The free fall that ends as fast as its fastest impact, m; of one in air, that of the bench.
  double (*fall_m)(const ClumpShape& grain, const Protocol& protocol) = nullptr;
  /// What its value may be, in its unit: anything else is no reading but a fault of the run.
  Range (*possible)(const Model& model, const Protocol& protocol) = nullptr;
  /// A bench reads no less than this fraction of the most that is possible.
  double least_of_possible = 0;
  /// About how long a run takes on a core of 2020 or so, s: from the model (all coefficients with a
  /// value) and the protocol alone, the same on every machine. Only ratios matter much.
  double (*cost_s)(const Model& model, const Protocol& protocol) = nullptr;
  /// By what factor grains may be larger, fewer of them in its vessels, so that a run costs much
  /// less and still says what depends on what; none: by none. Null: nor ever.
  std::optional<double> (*coarse_size)(const ClumpShape& grain, const Protocol& protocol) = nullptr;
  /// Makes the protocol one of grains that much larger. Null where coarse_size is.
  void (*coarsen)(Protocol& protocol, double size) = nullptr;
};

/// All of them, in the order in which they are listed.
std::span<const ExperimentEntry> all_experiments();

/// The one that has this kind of protocol. @throws std::logic_error  there is none.
const ExperimentEntry& entry_of(const std::type_info& protocol);
const ExperimentEntry& entry_of(const Protocol& protocol);
template <typename Kind>
Experiment experiment_of() {
  return &entry_of(typeid(Kind));
}

/// The one that is measured in pictures: a study has pictures of no other.
const ExperimentEntry& pictured_experiment();

/// Null for a name that there is not.
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

/// What is wrong with a protocol as run_drop() and the others say it, with the keys of the study
/// file added: nobody has to guess that a size was never given, or what it is called there.
base::InputError with_study_keys(const base::InputError& error, const Protocol& protocol);

/// One of entry.readings, by its name.
const Reading& reading_named(const ExperimentEntry& entry, std::string_view name);

/// What a bench can read in a unit: lengths, angles and counts are 0 or more, angles at most 90.
Range readable_in(std::string_view unit);

/// Whether a coefficient of the study moves the experiment's readings.
bool depends_on(const ExperimentEntry& entry, std::string_view coefficient);

/// A step of a grain of a bulk takes about so long, s, on the core that cost_s is of: with it, a
/// bulk's cost_s says how many grain steps there are to do.
double bulk_step_s(const Model& model);

/// Grains touch each other in it: it needs the coefficients between them.
bool has_grain_contacts(Experiment experiment);

}  // namespace repose::dem
