#pragma once

#include <string>
#include <vector>

#include "calibrate/fit/points.h"
#include "calibrate/fit/problem.h"
#include "calibrate/fit/surrogate.h"

namespace repose::calibrate {

/// Runs in an order of their own (experiment, values, seed), each job once: sums over them come out
/// the same to the last bit in whatever order they were done. Throws std::invalid_argument for runs
/// of another problem.
std::vector<Run> in_order(const Problem& problem, const std::vector<Run>& runs);

/// By what a bench's single readings scatter within runs (Experiment::scatter_within): root mean
/// square over those that tell it, 0 where none does.
double sd_within(const Experiment& experiment, const std::string& reading,
                 const std::vector<Run>& runs);

/// The runs of `experiment` that have the reading as a number.
TrainingSet training_set_of(const Problem& problem, const Experiment& experiment,
                            const std::string& reading, const std::vector<Run>& runs);

/// Where an experiment was run, and whether it failed.
struct Attempts {
  std::vector<std::size_t> parameters;
  std::vector<Point> places;
  std::vector<bool> failed;

  int failures() const;
};

Attempts attempts_of(const Problem& problem, const Experiment& experiment,
                     const std::vector<Run>& runs);

}  // namespace repose::calibrate
