#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/statistics/bench/bench.h"

namespace repose::calibrate {

constexpr double kM3PerMl = 1e-6;
constexpr double kKgPerG = 1e-3;
constexpr double kRightAngle_deg = 90;

/// A lower bound that 0 itself is above.
constexpr double kFromZero = -1e-300;

/// One repeat of a test, as its formulas use it.
class ReadingValues {
 public:
  ReadingValues(std::span<const double> values, const std::map<std::string, double>& optional)
      : values_(values), optional_(&optional) {}

  /// Of the test's columns.
  double operator[](std::size_t column) const { return values_[column]; }
  /// Of an optional column.
  std::optional<double> given(const std::string& column) const {
    const auto found = optional_->find(column);
    return found == optional_->end() ? std::nullopt : std::optional(found->second);
  }

 private:
  std::span<const double> values_;
  const std::map<std::string, double>* optional_;
};

/// One result of a test.
struct MethodOutput {
  std::string name;
  std::string unit;
  std::string what;
  std::function<double(ReadingValues)> of;
  /// Limits of the mean; its interval may extend beyond them when repeats are few.
  double least = 0;
  double greatest = std::numeric_limits<double>::infinity();
};

/// How a test is evaluated.
struct Method {
  std::string name;
  std::string source;
  std::vector<ReadingColumn> columns;
  std::vector<MethodOutput> outputs;
  /// Error of a reading whose single values are all possible.
  std::function<std::optional<base::Fault>(ReadingValues)> error;
  /// What the number does and does not mean; always reported.
  std::string validity;
  std::vector<ReadingColumn> optional_columns = {};
  /// Further remarks on these readings, a sentence each.
  std::function<std::vector<std::string>(std::span<const ReadingValues>)> remarks = {};
  /// Error of the readings as a whole, each of which is possible.
  std::function<std::optional<base::Fault>(std::span<const ReadingValues>)> error_of_all = {};
};

Method restitution_method();
Method sliding_method();
Method rolling_method();
Method density_method();
Method young_method();
Method poisson_method();
Method size_method();
Method drop_on_grains_method();
Method pendulum_method();

}  // namespace repose::calibrate
