#pragma once

#include <string>

#include "calibrate/statistics/bench/bench.h"

namespace repose::cli {

/// For people: mean, scatter, interval of each quantity, and what to know about them.
std::string bench_table(const std::string& test, const calibrate::BenchResult& result, int columns);

/// For programs. Numbers that do not exist are null.
std::string bench_json(const std::string& test, const calibrate::BenchResult& result);

}  // namespace repose::cli
