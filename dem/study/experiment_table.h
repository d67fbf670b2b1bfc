#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/input_error.h"
#include "dem/experiment/experiment.h"
#include "dem/study/protocol_key.h"
#include "dem/study/range.h"

/// What there is to know about each experiment, an entry each. Study files, reports, the fit and
/// the store of runs ask here.
namespace repose::dem {

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
};

/// By how much all readings of a bench may differ from the simulation for a reason that is known,
/// and that more of them do not help against.
struct SystematicFraction {
  std::string_view name = "";  ///< as results call it: "pouring_rate"
  double sd = 0;               ///< standard uncertainty as a fraction of the reading
  std::string_view note = "";  ///< the reason, and what would help
};

/// What a bench writes down of it, a row for each repeat: the columns of a test of `repose bench`.
struct BenchSheet {
  std::string_view test;   ///< "restitution"
  std::string_view value;  ///< the column with the experiment's value: "rebound_mm"
  /// Columns that repeat keys of the protocol, in their unit: {"drop_mm", "height_mm"}.
  std::vector<std::pair<std::string_view, std::string_view>> protocol = {};
};

/// A key of the protocol that films show and sheets need not have.
struct FilmedSetting {
  std::string_view column;  ///< of what a film gives: "rate_deg_s"
  std::string_view key;
  double tolerance = 0;  ///< how far they may differ, as a fraction of the key's value
};

struct ExperimentEntry {
  Experiment experiment = Experiment::drop;
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
  bool is_filmed = false;     ///< a film of it on the bench gives a row of its sheet, or a picture
  std::vector<FilmedSetting> filmed_settings = {};
  /// How many readings of a bench a run's number is the mean of; null: one.
  int (*readings_per_run)(const Protocol& protocol) = nullptr;
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

  Protocol usual;  ///< with the usual values of all keys
  std::vector<ProtocolKey> (*keys)(Protocol& protocol) = nullptr;
  Repeat (*run)(const Model& model, const Protocol& protocol, std::uint64_t seed,
                const ProgressReport& report, const RunRecord& record) = nullptr;
  /// Goes on with an interrupted run; null: it starts again.
  Repeat (*resume)(const Model& model, const Protocol& protocol, std::uint64_t seed,
                   const HeapRestart& from, const ProgressReport& report,
                   const RunRecord& record) = nullptr;
  /// What its value may be, in its unit: anything else is no reading but a fault of the run.
  Range (*possible)(const Model& model, const Protocol& protocol) = nullptr;
  /// About how long a run takes on a core of 2020 or so, s: from the model (all coefficients with a
  /// value) and the protocol alone, the same on every machine. Only ratios matter much.
  double (*cost_s)(const Model& model, const Protocol& protocol) = nullptr;
};

/// All of them, in the order of Experiment.
std::span<const ExperimentEntry> all_experiments();

const ExperimentEntry& entry_of(Experiment experiment);
const ExperimentEntry& entry_of(const Protocol& protocol);

/// Null for a name that there is not.
const ExperimentEntry* find_experiment(std::string_view name);
/// @throws base::InputError  there is no such experiment.
const ExperimentEntry& experiment_named(std::string_view name);
/// All, as in "drop, tilt or roll".
std::string experiment_names();

std::string name_of(Experiment experiment);

/// What is wrong with a protocol as run_drop() and the others say it, with the keys of the study
/// file added: nobody has to guess that a size was never given, or what it is called there.
base::InputError with_study_keys(const base::InputError& error, const Protocol& protocol);

/// What a bench can read in a unit: lengths, angles and counts are 0 or more, angles at most 90.
Range readable_in(std::string_view unit);

/// Whether a coefficient of the study moves the experiment's readings.
bool depends_on(const ExperimentEntry& entry, std::string_view coefficient);

/// Grains touch each other in it: it needs the coefficients between them.
bool has_grain_contacts(Experiment experiment);

}  // namespace repose::dem
