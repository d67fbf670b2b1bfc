#pragma once

#include <cstddef>
#include <vector>

#include "calibrate/fit/problem.h"
#include "calibrate/fit/surrogate.h"

namespace repose::calibrate {

/// Indices of the observables of each experiment that has any, in the problem's order.
std::vector<std::vector<std::size_t>> by_experiment(const Problem& problem);

/// How chance moves observables together: correlation of runs at the same place with different
/// seeds, pooled over the places, in the units of the surrogates; shrunk towards zero as by
/// Schaefer and Strimmer (2005), Stat. Appl. Genet. Mol. Biol. 4, 32, since the runs are few. 1 on
/// the diagonal; 0 between experiments, in deterministic ones, and for readings that the bench
/// takes in separate trials. Proved by ReadingCorrelation.* in tests/calibrate.
std::vector<std::vector<double>> reading_correlation_of(const Problem& problem,
                                                        const std::vector<Surrogate>& surrogates);

}  // namespace repose::calibrate
