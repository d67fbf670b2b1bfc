#include "calibrate/statistics/bench/bench.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/input_error.h"
#include "calibrate/statistics/bench/method.h"
#include "dem/experiment/experiment_table.h"

namespace repose::calibrate {

double restitution_of(double drop_m, double rebound_m) { return std::sqrt(rebound_m / drop_m); }

double sliding_friction_of(double angle_rad) { return std::tan(angle_rad); }

double rolling_friction_of(double incline_rad, double released_m, double stopped_m) {
  return released_m * std::sin(incline_rad) / (released_m * std::cos(incline_rad) + stopped_m);
}

double foot_distance_m(double incline_rad, double radius_m) {
  return radius_m * std::tan(incline_rad / 2);
}

double rolled_distance_m(double mu_r, double incline_rad, double released_m, double radius_m) {
  const double sine = std::sin(incline_rad);
  const double cosine = std::cos(incline_rad);
  const double foot_m = foot_distance_m(incline_rad, radius_m);
  const double kept = std::max(0., (5 * cosine + 2) / 7 - 5. / 7 * mu_r * sine);
  return kept * kept * (released_m - foot_m) * (sine - mu_r * cosine) / mu_r + foot_m;
}

double rolling_friction_of(double incline_rad, double released_m, double stopped_m,
                           double radius_m) {
  // The distance decreases with friction as long as the ball leaves the foot. Solved by bisection.
  double low = 0;
  double high =
      std::min(std::tan(incline_rad), (std::cos(incline_rad) + .4) / std::sin(incline_rad));
  constexpr int kHalvings = 60;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = .5 * (low + high);
    const bool rolls_on = rolled_distance_m(middle, incline_rad, released_m, radius_m) > stopped_m;
    (rolls_on ? low : high) = middle;
  }
  return .5 * (low + high);
}

double pendulum_restitution_of(double release_rad, double swing_rad) {
  return 2 * std::sin(swing_rad / 2) / std::sin(release_rad / 2) - 1;
}

double density_of(double mass_kg, double displaced_m3) { return mass_kg / displaced_m3; }

double young_modulus_of(double force_n, double area_m2, double compression_m, double height_m) {
  return (force_n / area_m2) / (compression_m / height_m);
}

double poisson_ratio_of(double widening, double width, double shortening, double height) {
  return (widening / width) / (shortening / height);
}

double geometric_mean_diameter_of(double length, double width, double thickness) {
  return std::cbrt(length * width * thickness);
}

double sphericity_of(double length, double width, double thickness) {
  return geometric_mean_diameter_of(length, width, thickness) / length;
}

namespace {

/// For an experiment whose readings are averaged: the settings that its sheet repeats, and its
/// value.
Method mean_method(const dem::ExperimentEntry& entry) {
  const dem::MeanOfReadings& mean = *entry.sheet.mean;
  constexpr double kAny = std::numeric_limits<double>::infinity();
  std::vector<ReadingColumn> columns;
  for (const auto& [column, key] : entry.sheet.protocol) {
    columns.push_back({std::string(column), fmt::format("{} of the experiment", key), -kAny});
  }
  const auto [from, to, excludes_from, excludes_to] = mean.readable;
  const double below_zero = from == 0 ? kFromZero : std::nextafter(from, -kAny);
  columns.push_back({std::string(entry.sheet.value), std::string(mean.what),
                     excludes_from ? from : below_zero,
                     excludes_to ? to : std::nextafter(to, kAny)});
  const std::size_t value = columns.size() - 1;
  return {.name = std::string(entry.sheet.test),
          .source = std::string(mean.source),
          .columns = std::move(columns),
          .outputs = {{std::string(mean.quantity), std::string(entry.unit),
                       std::string(entry.value_name), [value](ReadingValues v) { return v[value]; },
                       from, to}},
          .error = {},
          .validity = std::string(mean.validity)};
}

const std::vector<Method>& methods() {
  static const std::vector<Method> kMethods = [] {
    std::vector<Method> all = {restitution_method(), sliding_method(),        rolling_method(),
                               density_method(),     young_method(),          poisson_method(),
                               size_method(),        drop_on_grains_method(), pendulum_method()};
    for (const dem::ExperimentEntry& entry : dem::all_experiments()) {
      if (entry.sheet.mean) all.push_back(mean_method(entry));
    }
    return all;
  }();
  return kMethods;
}

std::string range_of(const ReadingColumn& column) {
  const std::string least =
      column.above < 0 ? "0 or more" : fmt::format("more than {:g}", column.above);
  if (column.below == std::numeric_limits<double>::infinity()) {
    return column.above == -column.below ? "finite" : least;
  }
  return fmt::format("{} and less than {:g}", least, column.below);
}

ReadingValues values_of(const BenchReading& reading) { return {reading.values, reading.optional}; }

std::vector<ReadingValues> values_of(std::span<const BenchReading> readings) {
  std::vector<ReadingValues> values;
  for (const BenchReading& reading : readings) values.push_back(values_of(reading));
  return values;
}

bool is_possible(const std::string& place, const ReadingColumn& column, double value,
                 base::Faults& errors) {
  if (value > column.above && value < column.below) return true;  // false for NaN
  errors.add({.where = place,
              .value = fmt::format("{} = {:g}: the {}", column.name, value, column.what),
              .rule = fmt::format("must be {}", range_of(column)),
              .fix = "correct the reading or leave it out."});
  return false;
}

void check_reading(const Method& method, const BenchReading& reading, base::Faults& errors) {
  if (reading.values.size() != method.columns.size()) {
    errors.add({.where = reading.place,
                .value = fmt::format("{} values are given for {} columns", reading.values.size(),
                                     method.columns.size()),
                .fix = "give one for each."});
    return;
  }
  bool are_possible = true;
  for (std::size_t i = 0; i < method.columns.size(); ++i) {
    are_possible &= is_possible(reading.place, method.columns[i], reading.values[i], errors);
  }
  for (const ReadingColumn& column : method.optional_columns) {
    const auto given = reading.optional.find(column.name);
    if (given == reading.optional.end()) continue;
    are_possible &= is_possible(reading.place, column, given->second, errors);
  }
  if (!are_possible || !method.error) return;
  if (auto fault = method.error(values_of(reading))) {
    fault->where = reading.place;
    errors.add(*std::move(fault));
  }
}

/// Results with and without a correction from an optional column have no common mean.
void check_all_or_none(const Method& method, std::span<const BenchReading> readings,
                       base::Faults& errors) {
  for (const ReadingColumn& column : method.optional_columns) {
    const auto lacks = [&](const BenchReading& reading) {
      return !reading.optional.contains(column.name);
    };
    const auto lacking = std::find_if(readings.begin(), readings.end(), lacks);
    if (lacking == readings.end() || std::all_of(readings.begin(), readings.end(), lacks)) continue;
    errors.add({.where = lacking->place,
                .value = fmt::format("has no {}, which other readings have", column.name),
                .rule = "all of them or none",
                .fix = fmt::format("give the {} here, too.", column.what)});
  }
}

/// The mean over the repeats on each sample, samples in the order of their first reading.
std::vector<double> sample_means(std::span<const BenchReading> readings,
                                 const std::function<double(ReadingValues)>& value_of) {
  struct Sum {
    double sum = 0;
    int count = 0;
  };
  std::vector<Sum> sums;
  std::map<std::string, std::size_t> known;
  for (const BenchReading& reading : readings) {
    std::size_t index = sums.size();
    if (!reading.sample.empty()) index = known.emplace(reading.sample, index).first->second;
    if (index == sums.size()) sums.emplace_back();
    sums[index].sum += value_of(values_of(reading));
    ++sums[index].count;
  }
  std::vector<double> means;
  means.reserve(sums.size());
  for (const Sum& sum : sums) means.push_back(sum.sum / sum.count);
  return means;
}

std::vector<std::string> notes_on(const Method& method, std::span<const BenchReading> readings,
                                  const std::vector<BenchQuantity>& quantities) {
  std::vector<std::string> notes = {method.validity};
  if (method.remarks) {
    for (std::string& remark : method.remarks(values_of(readings)))
      notes.push_back(std::move(remark));
  }
  const BenchQuantity& first = quantities.front();
  if (first.values.size() < readings.size()) {
    notes.push_back(fmt::format(
        "{} readings of {} samples: repeats on one sample were averaged first, and n counts "
        "samples.",
        readings.size(), first.values.size()));
  }
  if (first.repeats.n == 1) {
    notes.emplace_back("One reading has no scatter and no interval: repeat the test.");
    return notes;
  }
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const auto& [name, unit, what, values, repeats] = quantities[i];
    if (std::equal(values.begin() + 1, values.end(), values.begin())) {
      notes.push_back(
          fmt::format("All values of the {} are the same: the scatter is hidden by the step of the "
                      "instrument, and so is the interval.",
                      what));
    } else if (repeats.mean - *repeats.mean_uncertainty < method.outputs[i].least ||
               repeats.mean + *repeats.mean_uncertainty > method.outputs[i].greatest) {
      notes.push_back(fmt::format(
          "The interval of the {} reaches values that are impossible: take more repeats.", what));
    }
  }
  return notes;
}

/// Names drops from other heights than the rest: restitution falls with speed, and a later bounce
/// mistaken for the first one falls from lower. Tested by Bench.DropsThatDifferAreNamed.
void note_other_drops(const std::vector<ReadingColumn>& columns,
                      std::span<const BenchReading> readings, std::vector<std::string>& notes) {
  constexpr double kSame = .05;
  constexpr std::size_t kMaxNamed = 5;
  const auto column = std::ranges::find(columns, "drop_mm", &ReadingColumn::name);
  if (column == columns.end()) return;
  const auto at = static_cast<std::size_t>(column - columns.begin());
  std::vector<double> drops_mm;
  for (const BenchReading& reading : readings) drops_mm.push_back(reading.values[at]);
  const auto middle = drops_mm.begin() + static_cast<std::ptrdiff_t>(drops_mm.size() / 2);
  std::nth_element(drops_mm.begin(), middle, drops_mm.end());
  std::string named;
  std::size_t others = 0;
  for (const BenchReading& reading : readings) {
    const double drop_mm = reading.values[at];
    if (std::abs(drop_mm - *middle) <= kSame * *middle || ++others > kMaxNamed) continue;
    named += fmt::format("{}{} ({:.4g} mm)", named.empty() ? "" : ", ", reading.place, drop_mm);
  }
  if (others == 0) return;
  notes.push_back(fmt::format(
      "{} of {} drops are from another height than {:.4g} mm, by more than {:g} %: {}{}. "
      "Restitution falls with speed: do not mix heights, nor first with later bounces.",
      others, readings.size(), *middle, 100 * kSame, named, others > kMaxNamed ? " ..." : ""));
}

}  // namespace

std::vector<std::string> bench_test_names() {
  std::vector<std::string> names;
  for (const Method& method : methods()) names.push_back(method.name);
  return names;
}

BenchTest bench_test_named(std::string_view name) {
  for (const Method& method : methods()) {
    if (method.name == name) return &method;
  }
  throw base::InputError({.where = fmt::format("bench test {}", name),
                          .value = "unknown",
                          .fix = fmt::format("choose {}.", fmt::join(bench_test_names(), ", "))});
}

std::string name_of(BenchTest test) { return test->name; }

std::vector<ReadingColumn> columns_of(BenchTest test) { return test->columns; }

std::string uncertainty_column(std::string_view column) {
  const std::size_t unit = column.rfind('_');
  return fmt::format("{}_uncertainty{}", column.substr(0, unit), column.substr(unit));
}

std::vector<ReadingColumn> optional_columns_of(BenchTest test) { return test->optional_columns; }

std::vector<double> sample_means(BenchTest test, std::string_view column,
                                 std::span<const BenchReading> readings) {
  const std::vector<ReadingColumn> columns = columns_of(test);
  const auto found = std::find_if(columns.begin(), columns.end(),
                                  [&](const ReadingColumn& one) { return one.name == column; });
  if (found == columns.end()) {
    throw base::InputError(
        {.where = std::string(column), .value = "is no column of this bench test"});
  }
  const auto index = static_cast<std::size_t>(found - columns.begin());
  return sample_means(readings, [index](ReadingValues values) { return values[index]; });
}

void check_readings(BenchTest test, std::span<const BenchReading> readings) {
  const Method& method = *test;
  constexpr std::size_t kMaxErrors = 10;  // a table may have a million rows
  base::Faults errors(kMaxErrors);
  for (const BenchReading& reading : readings) check_reading(method, reading, errors);
  check_all_or_none(method, readings, errors);
  errors.throw_if_any();
}

BenchResult evaluate_bench(BenchTest test, std::span<const BenchReading> readings) {
  if (readings.empty()) {
    throw base::InputError({.where = "bench", .value = "no readings", .fix = "give at least one."});
  }
  check_readings(test, readings);
  const Method& method = *test;
  if (method.error_of_all) {
    if (auto fault = method.error_of_all(values_of(readings))) {
      throw base::InputError(*std::move(fault));
    }
  }
  BenchResult result{.quantities = {}, .source = method.source, .notes = {}};
  for (const MethodOutput& output : method.outputs) {
    std::vector<double> values = sample_means(readings, output.of);
    const calibrate::Summary repeats = calibrate::summarise(values);
    result.quantities.push_back(
        {output.name, output.unit, output.what, std::move(values), repeats});
  }
  result.notes = notes_on(method, readings, result.quantities);
  note_other_drops(method.columns, readings, result.notes);
  return result;
}

}  // namespace repose::calibrate
