#include "calibrate/particles/particle_columns.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/particles/text_scanner.h"

namespace repose::calibrate {
namespace {

enum class Role { none, x, y, z, radius, diameter, grain, step };

struct LengthUnit {
  std::string_view name;
  double m = 0;
};

/// Units in files; the user can name the first five.
constexpr std::array<LengthUnit, 12> kUnits = {{{"m", 1},
                                                {"cm", 1e-2},
                                                {"mm", 1e-3},
                                                {"um", 1e-6},
                                                {"in", .0254},
                                                {"\xC2\xB5m", 1e-6},
                                                {"\xCE\xBCm", 1e-6},
                                                {"micron", 1e-6},
                                                {"microns", 1e-6},
                                                {"inch", .0254},
                                                {"meter", 1},
                                                {"metre", 1}}};
constexpr std::size_t kNamedUnits = 5;

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kAround = " \t\"'";
  const std::size_t from = text.find_first_not_of(kAround);
  if (from == text.npos) return {};
  return text.substr(from, text.find_last_not_of(kAround) - from + 1);
}

/// Only letters and digits, in lower case.
std::string bare(std::string_view text) {
  std::string letters;
  for (const char letter : text) {
    const auto byte = static_cast<unsigned char>(letter);
    if (std::isalnum(byte) != 0) letters += static_cast<char>(std::tolower(byte));
  }
  return letters;
}

/// A column's name and the unit given with it.
struct Name {
  std::string bare;
  std::optional<double> unit_m;
  std::string unit;  ///< as written, even if unknown
};

Name split(std::string_view full) {
  full = without_query_number(full);
  Name name;
  for (const auto& [open, close] : {std::pair('(', ')'), std::pair('[', ']')}) {
    const std::size_t from = full.rfind(open);
    if (from == full.npos || !full.ends_with(close)) continue;
    name.unit = trimmed(full.substr(from + 1, full.size() - from - 2));
    name.unit_m = unit_named(name.unit);
    name.bare = bare(full.substr(0, from));
    return name;
  }
  const std::size_t mark = full.find_last_of("_ /");
  if (mark != full.npos && mark > 0) {
    const std::string_view last = full.substr(mark + 1);
    if (const auto unit_m = unit_named(last)) {
      return {.bare = bare(full.substr(0, mark)), .unit_m = unit_m, .unit = std::string(last)};
    }
  }
  name.bare = bare(full);
  return name;
}

bool is_axis_name(const std::string& name, char letter, char digit) {
  static const std::set<std::string> kBefore = {"",
                                                "pos",
                                                "position",
                                                "p",
                                                "coord",
                                                "coordinate",
                                                "coords",
                                                "center",
                                                "centre",
                                                "c",
                                                "particleposition",
                                                "particle",
                                                "centroid",
                                                "location",
                                                "loc",
                                                "particlecentre",
                                                "particlecenter"};
  static const std::set<std::string> kBehind = {
      "pos", "position", "coord", "coordinate", "center", "centre", "centroid", "c", "u"};
  static const std::set<std::string> kCounted = {"points", "coordinates", "position",
                                                 "pos",    "coords",      "coord"};
  if (name.empty()) return false;
  if (name.back() == letter && kBefore.contains(name.substr(0, name.size() - 1))) return true;
  if (name.front() == letter && kBehind.contains(name.substr(1))) return true;
  return name.back() == digit && kCounted.contains(name.substr(0, name.size() - 1));
}

Role role_of(const std::string& name) {
  static const std::map<std::string, Role> kOthers = {
      {"r", Role::radius},
      {"rad", Role::radius},
      {"radius", Role::radius},
      {"radii", Role::radius},
      {"particleradius", Role::radius},
      {"sphereradius", Role::radius},
      {"d", Role::diameter},
      {"dia", Role::diameter},
      {"diam", Role::diameter},
      {"diameter", Role::diameter},
      {"particlediameter", Role::diameter},
      {"spherediameter", Role::diameter},
      {"clump", Role::grain},
      {"clumpid", Role::grain},
      {"clumpnumber", Role::grain},
      {"mol", Role::grain},
      {"molecule", Role::grain},
      {"moleculeid", Role::grain},
      {"molid", Role::grain},
      {"body", Role::grain},
      {"bodyid", Role::grain},
      {"multisphere", Role::grain},
      {"multisphereid", Role::grain},
      {"idmultisphere", Role::grain},
      {"aggregate", Role::grain},
      {"aggregateid", Role::grain},
      {"parent", Role::grain},
      {"parentid", Role::grain},
      {"grain", Role::grain},
      {"grainid", Role::grain},
      {"time", Role::step},
      {"times", Role::step},
      {"timestep", Role::step},
      {"step", Role::step},
      {"frame", Role::step},
  };
  if (is_axis_name(name, 'x', '0')) return Role::x;
  if (is_axis_name(name, 'y', '1')) return Role::y;
  if (is_axis_name(name, 'z', '2')) return Role::z;
  const auto found = kOthers.find(name);
  return found == kOthers.end() ? Role::none : found->second;
}

constexpr std::size_t kMostFaults = 10;

/// A column with a role, and the length of its unit.
struct Length {
  const ParticleColumn* column = nullptr;
  Name name;
  double unit_m = 1;
};

class Interpreter {
 public:
  Interpreter(ParticleColumns columns, const ParticleReading& reading)
      : file_(std::move(columns)), reading_(reading), faults_(kMostFaults) {}

  Particles take() {
    find_columns();
    choose_unit();
    faults_.throw_if_any();
    choose_rows();
    read_spheres();
    faults_.throw_if_any();
    read_grains();
    particles_.format = file_.format;
    particles_.step = file_.step;
    particles_.steps = file_.steps;
    return std::move(particles_);
  }

 private:
  void fault(std::string value, std::string rule, std::string fix) {
    faults_.add({.where = file_.file,
                 .value = std::move(value),
                 .rule = std::move(rule),
                 .fix = std::move(fix)});
  }

  void find_columns() {
    for (const ParticleColumn& column : file_.columns) {
      Name name = split(column.name);
      const Role role = role_of(name.bare);
      if (role == Role::none) continue;
      const auto [found, is_new] = roles_.try_emplace(role, Length{&column, std::move(name)});
      // Two columns with the same numbers are not ambiguous; for clumps and steps the first column
      // is used.
      const bool is_number = role == Role::step || role == Role::grain;
      if (is_new || is_number || found->second.column->values == column.values) continue;
      fault(fmt::format("{} and {} may both be meant", found->second.column->name, column.name),
            "one column of each kind", "rename or delete the one that is not.");
    }
    std::vector<std::string> missing;
    for (const auto& [role, name] :
         {std::pair(Role::x, "x"), std::pair(Role::y, "y"), std::pair(Role::z, "z")}) {
      if (!roles_.contains(role)) missing.emplace_back(name);
    }
    if (!missing.empty()) {
      fault(fmt::format("has no column {}", fmt::join(missing, ", ")),
            "a file of particles has their places and sizes: x, y, z and radius",
            fmt::format("name them so; its columns are {}.", fmt::join(file_.names, ", ")));
    }
    const bool has_size = roles_.contains(Role::radius) || roles_.contains(Role::diameter);
    if (!has_size && !reading_.diameter_mm) {
      fault("has no column radius or diameter", "a file of particles tells their sizes",
            "export it too, or give the " + base::field("particles' diameter") +
                fmt::format(" if it is the same for all; its columns are {}.",
                            fmt::join(file_.names, ", ")));
    }
    if (has_size && reading_.diameter_mm) {
      fault("has a column of sizes, and a " + base::field("particles' diameter") + " is given", "",
            "leave that out.");
    }
  }

  std::vector<Length*> lengths() {
    std::vector<Length*> found;
    for (const Role role : {Role::x, Role::y, Role::z, Role::radius, Role::diameter}) {
      const auto at = roles_.find(role);
      if (at != roles_.end()) found.push_back(&at->second);
    }
    return found;
  }

  /// The unit in the header, else that of the file, else that given by the user.
  void choose_unit() {
    std::set<std::string> told, silent;
    for (Length* length : lengths()) {
      if (!length->name.unit.empty() && !length->name.unit_m) {
        fault(fmt::format("{}: \"{}\" is no unit of length that is known", length->column->name,
                          length->name.unit),
              "", fmt::format("one of {}.", names_of_units()));
      }
      const std::string& unit = length->name.unit.empty() ? file_.unit : length->name.unit;
      (unit.empty() ? silent : told).insert(unit.empty() ? length->column->name : unit);
      if (!unit.empty()) length->unit_m = unit_named(unit).value_or(1);
    }
    if (silent.empty()) {
      if (!reading_.unit.empty() && !told.contains(reading_.unit)) {
        fault(fmt::format("says that its unit is {}, and {} is given", fmt::join(told, " and "),
                          reading_.unit),
              "", "leave the " + base::field("particles' unit") + " out, or correct the file.");
      }
    } else if (!reading_.unit.empty()) {
      for (Length* length : lengths()) {
        if (length->name.unit.empty()) length->unit_m = unit_named(reading_.unit).value_or(1);
      }
      told.insert(reading_.unit);
    } else if (!told.empty()) {
      fault(fmt::format("{} has no unit, and others are in {}", fmt::join(silent, ", "),
                        fmt::join(told, " and ")),
            "", "say it: " + base::field("particles' unit") + '.');
    } else if (reading_.diameter_mm) {
      fault("does not say in which unit places are, and the particles' diameter is in mm", "",
            "say it too: " + base::field("particles' unit") + '.');
    }
    if (told.empty()) return;
    particles_.unit = *told.begin();
    particles_.unit_m = roles_.contains(Role::x) ? roles_.at(Role::x).unit_m : 1;
  }

  /// In a table with several time steps, selects the rows of one.
  void choose_rows() {
    const std::size_t count = roles_.at(Role::x).column->values.size();
    const auto step = roles_.find(Role::step);
    std::vector<double> labels;
    if (step != roles_.end()) {
      const std::set<double> values(step->second.column->values.begin(),
                                    step->second.column->values.end());
      labels.assign(values.begin(), values.end());
    }
    if (labels.size() < 2 && !(labels.size() == 1 && reading_.step && file_.step.empty())) {
      for (std::size_t k = 0; k < count; ++k) rows_.push_back(k);
      if (reading_.step && file_.step.empty()) {
        fault("is of one moment, and a time step is asked for", "",
              "leave out the " + base::field("time step") + '.');
        faults_.throw_if_any();
      }
      return;
    }
    std::vector<std::string> names;
    for (const double label : labels) names.push_back(fmt::format("{}", label));
    const std::size_t chosen = chosen_step(file_.file, names, reading_);
    file_.step = names[chosen];
    file_.steps = static_cast<int>(names.size());
    for (std::size_t k = 0; k < count; ++k) {
      if (step->second.column->values[k] == labels[chosen]) rows_.push_back(k);
    }
  }

  std::string place_of(std::size_t row) const {
    return file_.place ? file_.place(row) : fmt::format("{}: particle {}", file_.file, row + 1);
  }

  bool is_finite(std::size_t row, const Length& length) {
    const double value = length.column->values[row];
    if (std::isfinite(value)) return true;
    faults_.add(
        {.where = place_of(row),
         .subject = length.column->name,
         .value = fmt::format("is {}", value),
         .rule = "a number",
         .fix = "look at the run, which may have become unstable; or delete the particle."});
    return false;
  }

  void read_spheres() {
    if (rows_.empty()) {
      fault("has no particles", "", "export a moment at which the heap stands.");
      return;
    }
    const Length &x = roles_.at(Role::x), &y = roles_.at(Role::y), &z = roles_.at(Role::z);
    const bool has_radius = roles_.contains(Role::radius);
    const auto size = roles_.find(has_radius ? Role::radius : Role::diameter);
    particles_.spheres.reserve(rows_.size());
    for (const std::size_t row : rows_) {
      bool is_usable = true;
      for (const Length* length : {&x, &y, &z}) is_usable = is_finite(row, *length) && is_usable;
      double radius = reading_.diameter_mm.value_or(0) / 2 * kMPerMm;
      if (size != roles_.end()) {
        is_usable = is_finite(row, size->second) && is_usable;
        const double value = size->second.column->values[row];
        radius = (has_radius ? 1 : .5) * value * size->second.unit_m;
        if (std::isfinite(value) && !(value > 0)) {
          faults_.add({.where = place_of(row),
                       .subject = size->second.column->name,
                       .value = fmt::format("is {:g}", value),
                       .rule = "above 0",
                       .fix = "correct it, or delete the particle."});
        }
      }
      if (!is_usable) continue;
      particles_.spheres.push_back(
          {.centre = {x.column->values[row] * x.unit_m, y.column->values[row] * y.unit_m,
                      z.column->values[row] * z.unit_m},
           .radius = radius});
    }
  }

  /// Programs write 0 or -1 for particles outside clumps; some write one number for all particles.
  void read_grains() {
    const auto grain = roles_.find(Role::grain);
    if (grain == roles_.end()) return;
    std::set<double> numbers;
    std::vector<std::int64_t> grains;
    std::int64_t alone = -1;
    for (const std::size_t row : rows_) {
      const double number = grain->second.column->values[row];
      const bool is_clump = number > 0 && number < 9e15 && number == std::floor(number);
      if (is_clump) numbers.insert(number);
      grains.push_back(is_clump ? static_cast<std::int64_t>(number) : alone--);
    }
    if (numbers.size() > 1) particles_.grains = std::move(grains);
  }

  ParticleColumns file_;
  const ParticleReading& reading_;
  base::Faults faults_;
  std::map<Role, Length> roles_;
  std::vector<std::size_t> rows_;
  Particles particles_;
};

}  // namespace

std::string names_of_units() {
  std::vector<std::string_view> names;
  for (std::size_t k = 0; k < kNamedUnits; ++k) names.push_back(kUnits[k].name);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::optional<double> unit_named(std::string_view name) {
  const auto found = std::ranges::find(kUnits, name, &LengthUnit::name);
  return found == kUnits.end() ? std::nullopt : std::optional(found->m);
}

std::string_view without_query_number(std::string_view name) {
  name = trimmed(name);
  std::size_t digits = 1;
  while (digits < name.size() && name[digits] >= '0' && name[digits] <= '9') ++digits;
  if (name.starts_with('Q') && digits > 1) {
    const std::size_t colon = name.find_first_not_of(' ', digits);
    if (colon != name.npos && name[colon] == ':') name = trimmed(name.substr(colon + 1));
  }
  while (name.ends_with(':')) name = trimmed(name.substr(0, name.size() - 1));
  return name;
}

bool is_of_use(std::string_view name) { return role_of(split(name).bare) != Role::none; }

bool has_places(const std::vector<std::string>& names) {
  std::set<Role> found;
  for (const std::string& name : names) found.insert(role_of(split(name).bare));
  return found.contains(Role::x) && found.contains(Role::y) && found.contains(Role::z);
}

Particles particles_of(ParticleColumns columns, const ParticleReading& reading) {
  return Interpreter(std::move(columns), reading).take();
}

std::size_t chosen_step(const std::string& file, const std::vector<std::string>& labels,
                        const ParticleReading& reading) {
  if (!reading.step) {
    // The latest, wherever it is in the file.
    std::size_t latest = 0;
    for (std::size_t k = 1; k < labels.size(); ++k) {
      const auto label = TextScanner::number(labels[k]);
      const auto before = TextScanner::number(labels[latest]);
      if (!label || !before || *label >= *before) latest = k;
    }
    return latest;
  }
  for (std::size_t k = labels.size(); k-- > 0;) {
    const auto label = TextScanner::number(labels[k]);
    if (label && std::abs(*label - *reading.step) <= 1e-9 * std::abs(*reading.step)) return k;
  }
  constexpr std::size_t kShown = 6;
  const bool is_long = labels.size() > kShown;
  const std::vector<std::string> last(
      labels.end() - static_cast<std::ptrdiff_t>(std::min(kShown, labels.size())), labels.end());
  throw base::InputError(
      {.where = file,
       .value = fmt::format("has no time step {:g}", *reading.step),
       .fix = fmt::format("one of {}{}.", is_long ? "..., " : "", fmt::join(last, ", "))});
}

}  // namespace repose::calibrate
