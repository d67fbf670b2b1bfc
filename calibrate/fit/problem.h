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

/// Prior knowledge of a parameter: a normal distribution.
struct Prior {
  double mean = 0;
  double sd = 0;
};

/// What bounds mean: no such value lies outside, or only a convenient range to search.
enum class BoundsOrigin { known, convenience };

/// A coefficient to be found between two bounds.
struct Parameter {
  std::string name;  ///< "contact.particle_wall.restitution"
  double min = 0;
  double max = 0;
  std::optional<Prior> prior;
  /// Experiments that identify it, made or not: advised if it stays undetermined.
  std::vector<std::string> identified_by = {};
  /// A 95 % interval of this half-width makes it determined, whatever its value.
  std::optional<double> useful_half_width = {};
  std::optional<BoundsOrigin> bounds_are = {};  ///< std::nullopt: not stated
};

/// A change to a number of the study that is not fitted.
struct InputStep {
  std::string input;  ///< its name; empty: none
  double change = 0;  ///< in its unit
  double work = 1;    ///< of a run with it, as a multiple of the usual

  auto operator<=>(const InputStep&) const = default;
};

/// What a study assumes besides its coefficients, as multiples of the stated values: all 1, and no
/// step, where nothing is changed.
struct AssumedInputs {
  double stiffness = 1;  ///< of grains and walls
  double spheres = 1;    ///< of the clump that represents a grain
  InputStep step = {};
  double size = 1;  ///< of each grain, in vessels that stay the same: fewer fill them

  auto operator<=>(const AssumedInputs&) const = default;
};

/// Something that can be simulated. Without an observable it is never run, but may be advised.
struct Experiment {
  std::string name;                     ///< "drop", "tilt", "roll", "heap"
  std::vector<std::size_t> parameters;  ///< indices in Problem::parameters of those with an effect
  /// Approximate duration of a full run, s. Rounds are planned with it: the same throughout a
  /// study.
  double run_s = 1;
  bool is_stochastic = true;  ///< false: the seed changes nothing, one run is enough
  /// Readings that a bench could give too. The advice chooses from those not measured.
  std::vector<std::string> measurable = {"value"};
  /// Number of bench readings that a run's reading is the mean of: ten for ten grains dropped. A
  /// single one scatters more, by the square root of that number.
  int readings_per_run = 1;
  /// The reading that gives the standard deviation of a bench's "value" within what one run
  /// averages, in addition to the scatter between runs: a photograph from one side, while runs are
  /// viewed from many. Empty: none.
  std::string scatter_within = {};
  /// That of real grains, as a multiple of the study's.
  double real_stiffness = 1;
  /// Fraction of run_s that scales with the number of spheres.
  double spheres_share = 0;
  /// Factor in run_s because each step of each of many grains takes longer than of as few as coarse
  /// runs have.
  double many_grains = 1;
  /// Of a bench's "value": standard uncertainty common to all readings, as a fraction of it.
  /// Observables have it in their systematic_sd.
  double systematic_fraction = 0;
  /// In addition, the common uncertainty that the study states, in its unit.
  double systematic_sd = 0;
  /// Assumed scatter of single bench readings if it was not measured, as a fraction of their mean.
  double usual_scatter = .05;
  /// Possible model error as a fraction of any bench's reading: Observable::model_sd.
  double model_fraction = 0;
  double size_fraction = 0;  ///< part of it due to larger grains in full runs: Observable::size_sd
  /// Full runs, which the fit predicts and checks: larger grains if runs of the study's own would
  /// take too long, with what that may change in model_fraction.
  AssumedInputs full = {};
  /// Coarse runs: cheaper, with an offset learned from full runs. std::nullopt: it has none.
  std::optional<AssumedInputs> coarse = {};

  bool is_coarse(const AssumedInputs& inputs) const { return coarse && inputs == *coarse; }
  /// Of most of its runs: coarse ones if it has any.
  AssumedInputs usual_inputs() const { return coarse.value_or(full); }
};

/// A part of the uncertainty of a measured mean that is common to all its readings.
struct SystematicPart {
  std::string name;       ///< "bias_sd", "air_drag"
  double sd = 0;          ///< standard uncertainty, in the unit of the readings
  std::string note = {};  ///< what it is and what would lower it; follows the observable's name
};

/// The spheres that represent a grain.
struct GrainSpheres {
  int count = 1;
  int most = 1;                ///< number that can follow its shape closer; `count`: none can
  std::string no_closer;       ///< why none can: "one sphere is exactly its shape"
  bool share_damping = false;  ///< contacts of one pair of bodies
};

/// One number measured on the bench: the mean of n readings.
struct Observable {
  std::string name;               ///< unique; shown to users
  std::string experiment;         ///< an Experiment's name
  std::string reading = "value";  ///< or another reading of that experiment: "base_radius_mm"
  std::string unit;               ///< "mm", "deg"
  double mean = 0;
  std::optional<double>
      sd;     ///< of single readings, measured; needs n of at least 2, or to be known
  int n = 1;  ///< readings
  /// In place of `sd` if none is known: the sd of single readings as a fraction of |mean|. Assumed
  /// by the caller, and reported in the result.
  std::optional<double> assumed_sd_fraction;
  /// Standard uncertainty of any correction added to the mean, apart from that of the readings.
  double shift_sd = 0;
  /// Standard uncertainty common to all readings: more readings do not lower it.
  double systematic_sd = 0;
  /// Its parts, added in quadrature.
  std::vector<SystematicPart> systematic = {};
  /// Standard deviation of the model's error in the reading at the best possible coefficients,
  /// given its clump and its contact laws: known beforehand.
  double model_sd = 0;
  /// Part of it that is there because no run has the study's own grains: unlike the rest, it leaves
  /// open what these would read.
  double size_sd = 0;
  bool has_own_trials = false;  ///< on the bench: its scatter is independent of other readings
  /// A difference between bench and simulation up to this does not matter; see margin_of().
  std::optional<double> tolerance = {};
  /// Range that a bench can read. A simulated reading may lie outside, e.g. of a grain that stays
  /// on the incline; the reachable range is reported within it.
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  /// `sd` is not from these n readings, but from others like them: n may be 1.
  bool is_sd_known = false;
};

/// Budget and options of the fit.
struct FitSettings {
  double budget_s = 3600;  ///< sum of Experiment::run_s over all proposed jobs
  int max_jobs = 2000;
  int max_rounds = 6;      ///< the first included
  std::uint64_t seed = 1;  ///< of the jobs, which count up from it, and of the fit's random numbers
  bool are_runs_given = false;  ///< made by somebody else: there is no budget to enlarge
  bool robust = false;          ///< Cauchy's loss: an observable that fits no other counts less
};

/// One simulation to be run.
struct Job {
  std::string experiment;
  /// One for each of Problem::parameters, in their units. Those without effect on the experiment
  /// are at the middle of their bounds, so that equal jobs are equal. Rounded to decimals of about
  /// a millionth of the bounds' distance: unchanged when written with 15 digits and read back.
  std::vector<double> values;
  std::uint64_t seed = 1;
  AssumedInputs inputs = {};

  bool operator==(const Job&) const = default;
};

/// No bench reading is larger: millimetres, degrees, counts. Much larger ones would overflow when
/// squared, and a fit of such runs would never end.
inline constexpr double kMaxReading = 1e9;

/// A completed job.
struct Run {
  Job job;
  /// By name; the experiment's main reading is called "value". Empty if it failed.
  std::map<std::string, double> readings;
  std::string failure;  ///< why there is no reading ("the grains stay in the tube"); or empty
  int repeats = 1;      ///< runs with different seeds that the readings are means of
  /// The sd of single repeats, by the reading's name, if known.
  std::map<std::string, double> repeat_sd = {};
  /// Standard uncertainty of a reading itself, in addition to the run's random variation, by its
  /// name: e.g. of an angle measured in a picture of the run.
  std::map<std::string, double> reading_sd = {};
};

/// An experiment that the study does not have. If it was simulated anyway, the advice says what its
/// readings would be worth.
struct Offer {
  Experiment experiment;
  std::string study_lines;   ///< its section of the study file
  std::vector<Run> runs;     ///< spread over the bounds, each once, in a fixed order; may be empty
  std::string heading = {};  ///< what to add; empty: "[experiment.NAME]"
};

/// A number of the study that is not fitted, and its uncertainty.
struct FixedInput {
  std::string name;  ///< "experiment.roll.incline_deg"
  std::string unit;
  double value = 0;
  double sd = 0;                         ///< standard uncertainty
  bool is_assumed = false;               ///< nobody stated it
  InputStep step = {};                   ///< of size sd, up or down
  std::vector<std::string> experiments;  ///< experiments it can affect
};

/// Parameters to be found, what was measured, and what can be simulated.
struct Problem {
  std::vector<Parameter> parameters;
  std::vector<Observable> observables;
  std::vector<Experiment> experiments;
  FitSettings settings;
  std::vector<Offer> offers = {};
  /// Measured, but of experiments without any observable: predicted from the fit (prediction.h).
  std::vector<Observable> held_out = {};
  GrainSpheres spheres = {};
  std::vector<FixedInput> fixed_inputs = {};
};

/// Every error of a problem. Empty if there is none.
std::vector<base::Fault> errors_of(const Problem& problem);

/// Throws base::InputError with every error of the problem, one per line.
void require_sound(const Problem& problem);

/// Whether a 95 % interval of this half-width is narrow enough for a single value: at most a
/// quarter of the value, or the parameter's useful_half_width.
bool leaves_one_value(const Parameter& parameter, double value, double half_width);

/// Standard uncertainty of an observable's mean from the scatter of its readings, in its unit: sd /
/// sqrt(n).
double standard_uncertainty(const Observable& observable);

/// Degrees of freedom of that: infinite if the scatter is assumed, or known beforehand.
double degrees_of_scatter(const Observable& observable);

/// Standard uncertainty of the mean, from the scatter of its readings and from their common part.
double with_systematic(const Observable& observable, double by_scatter);

}  // namespace repose::calibrate
