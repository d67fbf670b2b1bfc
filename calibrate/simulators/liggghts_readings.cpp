#include "calibrate/simulators/liggghts_readings.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/input_error.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kRemarks[] = {kGrainsHang, kBelowRim, kGrainsLost, kAllOffPlate};

/// Reads a line that ends with a number and may have another before it.
void read_line(const std::string& line, PrintedLines& printed) {
  std::istringstream words(line);
  std::string kind, name;
  double first = 0, second = 0;
  words >> kind;
  if (kind == "reading:" && words >> name >> first) {
    printed.readings[name] = first;
  } else if (kind == "slip:" && words >> first >> second) {
    printed.slips.emplace_back(first, second);
  } else if (kind == "place" && words >> name >> first) {
    printed.places.push_back(first);
  } else if (line.starts_with("Loop time of ")) {
    // "Loop time of .5 on 1 procs for 1000 steps with 450 atoms, ..."
    const std::size_t place = line.find(" for ");
    std::int64_t steps = 0;
    if (place != std::string::npos && std::istringstream(line.substr(place + 5)) >> steps) {
      printed.steps += steps;
    }
  } else if (std::ranges::find(kRemarks, line) != std::end(kRemarks)) {
    printed.remark = line;
  }
}

}  // namespace

PrintedLines printed_lines(const fs::path& file) {
  std::istringstream text(base::read_whole_file(file));
  PrintedLines printed;
  for (std::string line; std::getline(text, line);) read_line(line, printed);
  return printed;
}

std::optional<Bounce> bounce_in(const fs::path& file) {
  constexpr double kEvenly = .02;
  std::istringstream text(base::read_whole_file(file));
  std::optional<double> first_m;
  double lowest_m = HUGE_VAL;
  double speed_before = 0;
  double fall_before = 0;
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    double step = 0, height_m = 0, speed = 0;
    if (!(words >> step >> height_m >> speed)) continue;
    if (!first_m) first_m = height_m;
    lowest_m = std::min(lowest_m, height_m);
    const double fall = speed_before - speed;
    const bool is_flying = std::abs(fall - fall_before) < kEvenly * fall;
    if (speed_before > 0 && speed <= 0 && is_flying) {
      return Bounce{.rise_m = height_m - lowest_m, .above_first_touch_m = height_m - *first_m};
    }
    speed_before = speed;
    fall_before = fall;
  }
  if (!first_m) base::refuse(file, "has no rows of step, height and speed", "run it again.");
  return std::nullopt;
}

std::vector<dem::Grain> grains_in(const fs::path& file, bool are_balls) {
  std::istringstream text(base::read_whole_file(file));
  std::vector<dem::Grain> grains;
  std::size_t announced = 0;
  bool is_table = false, is_count = false;
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    if (line.starts_with("ITEM:")) {
      is_count = line.starts_with("ITEM: NUMBER OF");
      is_table = line.starts_with("ITEM: ATOMS") || line.starts_with("ITEM: ENTRIES");
    } else if (is_count) {
      words >> announced;
    } else if (is_table) {
      dem::Grain grain;
      double number = 0, type = 0;
      if (are_balls) words >> number >> type;
      words >> grain.position.x() >> grain.position.y() >> grain.position.z();
      dem::Quaternion& pose = grain.orientation;
      if (!are_balls) words >> pose.w() >> pose.x() >> pose.y() >> pose.z();
      if (!words) break;
      pose.normalize();
      grains.push_back(grain);
    }
  }
  if (announced != grains.size() || !is_table) {
    base::refuse(file, fmt::format("is cut short: {} rows of {}", grains.size(), announced),
                 "run it again.");
  }
  return grains;
}

}  // namespace repose::calibrate
