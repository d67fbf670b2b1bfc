#include "dem/study/read_experiments.h"

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace repose::dem {
namespace {

constexpr double kMetres_mm = 1e-3;
constexpr double kLongest_mm = 1e5;
constexpr int kMaxGrains = 10'000'000;

/// Writes what a key says over the usual value, if it says something.
void set_number(Section& section, const std::string& key, const Range& range,
                const std::string& example, double unit, double& value) {
  if (const auto number = section.number(key, range, key + " = " + example)) {
    value = *number * unit;
  }
}

void set_length(Section& section, const std::string& key, const std::string& example_mm,
                double& value_m) {
  set_number(section, key, above(0, kLongest_mm), example_mm, kMetres_mm, value_m);
}

void set_count(Section& section, const std::string& key, int most, const std::string& example,
               int& value) {
  if (const auto count = section.integer(key, 1, most, key + " = " + example)) {
    value = static_cast<int>(*count);
  }
}

double stiffness_factor(Section& section) {
  double factor = 1;
  set_number(section, "stiffness_factor", above(0, 1), "0.01", 1, factor);
  return factor;
}

constexpr const char* kMeasured =
    "measured = { values = [9.1, 9.6] }, { mean = 9.42, sd = 0.5, n = 10 } or, for a heap, "
    "{ pictures = [\"photos\"] }";

/// One way of saying it, and only one.
void check_ways(Section& measured) {
  int ways = 0;
  for (const char* way : {"values", "mean", "pictures"}) ways += measured.has(way) ? 1 : 0;
  if (ways == 1) return;
  measured.errors().add(measured.place(),
                        fmt::format("{} has {}", measured.path(),
                                    ways == 0 ? "no values" : "more than one kind of values"),
                        "values, or their mean, or pictures",
                        std::string("for example ") + kMeasured);
}

Measured read_measured(Section& experiment, bool has_pictures, const NamedFiles& files) {
  Measured result;
  Section measured = experiment.section("measured");
  if (!measured.exists()) return result;
  check_ways(measured);
  constexpr Range kAny = from_to(0, 1e6);
  result.values = measured.numbers("values", kAny, "values = [9.1, 9.6]").value_or(result.values);
  result.mean = measured.number("mean", kAny, "mean = 9.42");
  result.sd = measured.number("sd", kAny, "sd = 0.5");
  if (const auto n = measured.integer("n", 1, 1'000'000, "n = 10")) {
    result.count = static_cast<int>(*n);
  }
  for (const char* key : {"sd", "n"}) {
    if (!measured.has(key) || measured.has("mean")) continue;
    measured.wrong(*measured.value(key), "sd and n belong to a mean", "add mean or take it out");
  }
  const auto names = measured.texts("pictures", "pictures = [\"photos\"]");
  for (const std::string& name : names.value_or(std::vector<std::string>{})) {
    result.pictures.push_back(file_named(measured, *measured.value("pictures"), name, files));
  }
  if (!has_pictures && measured.has("pictures")) {
    measured.wrong(*measured.value("pictures"), "only heaps are measured in pictures",
                   "give values or their mean");
  }
  measured.refuse_others();
  return result;
}

/// [experiment.heap.also_measured]: readings beside the experiment's own number.
void read_also(Section& experiment, const std::vector<std::string>& names, Measured& measured) {
  Section also = experiment.section("also_measured");
  for (const std::string& name : names) {
    Section reading = also.section(name);
    if (!reading.exists()) continue;
    constexpr Range kAny = from_to(-1e6, 1e6);
    MeasuredReading read{.name = name,
                         .mean = reading.needed_number("mean", kAny, "mean = 120"),
                         .sd = reading.number("sd", from_to(0, 1e6), "sd = 4"),
                         .count = {}};
    if (const auto n = reading.integer("n", 1, 1'000'000, "n = 10")) {
      read.count = static_cast<int>(*n);
    }
    reading.refuse_others();
    measured.also.push_back(std::move(read));
  }
  also.refuse_others();
}

void read_drop(Section drop, const NamedFiles& files, Study& study) {
  if (!drop.exists()) return;
  DropProtocol protocol;
  set_length(drop, "height_mm", "500", protocol.height_m);
  set_count(drop, "grains", kMaxGrains, "10", protocol.grains);
  study.drop = protocol;
  study.drop_stiffness = stiffness_factor(drop);
  study.drop_measured = read_measured(drop, false, files);
  read_also(drop, {"lowest_point_rise_mm"}, study.drop_measured);
  drop.refuse_others();
}

void read_tilt(Section tilt, const NamedFiles& files, Study& study) {
  if (!tilt.exists()) return;
  TiltProtocol protocol;
  constexpr int kMaxBonded = 100;
  set_count(tilt, "bonded", kMaxBonded, "2", protocol.bonded);
  set_number(tilt, "rate_deg_s", above(0, 10), "2", 1, protocol.rate_deg_s);
  set_number(tilt, "start_deg", from_to_below(0, 90), "0", 1, protocol.start_deg);
  study.tilt = protocol;
  study.tilt_stiffness = stiffness_factor(tilt);
  study.tilt_measured = read_measured(tilt, false, files);
  tilt.refuse_others();
}

void read_roll(Section roll, const NamedFiles& files, Study& study) {
  if (!roll.exists()) return;
  RollProtocol protocol;
  constexpr Range kSlope{.from = 0, .to = 90, .excludes_from = true, .excludes_to = true};
  set_number(roll, "incline_deg", kSlope, "20", 1, protocol.incline_deg);
  set_length(roll, "release_mm", "150", protocol.release_m);
  study.roll = protocol;
  study.roll_stiffness = stiffness_factor(roll);
  study.roll_measured = read_measured(roll, false, files);
  roll.refuse_others();
}

void read_heap(Section heap, const NamedFiles& files, Study& study) {
  if (!heap.exists()) return;
  HeapProtocol protocol;
  set_length(heap, "tube_diameter_mm", "100", protocol.tube_diameter_m);
  set_length(heap, "tube_height_mm", "400", protocol.tube_height_m);
  set_length(heap, "tube_thickness_mm", "2", protocol.tube_thickness_m);
  set_length(heap, "lift_speed_mm_s", "30", protocol.lift_speed_m_s);
  set_length(heap, "plate_mm", "400", protocol.plate_m);
  set_length(heap, "plate_thickness_mm", "2", protocol.plate_thickness_m);
  if (const auto grains = heap.integer("grains", 1, kMaxGrains, "grains = 455")) {
    protocol.grains = static_cast<int>(*grains);
  }
  study.heap = protocol;
  study.heap_stiffness = stiffness_factor(heap);
  study.heap_measured = read_measured(heap, true, files);
  read_also(heap, {"base_radius_mm", "height_mm", "grains_off_plate"}, study.heap_measured);
  heap.refuse_others();
}

}  // namespace

void read_experiments(Section experiments, const NamedFiles& files, Study& study) {
  read_drop(experiments.section("drop"), files, study);
  read_tilt(experiments.section("tilt"), files, study);
  read_roll(experiments.section("roll"), files, study);
  read_heap(experiments.section("heap"), files, study);
  experiments.refuse_others();
}

}  // namespace repose::dem
