#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibrate/statistics/bench/bench.h"

namespace repose::calibrate {

using ReadingValues = std::span<const double>;

/// What comes out of a test.
struct MethodOutput {
  std::string name;
  std::string unit;
  std::string what;
  std::function<double(ReadingValues)> of;
  /// The mean cannot lie below or above these; its interval may reach over when repeats are few.
  double least = 0;
  double greatest = std::numeric_limits<double>::infinity();
};

/// How a test is worked out.
struct Method {
  std::string source;
  std::vector<ReadingColumn> columns;
  std::vector<MethodOutput> outputs;
  /// What is wrong with a reading whose single values are all possible: "what. Fix: ...".
  std::function<std::optional<std::string>(ReadingValues)> error;
  /// What the number is and is not; always said.
  std::string validity;
};

Method restitution_method();
Method sliding_method();
Method rolling_method();
Method density_method();
Method young_method();
Method poisson_method();
Method size_method();
Method heap_method();
Method drop_on_grains_method();
Method tilt_on_grains_method();
Method roll_on_grains_method();
Method fill_method();
Method pendulum_method();
Method draw_down_method();

}  // namespace repose::calibrate
