#pragma once

#include <string>
#include <vector>

#include "calibrate/statistics/bench/bench.h"
#include "cli/statistics/bench.h"

namespace repose::cli {

/// A `repose bench` worked out, but for its output.
struct BenchPlan {
  calibrate::BenchTest test = calibrate::BenchTest::restitution;
  std::vector<calibrate::BenchReading> readings;
  calibrate::BenchResult result;
  std::string json_file;
  std::vector<std::string> notes;  ///< on the tables; the result has them too

  std::vector<std::string> errors;  ///< empty: it can be carried out
};

/// Reads all that was typed and the tables that it names, and evaluates them. All errors at once.
BenchPlan plan_bench(const BenchArguments& arguments);

}  // namespace repose::cli
