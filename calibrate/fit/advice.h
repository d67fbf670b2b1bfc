#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "calibrate/fit/joint_fit.h"
#include "calibrate/fit/problem.h"
#include "calibrate/fit/solution.h"

namespace repose::calibrate {

/// For each parameter, predicted by linear Bayes over the plausible sets: Goldstein and Wooff
/// (2007), Bayes Linear Statistics. `spent_s`: core time of the runs so far, above 0. Formulae and
/// reasons: THEORY.md, "What would narrow it". Proved by Narrowing.* in tests/calibrate.
std::vector<Narrowing> narrowing_of(const Solution& solution, double spent_s);

/// Removing this fraction of a parameter's variance is worth the effort.
inline constexpr double kWorthwhile = .3;
/// `left`: fraction of its standard deviation that remains.
inline bool is_worthwhile(double left) { return 1 - left * left > kWorthwhile; }

/// Four times as many readings halve the uncertainty of their mean.
inline constexpr int kMoreReadings = 4;

/// Likewise for each parameter: the width of its interval, relative to its present width, with
/// kMoreReadings times the readings of one observable.
std::vector<double> narrowing_by_readings(const Solution& solution, std::size_t observable);

/// What would determine a parameter.
struct Advice {
  std::string text;                      ///< one sentence or two
  std::vector<std::string> experiments;  ///< to add to the study
};

/// What would determine each parameter that the data leave open; in the problem's order.
class Advisor {
 public:
  /// Learns the readings that a bench could have given but that were not measured.
  /// @param exact  Narrowing::exact of each parameter
  Advisor(const Problem& problem, const std::vector<Run>& runs, const Solution& solution,
          std::vector<double> exact);

  /// `is_bounded`: its interval lies inside its bounds.
  Advice advice(std::size_t parameter, bool is_bounded) const;

 private:
  /// Something a bench could measure: its reading at every plausible set, and how precise it is.
  struct Measurement {
    std::vector<double> readings;
    double noise2 = 0;  ///< variance of the measured mean and of the surrogate, mean over the sets
  };
  struct Unmeasured {
    std::string experiment;
    std::string reading;
    Measurement of_ten = {};
  };
  /// The one that removes most of a parameter's variance.
  struct Best {
    const Unmeasured* unmeasured = nullptr;  ///< null: none is worth the effort
    double fraction = 0;
  };

  /// Adds the readings expected from ten trials, if enough runs have them.
  void learn_unmeasured(const Experiment& experiment, const std::string& reading,
                        const std::vector<Run>& runs, std::vector<Unmeasured>& all) const;
  double fraction_explained(const Measurement& measurement, std::size_t parameter) const;
  Best best_of(const std::vector<Unmeasured>& all, std::size_t parameter) const;

  /// Each returns part of a sentence, or an empty string.
  std::string unmeasured_advice(std::size_t parameter) const;
  std::string more_readings_advice(std::size_t parameter) const;
  std::string unmade_advice(std::size_t parameter) const;
  std::string more_runs_advice(std::size_t parameter) const;

  /// Experiments to add: the best of those that were simulated, otherwise those that identify it.
  Advice addition_advice(std::size_t parameter) const;

  const Problem& problem_;
  const Solution& solution_;
  std::vector<double> exact_;
  std::vector<Unmeasured> unmeasured_;  ///< of the measured experiments
  std::vector<Unmeasured> offered_;     ///< of experiments that the study does not have
  /// narrowing_by_readings() of each observable.
  std::vector<std::vector<double>> more_readings_;
};

}  // namespace repose::calibrate
