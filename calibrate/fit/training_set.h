#pragma once

#include <string>
#include <vector>

#include "calibrate/fit/points.h"
#include "calibrate/fit/problem.h"
#include "calibrate/fit/surrogate.h"

namespace repose::calibrate {

/// Runs in an order of their own (experiment, values, seed), each job once: sums over them come out
/// the same to the last bit in whatever order they were done. Throws base::InputError for runs
/// of another problem.
std::vector<Run> in_order(const Problem& problem, const std::vector<Run>& runs);

/// Whether chance has a part in an experiment: not in one that is known to have none, nor where its
/// runs show it, as of one ball dropped on a plate: at several places, with several readings,
/// others with other seeds gave the same again. `runs` in_order. Proved by Chance.* in
/// tests/calibrate.
bool has_chance(const Experiment& experiment, const std::vector<Run>& runs);

/// By what a bench's single readings scatter within runs (Experiment::scatter_within): root mean
/// square over those that tell it, 0 where none does.
double sd_within(const Experiment& experiment, const std::string& reading,
                 const std::vector<Run>& runs);

/// The runs of `experiment` that have the reading as a number; without chance one of each place,
/// since others tell no more. `runs` in_order.
TrainingSet training_set_of(const Problem& problem, const Experiment& experiment,
                            const std::string& reading, const std::vector<Run>& runs);

/// How many runs of `experiment` have the reading as a number.
int readings_among(const Experiment& experiment, const std::string& reading,
                   const std::vector<Run>& runs);

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
