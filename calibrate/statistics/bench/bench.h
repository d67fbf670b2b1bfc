#pragma once

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/statistics/summary.h"

/// Bench tests: raw readings in, the quantity with its scatter and interval out.
namespace repose::calibrate {

enum class BenchTest {
  restitution,
  sliding,
  rolling,
  density,
  young,
  poisson,
  size,
  heap,
  drop_on_grains,
  tilt_on_grains,
  roll_on_grains,
  fill,
  pendulum,
  draw_down
};

/// All of them, in the order of the enum.
inline constexpr std::array<std::string_view, 14> kBenchTestNames = {
    "restitution",    "sliding", "rolling",  "density",        "young",
    "poisson",        "size",    "heap",     "drop_on_grains", "tilt_on_grains",
    "roll_on_grains", "fill",    "pendulum", "draw_down"};

/// Something that is read off in a test. A reading must lie between `above` and `below`.
struct ReadingColumn {
  std::string name;  ///< with its unit: "drop_mm"
  std::string what;
  double above = 0;
  double below = std::numeric_limits<double>::infinity();
};

/// The optional column of drops: 1 for heights read in air, 0 for those of a fall without it, as
/// `repose track` writes them.
inline constexpr std::string_view kInAirColumn = "in_air";

/// What one reads in a test, in the order that evaluate_bench wants.
std::vector<ReadingColumn> columns_of(BenchTest test);

/// What may be given beside it: of the grain, or of how it was measured.
std::vector<ReadingColumn> optional_columns_of(BenchTest test);

/// One repeat of a test.
struct BenchReading {
  std::string place;           ///< for messages: "drops.csv:4"
  std::vector<double> values;  ///< in the order and units of the columns
  std::string sample;  ///< repeats on one grain have the same name; empty: a grain of its own
  std::map<std::string, double> optional = {};  ///< of the optional columns, those given
};

/// A column's mean over the repeats on each sample, samples in the order of their first reading.
/// @throws base::InputError  the test has no such column.
std::vector<double> sample_means(BenchTest test, std::string_view column,
                                 std::span<const BenchReading> readings);

/// @throws base::InputError  every impossible reading, a line each: a rebound higher than the
/// drop, an incline of 90 degrees or more, Poisson's ratio outside (-1, 0.5), what is not finite,
/// and so on; an optional column that some readings have and others have not. Checked by
/// tests/calibrate/bench_test.cpp.
void check_readings(BenchTest test, std::span<const BenchReading> readings);

struct BenchQuantity {
  std::string name;  ///< "restitution"
  std::string unit;  ///< empty for a pure number
  std::string what;
  std::vector<double> values;  ///< of each grain
  calibrate::Summary repeats;  ///< of the values; a single one has no sd and no interval
};

struct BenchResult {
  std::vector<BenchQuantity> quantities;
  std::string source;              ///< the equation
  std::vector<std::string> notes;  ///< what to know about these readings, a sentence each
};

/// Works out what each reading gives, averages repeats on the same sample, and summarises: mean,
/// standard deviation, Student's 95 % interval of the mean. Averages first, because repeats on one
/// grain say nothing about how much grains differ.
///
/// @throws base::InputError  as check_readings; or there are no readings.
BenchResult evaluate_bench(BenchTest test, std::span<const BenchReading> readings);

}  // namespace repose::calibrate
