#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"

namespace repose::calibrate {

/// What is known of a parameter beforehand: a normal distribution.
struct Prior {
  double mean = 0;
  double sd = 0;
};

/// What bounds are: nothing like it lies outside, or no more than a range to search.
enum class BoundsOrigin { known, convenience };

/// A coefficient that is sought between two bounds.
struct Parameter {
  std::string name;  ///< "contact.particle_wall.restitution"
  double min = 0;
  double max = 0;
  std::optional<Prior> prior;
  /// Experiments that tell it from the others, made or not: what is advised where it stays open.
  std::vector<std::string> identified_by = {};
  /// A 95 % interval of this half-width makes it determined, whatever its value.
  std::optional<double> useful_half_width = {};
  std::optional<BoundsOrigin> bounds_are = {};  ///< none: not said
};

/// A number of the study that no fit seeks, changed.
struct InputStep {
  std::string input;  ///< its name; empty: none
  double change = 0;  ///< in its unit
  double work = 1;    ///< of a run with it, as a multiple

  auto operator<=>(const InputStep&) const = default;
};

/// What a study assumes beside its coefficients, as multiples of what it says: all 1, and no step,
/// in full runs.
struct AssumedInputs {
  double stiffness = 1;  ///< of grains and walls
  double spheres = 1;    ///< of the clump that stands for a grain
  InputStep step = {};
  double size = 1;  ///< of each grain, in vessels that stay as they are: fewer fill them

  auto operator<=>(const AssumedInputs&) const = default;
};

/// What can be simulated. One without an observable is never run, but may be advised.
struct Experiment {
  std::string name;                     ///< "drop", "tilt", "roll", "heap"
  std::vector<std::size_t> parameters;  ///< places in Problem::parameters of those with an effect
  /// One run takes about so long, s. Rounds are planned from it: the same throughout a study.
  double run_s = 1;
  bool is_stochastic = true;  ///< false: the seed changes nothing, one run says it all
  /// Readings that a bench could give too. Those not measured are what the advice chooses from.
  std::vector<std::string> measurable = {"value"};
  /// How many readings of a bench a run's reading is the mean of: ten for ten grains dropped. A
  /// single one scatters by the root of that more.
  int readings_per_run = 1;
  /// The reading that says by what standard deviation a bench's "value" scatters within what a run
  /// is the mean of, beside that of runs: a photograph from one side, where runs are seen from
  /// many. Empty: by none.
  std::string scatter_within = {};
  /// That of real grains, as a multiple of the study's.
  double real_stiffness = 1;
  /// What part of run_s goes with the number of spheres.
  double spheres_share = 0;
  /// Of a bench's "value": standard uncertainty as a fraction of it that all readings have in
  /// common. Observables have it in their systematic_sd.
  double systematic_fraction = 0;
  /// Beside it, what the study states that they share, in its unit.
  double systematic_sd = 0;
  /// By what fraction of their mean single readings of a bench scatter where nobody measured it.
  double usual_scatter = .05;
  /// By what fraction of it the model may miss a reading of any bench: Observable::model_sd.
  double model_fraction = 0;
  /// Of its coarse runs: cheaper ones, off by what full ones beside them tell. None: it has none.
  std::optional<AssumedInputs> coarse = {};

  bool is_coarse(const AssumedInputs& inputs) const { return coarse && inputs == *coarse; }
  /// Of most of its runs: coarse ones where it has any.
  AssumedInputs usual_inputs() const { return coarse.value_or(AssumedInputs{}); }
};

/// A part of the uncertainty of a measured mean that all its readings have in common.
struct SystematicPart {
  std::string name;       ///< "bias_sd", "air_drag"
  double sd = 0;          ///< standard uncertainty, in the unit of the readings
  std::string note = {};  ///< what it is, and what would lower it; to follow the observable's name
};

/// The spheres that stand for a grain.
struct GrainSpheres {
  int count = 1;
  int most = 1;                ///< that can follow its shape closer; `count`: none can
  std::string no_closer;       ///< why none can: "one sphere is exactly its shape"
  bool share_damping = false;  ///< contacts of one pair of bodies
};

/// One number measured on the bench: the mean of n readings.
struct Observable {
  std::string name;               ///< unique; to be shown
  std::string experiment;         ///< an Experiment's name
  std::string reading = "value";  ///< or another reading of that experiment: "base_radius_mm"
  std::string unit;               ///< "mm", "deg"
  double mean = 0;
  std::optional<double>
      sd;     ///< of single readings, measured; needs n of at least 2, or to be known
  int n = 1;  ///< readings
  /// In place of `sd` where none is known: the sd of single readings as a fraction of |mean|.
  /// Assumed by the caller, and said in the result.
  std::optional<double> assumed_sd_fraction;
  /// Standard uncertainty of what was added to the mean, beside that of the readings.
  double shift_sd = 0;
  /// Standard uncertainty that all readings have in common: more readings do not lower it.
  double systematic_sd = 0;
  /// What that is made of, in quadrature.
  std::vector<SystematicPart> systematic = {};
  /// Standard deviation of what the model gets wrong of the reading at the best coefficients that
  /// there are, its clump and its laws being what they are: known beforehand.
  double model_sd = 0;
  bool has_own_trials = false;  ///< on the bench: its chance is that of no other reading
  /// A difference between bench and simulation up to this does not matter; see margin_of().
  std::optional<double> tolerance = {};
  /// What a bench can read. A simulated reading may lie outside, as a grain's that stays on the
  /// incline; what the simulation reaches is told within.
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  /// `sd` is not of these n readings, but of others like them: n may be 1.
  bool is_sd_known = false;
};

/// How much may be spent, and how the fit is made.
struct FitSettings {
  double budget_s = 3600;  ///< sum of Experiment::run_s over all proposed jobs
  int max_jobs = 2000;
  int max_rounds = 6;      ///< the first included
  std::uint64_t seed = 1;  ///< of the jobs, which count on from it, and of the fit's own chance
  bool are_runs_given = false;  ///< somebody else makes them: there is no budget to enlarge
  bool robust = false;          ///< Cauchy's loss: an observable that fits nothing else counts less
};

/// One simulation to be run.
struct Job {
  std::string experiment;
  /// One for each of Problem::parameters, in their units. Those without effect on the experiment
  /// stand at the middle of their bounds, so that equal jobs are equal. Rounded to decimals, a
  /// millionth of the bounds' distance or so: written with 15 digits and read again, the same.
  std::vector<double> values;
  std::uint64_t seed = 1;
  AssumedInputs inputs = {};

  bool operator==(const Job&) const = default;
};

/// No reading of a bench is larger: millimetres, degrees, counts. Far larger ones, squared, are no
/// numbers any more, and a fit of such runs would never end.
inline constexpr double kMaxReading = 1e9;

/// A job that is done.
struct Run {
  Job job;
  /// By name; the experiment's own number is called "value". Empty when it failed.
  std::map<std::string, double> readings;
  std::string failure;  ///< why there is no reading ("the grains stay in the tube"); else empty
  int repeats = 1;      ///< runs with other seeds that the readings are means of
  /// The sd of single ones among these, by the reading's name, where it is told.
  std::map<std::string, double> repeat_sd = {};
  /// Standard uncertainty that a reading has by itself, beside the run's chance, by its name: of an
  /// angle that was measured in a picture of the run.
  std::map<std::string, double> reading_sd = {};
};

/// An experiment that the study does not have. Where it was simulated all the same, the advice says
/// what readings of it would be worth.
struct Offer {
  Experiment experiment;
  std::string study_lines;   ///< its section of the study file
  std::vector<Run> runs;     ///< all over the bounds, each once, in a fixed order; or none
  std::string heading = {};  ///< what to add; empty: "[experiment.NAME]"
};

/// A number of the study that no fit seeks, and how well it is known.
struct FixedInput {
  std::string name;  ///< "experiment.roll.incline_deg"
  std::string unit;
  double value = 0;
  double sd = 0;                         ///< standard uncertainty
  bool is_assumed = false;               ///< nobody stated it
  InputStep step = {};                   ///< by the sd, to either side
  std::vector<std::string> experiments;  ///< that it can move
};

/// Parameters to be found, what was measured, and what can be simulated.
struct Problem {
  std::vector<Parameter> parameters;
  std::vector<Observable> observables;
  std::vector<Experiment> experiments;
  FitSettings settings;
  std::vector<Offer> offers = {};
  /// Measured, but of experiments that no observable is of: predicted from the fit (prediction.h).
  std::vector<Observable> held_out = {};
  GrainSpheres spheres = {};
  std::vector<FixedInput> fixed_inputs = {};
};

/// Every fault of a problem. Empty: none.
std::vector<base::Fault> errors_of(const Problem& problem);

/// Throws base::InputError with every error of the problem, a line each.
void require_sound(const Problem& problem);

/// Whether a 95 % interval of this half-width leaves one value: at most a quarter of it, or what
/// the parameter's useful_half_width calls enough.
bool leaves_one_value(const Parameter& parameter, double value, double half_width);

/// Standard uncertainty of an observable's mean by the scatter of its readings, in its unit: sd /
/// sqrt(n).
double standard_uncertainty(const Observable& observable);

/// By how many degrees of freedom that is known: infinite where the scatter is assumed, or known
/// beforehand.
double degrees_of_scatter(const Observable& observable);

/// That of the mean, by the scatter of its readings and by what they have in common.
double with_systematic(const Observable& observable, double by_scatter);

}  // namespace repose::calibrate
