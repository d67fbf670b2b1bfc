#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "calibrate/fit/assumed_scatter.h"
#include "calibrate/fit/input_effects.h"
#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/prediction.h"
#include "calibrate/fit/problem.h"
#include "calibrate/fit/sensitivity_check.h"
#include "calibrate/published/published_method.h"
#include "calibrate/result/surface_summary.h"
#include "calibrate/study/study_record.h"
#include "calibrate/study/study_run.h"
#include "dem/contact/model_names.h"

/// The results of a finished study: the content of result.json, and the source of reports and
/// exports. Missing numbers are NaN here and null there.
namespace repose::calibrate {

/// Numbers by name, in a fixed order.
using NamedValues = std::vector<std::pair<std::string, double>>;

/// Names of verdicts in files and tables.
inline constexpr std::array<std::pair<Verdict, std::string_view>, 4> kVerdictNames = {
    {{Verdict::determined, "determined"},
     {Verdict::bounded, "bounded"},
     {Verdict::one_sided, "one-sided"},
     {Verdict::undetermined, "undetermined"}}};

std::string name_of(Verdict verdict);

inline constexpr std::array<std::pair<AgreementVerdict, std::string_view>, 3> kAgreementNames = {
    {{AgreementVerdict::agrees, "agrees"},
     {AgreementVerdict::disagrees, "disagrees"},
     {AgreementVerdict::cannot_tell, "cannot tell"}}};

std::string name_of(AgreementVerdict verdict);

inline constexpr std::array<std::pair<BoundsOrigin, std::string_view>, 2> kBoundsNames = {
    {{BoundsOrigin::known, "known"}, {BoundsOrigin::convenience, "convenience"}}};

std::string name_of(BoundsOrigin origin);

/// Sources of margins.
inline constexpr std::array<std::pair<MarginSource, std::string_view>, 4> kMarginNames = {
    {{MarginSource::study, "study"},
     {MarginSource::reading, "reading"},
     {MarginSource::range, "range"},
     {MarginSource::angle, "angle"}}};

std::string name_of(MarginSource source);

struct HeapDefinition;
/// "whole_flank (least-squares line from toe to crest)", and whether it is assumed.
std::string text_of(const HeapDefinition& definition);
/// "23.90 degrees by it; by outer_window -0.41, whole_flank -1.90"; empty: unknown.
std::string simulated_text(const HeapDefinition& definition);

struct ClumpFacts {
  std::string source;  ///< the scan, or the sizes it was made from
  std::size_t spheres = 0;
  double volume_error = 0;                     ///< relative
  double inertia_error = 0;                    ///< relative
  std::optional<double> size_sd_percent = {};  ///< of bulks; std::nullopt: grains of one size
};

/// The definition by which heaps were measured, on the bench and in simulations.
struct HeapDefinition {
  std::string name;           ///< in base/angle_definition.h
  bool is_assumed = false;    ///< the study gives a number without its definition
  NamedValues simulated_deg;  ///< angle of the last check's heaps by each; may be empty
};

/// Another program that made the runs of a study.
struct SimulatorFacts {
  std::string name;                           ///< "LIGGGHTS-PUBLIC 3.8.0, 2 processes"
  std::vector<std::string> differences = {};  ///< from our own engine, a sentence each
};

/// How the study was simulated, by this program or for it.
struct ModelFacts {
  std::uint64_t first_seed = 0;
  std::string contact_model;
  std::string rolling_model;
  std::string rolling_definition;
  /// Default for results that do not state it.
  std::string damping = dem::name_of(dem::DampingModel::per_contact);
  std::string damping_definition = dem::damping_definition(dem::DampingModel::per_contact);
  ClumpFacts clump;
  NamedValues stiffness_factor;                        ///< of each experiment
  NamedValues shortest_timestep_s;                     ///< of each experiment's runs
  std::optional<HeapDefinition> heap_definition = {};  ///< std::nullopt: no heap
  std::optional<SimulatorFacts> simulator = {};        ///< std::nullopt: our own engine
};

/// A command in the study that made runs.
struct EngineFacts {
  std::string command;
  int runs = 0;
  int failed = 0;        ///< of these
  std::string ended_by;  ///< why it stopped: "settled", "max_runs" or "failures"
  int check_runs = 0;    ///< in addition, at the fitted parameters, to check the fit
  int check_failed = 0;  ///< of these
};

/// Runs made with another program and given as a table.
struct TableFacts {
  std::vector<std::string> files;          ///< without their folders
  int rows = 0;                            ///< runs, or means of several
  int failed = 0;                          ///< of these, runs that failed
  int without_reading = 0;                 ///< and runs without any reading, for no stated reason
  int left_out = 0;                        ///< in addition: outside the bounds, or duplicates
  std::optional<EngineFacts> engine = {};  ///< that made all or some of them; std::nullopt: unknown
};

/// What the coefficients were obtained from; they are meaningless without it.
struct Provenance {
  StudyIdentity study;
  std::optional<ModelFacts> model;  ///< std::nullopt: the runs are from a table
  std::optional<TableFacts> table = {};
  std::vector<std::string> assumed = {};  ///< values marked as not measured in the study
};

struct ResultParameter : FittedParameter {
  Interval bounds;
  std::optional<Prior> known_before;
  std::optional<double> useful_half_width = {};
  std::optional<BoundsOrigin> bounds_are = {};  ///< std::nullopt: not stated in the study
};

struct ResultObservable : FittedObservable {
  /// In simulations with fresh seeds; its name and measured value are those above. std::nullopt if
  /// the runs of a table were not checked.
  std::optional<Agreement> verification;
  std::optional<SurrogateCheck> surrogate;  ///< their predictions; its name likewise
  NamedValues systematic = {};  ///< parts of systematic_uncertainty, added in quadrature
};

/// Number of readings on the bench, if their scatter was measured.
int bench_readings(const ResultObservable& observable);

/// Agreement of bench and simulation over all observables.
struct OverallAgreement {
  std::string text;   ///< the verdict in plain words, a sentence
  double chance = 0;  ///< probability that all observables together differ this much by chance
  int rounds = 0;     ///< of check and refit
  std::vector<double> values;  ///< the parameters checked last; empty: none were
};

/// A set of parameters that fits as well as the best one.
struct EquivalentSet : ParameterSet {
  std::optional<AgreementVerdict> verdict;  ///< by simulation; std::nullopt: not simulated
  std::vector<double> simulated;            ///< each observable there; empty: not simulated
};

/// One of several ways to simulate the same bench, each fitted separately (candidates.h).
struct Candidate {
  std::string name;    ///< of its rolling model
  double means = 0;    ///< score of the differences of means; not finite: a reading is missing
  double scatter = 0;  ///< score of the scatter in excess of the bench's
  AgreementVerdict verdict = AgreementVerdict::cannot_tell;
  NamedValues values;  ///< fitted coefficients
};

/// A polynomial through the runs of an observable; std::nullopt if there are too few.
struct ObservableSurface {
  std::string observable;
  std::optional<SurfaceSummary> regression;
};

/// Result of fit_jointly(). Vectors of values are in the order of `parameters`, those of
/// observables in the order of `observables`.
struct JointResult {
  std::vector<ResultParameter> parameters;
  std::vector<ResultObservable> observables;
  /// Of the last check with fresh seeds; the parameters checked are in `agreement`. std::nullopt:
  /// there was none, and only surfaces through the runs are known.
  std::optional<AgreementVerdict> verdict;
  /// For an interrupted study, which the same command continues: where it stopped; otherwise empty.
  std::string provisional = {};
  bool is_of_table = false;  ///< another program made the runs: Provenance::table
  OverallAgreement agreement;
  std::vector<Prediction> held_out;                ///< readings predicted, not fitted; may be empty
  std::vector<SensitivityCheck> stiffness_checks;  ///< of softened experiments; may be empty
  std::vector<MovedCoefficient> stiffer_coefficients;
  std::optional<ShapeCheck> shape_check;  ///< earlier versions made none
  /// The coefficients for scatters other than those assumed; empty: none was assumed, or the result
  /// is of an earlier version.
  AssumedScatters assumed_scatters = {};
  std::vector<InputEffect> assumed_inputs;   ///< held fixed; may be empty
  std::vector<CombinedEffect> with_assumed;  ///< all of them together, compared with the intervals
  std::vector<std::string> inputs_taken_as_exact;
  double chi2 = 0;
  std::optional<double> degrees_of_freedom;  ///< of the fit; missing in earlier versions
  std::optional<double> model_error_scale =
      {};  ///< std::nullopt: the model was assumed to have no error
  std::vector<std::vector<double>> correlation;
  std::vector<std::vector<double>> reading_correlation;
  std::vector<std::vector<double>> bench_correlation;  ///< the same in earlier versions
  std::vector<EquivalentSet> equivalence_family;
  std::vector<StudyAddition> additions;  ///< suggested additions to the study file
  std::vector<Candidate> candidates;     ///< this one and those it was compared with; may be empty
  std::vector<std::string> warnings;
  std::vector<SurrogateQuality> surrogates;  ///< without warp and length scales
  std::vector<RoundSummary> rounds;
  std::vector<ResponseCurve> responses;   ///< simulated values to six digits
  std::vector<ResponseSurface> surfaces;  ///< simulated values to six digits
  std::vector<ObservableSurface> regressions;
  std::vector<Run> runs;
};

struct PublishedVerification {
  std::vector<PublishedHeap> heaps;
  std::optional<double> mean_deg;
  std::optional<double> sd_deg;
  double measured_deg = 0;
};

/// Result of calibrate_as_published().
struct PublishedResult {
  NamedValues values;
  std::vector<PublishedSweep> sweeps;
  std::vector<PublishedHeap> steepest_ascent;
  std::vector<PublishedHeap> composite;
  SurfaceSummary error_surface;
  double least_error_percent = 0;
  PublishedVerification verification;
  std::vector<SurfaceDiagnostic> warnings;
};

struct StudyResult {
  Provenance provenance;
  std::variant<JointResult, PublishedResult> found;
};

StudyResult result_of(const StudyRecord& record, const StudyProblem& problem,
                      const StudyOutcome& outcome);
StudyResult result_of(const StudyRecord& record, const StudyProblem& problem,
                      const PublishedOutcome& outcome);
StudyResult result_of(const StudyRecord& record, const StudyProblem& problem,
                      const ProvisionalOutcome& outcome);

/// Whether it is not final: JointResult::provisional.
bool is_provisional(const StudyResult& result);

/// Whether the texts are the same; missing numbers are equal.
bool operator==(const StudyResult& one, const StudyResult& other);

/// The text of result.json. The same result gives the same bytes.
std::string to_json(const StudyResult& result);

/// @param name  name of the text in error messages
/// @throws base::InputError  it is not a valid result; says which part, and why.
StudyResult result_from_json(const std::string& json, const std::string& name);

/// Reads FOLDER/result.json; std::nullopt if there is no such file.
/// @throws base::InputError  it is not a valid result; says which part, and why.
std::optional<StudyResult> read_result(const std::filesystem::path& folder);

/// The study that a result is of, whatever else is in the text. std::nullopt if it is not stated.
std::optional<StudyIdentity> study_in_result(const std::string& json);

}  // namespace repose::calibrate
