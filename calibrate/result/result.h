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

/// What a finished study found: everything that result.json holds, and what reports and exports are
/// made from. Numbers that do not exist are NaN here and null there.
namespace repose::calibrate {

/// Numbers by name, in an order of their own.
using NamedValues = std::vector<std::pair<std::string, double>>;

/// What files and tables call verdicts.
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

/// Where margins come from.
inline constexpr std::array<std::pair<MarginSource, std::string_view>, 4> kMarginNames = {
    {{MarginSource::study, "study"},
     {MarginSource::reading, "reading"},
     {MarginSource::range, "range"},
     {MarginSource::angle, "angle"}}};

std::string name_of(MarginSource source);

struct HeapDefinition;
/// "whole_flank (least-squares line from toe to crest)", and whether that is assumed.
std::string text_of(const HeapDefinition& definition);
/// "23.90 degrees by it; by outer_window -0.41, whole_flank -1.90"; empty: unknown.
std::string simulated_text(const HeapDefinition& definition);

struct ClumpFacts {
  std::string source;  ///< the scan, or the sizes it was made from
  std::size_t spheres = 0;
  double volume_error = 0;                     ///< relative
  double inertia_error = 0;                    ///< relative
  std::optional<double> size_sd_percent = {};  ///< of bulks; none: grains of one size
};

/// By which definition heaps were measured, on the bench and simulated.
struct HeapDefinition {
  std::string name;           ///< of base/angle_definition.h
  bool is_assumed = false;    ///< the study gives a number and does not say by which
  NamedValues simulated_deg;  ///< what the heaps of the last check read by each; or none
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
  /// What results that do not say were found with.
  std::string damping = dem::name_of(dem::DampingModel::per_contact);
  std::string damping_definition = dem::damping_definition(dem::DampingModel::per_contact);
  ClumpFacts clump;
  NamedValues stiffness_factor;                        ///< of each experiment
  NamedValues shortest_timestep_s;                     ///< of each experiment's runs
  std::optional<HeapDefinition> heap_definition = {};  ///< none: there is no heap
  std::optional<SimulatorFacts> simulator = {};        ///< none: our own engine
};

/// A command of the study's that made runs.
struct EngineFacts {
  std::string command;
  int runs = 0;
  int failed = 0;        ///< of these
  std::string ended_by;  ///< why it made no more: "settled", "max_runs" or "failures"
  int check_runs = 0;    ///< beside these: at the fitted parameters, to check the fit
  int check_failed = 0;  ///< of these
};

/// Runs that somebody made with another program, and gave as a table.
struct TableFacts {
  std::vector<std::string> files;  ///< without their folders
  int rows = 0;                    ///< runs, or means of several
  int failed = 0;                  ///< of these, runs that failed
  int without_reading = 0;         ///< and runs with no reading at all, of which nobody says why
  int left_out = 0;                ///< beside these: outside the bounds, or twice in the table
  std::optional<EngineFacts> engine = {};  ///< that made them, or some of them; none: nobody says
};

/// What coefficients belong to: they mean nothing without it.
struct Provenance {
  StudyIdentity study;
  std::optional<ModelFacts> model;  ///< none: the runs are those of a table
  std::optional<TableFacts> table = {};
  std::vector<std::string> assumed = {};  ///< values that the study marks as not measured
};

struct ResultParameter : FittedParameter {
  Interval bounds;
  std::optional<Prior> known_before;
  std::optional<double> useful_half_width = {};
  std::optional<BoundsOrigin> bounds_are = {};  ///< none: the study does not say
};

struct ResultObservable : FittedObservable {
  /// In simulations with fresh seeds; its name and measured are these. None were made where nobody
  /// checked the runs of a table.
  std::optional<Agreement> verification;
  std::optional<SurrogateCheck> surrogate;  ///< what had been expected of them; its name likewise
  NamedValues systematic = {};  ///< what systematic_uncertainty is made of, in quadrature
};

/// How many readings the bench made, where their scatter was measured.
int bench_readings(const ResultObservable& observable);

/// How bench and simulation agree, over all observables.
struct OverallAgreement {
  std::string text;            ///< the verdict in plain words, a sentence
  double chance = 0;           ///< that all observables together differ so much by chance
  int rounds = 0;              ///< of check and refit
  std::vector<double> values;  ///< the parameters checked last; empty: none were
};

/// A set of parameters that fits as well as the best one.
struct EquivalentSet : ParameterSet {
  std::optional<AgreementVerdict> verdict;  ///< by simulation; none: not simulated
  std::vector<double> simulated;            ///< each observable there; empty: not simulated
};

/// One of several ways to simulate the same bench, each fitted by itself (candidates.h).
struct Candidate {
  std::string name;    ///< of its rolling model
  double means = 0;    ///< score of the differences of means; not finite: a reading is missing
  double scatter = 0;  ///< score of the scatter that the bench does not have
  AgreementVerdict verdict = AgreementVerdict::cannot_tell;
  NamedValues values;  ///< fitted coefficients
};

/// A polynomial through the runs of an observable; none where there are too few for one.
struct ObservableSurface {
  std::string observable;
  std::optional<SurfaceSummary> regression;
};

/// Of fit_jointly(). Vectors of values are in the order of `parameters`, those of observables in
/// the order of `observables`.
struct JointResult {
  std::vector<ResultParameter> parameters;
  std::vector<ResultObservable> observables;
  /// Of the last check with fresh seeds; which parameters it was of is in `agreement`. None: there
  /// was none, and nothing is known but what surfaces through the runs say.
  std::optional<AgreementVerdict> verdict;
  /// Of a study that was interrupted, and that the same command goes on with: where; else empty.
  std::string provisional = {};
  bool is_of_table = false;  ///< another program made the runs: Provenance::table
  OverallAgreement agreement;
  std::vector<Prediction> held_out;  ///< readings that were predicted, not fitted; or none
  std::vector<SensitivityCheck> stiffness_checks;  ///< of softened experiments; or none
  std::vector<MovedCoefficient> stiffer_coefficients;
  std::optional<ShapeCheck> shape_check;  ///< earlier versions made none
  /// What coefficients would be with other scatters than those assumed; empty: none was assumed, or
  /// an earlier version's.
  AssumedScatters assumed_scatters = {};
  std::vector<InputEffect> assumed_inputs;   ///< held fixed; or none
  std::vector<CombinedEffect> with_assumed;  ///< all of them together, beside the intervals
  std::vector<std::string> inputs_taken_as_exact;
  double chi2 = 0;
  std::optional<double> degrees_of_freedom;      ///< of the fit; earlier versions did not say
  std::optional<double> model_error_scale = {};  ///< none: the model was taken to have no error
  std::vector<std::vector<double>> correlation;
  std::vector<std::vector<double>> reading_correlation;
  std::vector<std::vector<double>> bench_correlation;  ///< earlier versions took it for the same
  std::vector<EquivalentSet> equivalence_family;
  std::vector<StudyAddition> additions;  ///< what the advice would have in the study file
  std::vector<Candidate> candidates;     ///< this one and those it was weighed against; or none
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

/// Of calibrate_as_published().
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

/// It is no final one: JointResult::provisional.
bool is_provisional(const StudyResult& result);

/// The same text; numbers that do not exist are equal.
bool operator==(const StudyResult& one, const StudyResult& other);

/// The text of result.json. The same result gives the same bytes.
std::string to_json(const StudyResult& result);

/// @param name  what errors call the text
/// @throws base::InputError  it is no result: which part, and why.
StudyResult result_from_json(const std::string& json, const std::string& name);

/// FOLDER/result.json. None where there is no such file.
/// @throws base::InputError  it is no result: which part, and why.
std::optional<StudyResult> read_result(const std::filesystem::path& folder);

/// Of which study a result is, whatever else is in it. None where the text does not say.
std::optional<StudyIdentity> study_in_result(const std::string& json);

}  // namespace repose::calibrate
