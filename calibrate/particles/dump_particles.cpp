#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "calibrate/particles/particle_columns.h"
#include "calibrate/particles/text_scanner.h"

/// Text dumps of LAMMPS and LIGGGHTS, styles atom and custom: consecutive time steps, each made of
/// sections that begin with "ITEM:". Source: LAMMPS documentation, command "dump", file format of
/// these styles.
namespace repose::calibrate {
namespace {

constexpr std::string_view kItem = "ITEM: ";
constexpr std::string_view kStep = "ITEM: TIMESTEP";

/// Lengths of LAMMPS's unit styles; "lj" has none.
std::string unit_of_style(std::string_view style) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kStyles = {
      {{"si", "m"}, {"cgs", "cm"}, {"micro", "um"}}};
  for (const auto& [name, unit] : kStyles) {
    if (style == name) return std::string(unit);
  }
  return {};
}

/// Appears before the first time step, or between two.
constexpr std::string_view kUnitsItem = "ITEM: UNITS";

/// Where a time step begins, and its label.
struct Step {
  std::size_t at = 0;
  int line = 1;
  std::string label;
};

/// @param unit  set if the file states it, which it does once
std::vector<Step> steps_of(std::string_view text, std::string& unit) {
  std::vector<Step> steps;
  TextScanner scanner(text);
  for (int line = 1; !scanner.is_at_end(); ++line) {
    const std::size_t at = scanner.at();
    const std::string_view item = scanner.line();
    if (item.starts_with(kUnitsItem)) unit = unit_of_style(TextScanner(scanner).word());
    if (!item.starts_with(kStep)) continue;
    steps.push_back({.at = at, .line = line, .label = {}});
    const std::size_t behind = scanner.at();
    steps.back().label = TextScanner(scanner).word();
    scanner.move_to(behind);
  }
  return steps;
}

struct Bound {
  double low = 0;
  double high = 0;
};

/// One time step.
class StepReader {
 public:
  StepReader(const std::string& file, std::string_view text, const Step& step, std::string fix)
      : file_(file), scanner_(text), line_(step.line), step_(step.label), fix_(std::move(fix)) {
    scanner_.move_to(step.at);
  }

  ParticleColumns read() {
    next_line();  // ITEM: TIMESTEP
    next_line();
    for (;;) {
      if (scanner_.is_at_end()) refuse_cut("it has no ITEM: ATOMS");
      const std::string_view item = next_line();
      if (!item.starts_with(kItem) || item.starts_with(kStep)) {
        refuse(fmt::format("\"{}\" stands where a section should begin", item.substr(0, 40)));
      }
      if (item.starts_with("ITEM: ATOMS")) return atoms(item);
      if (item.starts_with("ITEM: NUMBER OF ATOMS")) {
        count_ = TextScanner::whole<std::size_t>(trimmed(next_line()));
      } else if (item.starts_with("ITEM: BOX BOUNDS")) {
        read_bounds(item);
      } else if (item.starts_with("ITEM: ENTRIES") || item.starts_with("ITEM: NUMBER OF ENTRIES")) {
        refuse("it is of contacts or bonds, not of particles");
      } else {
        next_line();
      }
    }
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw base::InputError({.where = fmt::format("{}:{}", file_, line_),
                            .value = what,
                            .rule = "a text dump of particles, as dump ... custom writes it",
                            .fix = "dump id, x, y, z and radius."});
  }
  [[noreturn]] void refuse_cut(const std::string& what) const {
    throw base::InputError({.where = fmt::format("{}:{}", file_, line_),
                            .value = fmt::format("time step {} is cut short: {}", step_, what),
                            .fix = fix_});
  }

  static std::string_view trimmed(std::string_view text) { return TextScanner(text).word(); }

  std::string_view next_line() {
    ++line_;
    return scanner_.line();
  }

  void read_bounds(std::string_view item) {
    is_skewed_ = item.find("xy xz yz") != item.npos || item.find("abc origin") != item.npos;
    for (Bound& bound : bounds_) {
      TextScanner words(next_line());
      const auto low = TextScanner::number(words.word());
      const auto high = TextScanner::number(words.word());
      if (!low || !high) refuse("the bounds of the box are no numbers");
      bound = {*low, *high};
    }
  }

  ParticleColumns atoms(std::string_view item) {
    ParticleColumns found{
        .file = file_, .format = "LIGGGHTS or LAMMPS dump", .columns = {}, .names = {}};
    std::vector<std::optional<std::size_t>> targets;
    std::vector<std::size_t> scaled(3, npos);
    TextScanner names(item.substr(std::string_view("ITEM: ATOMS").size()));
    for (std::string_view name = names.word(); !name.empty(); name = names.word()) {
      found.names.emplace_back(name);
      const std::size_t axis = std::string_view("xyz").find(name.front());
      const bool is_scaled = axis != name.npos && (name.substr(1) == "s" || name.substr(1) == "su");
      targets.emplace_back();
      if (!is_scaled && !is_of_use(name)) continue;
      targets.back() = found.columns.size();
      if (is_scaled) scaled[axis] = found.columns.size();
      found.columns.push_back(
          {.name = std::string(is_scaled ? name.substr(0, 1) : name), .values = {}});
    }
    if (!count_) refuse("it does not say how many particles there are");
    read_rows(targets, found);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (scaled[axis] != npos) stretch(found.columns[scaled[axis]], bounds_[axis]);
    }
    return found;
  }

  /// "xs" counts from 0 to 1 across the box.
  void stretch(ParticleColumn& column, const Bound& bound) const {
    if (is_skewed_) refuse("places are fractions of a skewed box, which are not read");
    for (double& value : column.values) value = bound.low + value * (bound.high - bound.low);
  }

  void read_rows(const std::vector<std::optional<std::size_t>>& targets, ParticleColumns& found) {
    const int first = line_;
    found.place = [file = file_, first](std::size_t row) {
      return fmt::format("{}:{}", file, first + static_cast<int>(row));
    };
    for (std::size_t row = 0; row < *count_; ++row) {
      if (scanner_.is_at_end()) {
        refuse_cut(fmt::format("it has {} of {} particles", row, *count_));
      }
      const std::string_view line = next_line();
      TextScanner words(line);
      for (const auto& target : targets) {
        const std::string_view word = words.word();
        const auto value = target ? TextScanner::number(word) : std::optional(0.);
        if (word.empty() || !value) {
          --line_;
          const bool is_last = scanner_.is_at_end();
          if (is_last) refuse_cut(fmt::format("particle {} of {} is not whole", row + 1, *count_));
          refuse(word.empty() ? fmt::format("the row has fewer than the {} values that are named",
                                            targets.size())
                              : fmt::format("\"{}\" is no number", word));
        }
        if (target) found.columns[*target].values.push_back(*value);
      }
    }
  }

  static constexpr std::size_t npos = static_cast<std::size_t>(-1);

  const std::string& file_;
  TextScanner scanner_;
  int line_;  ///< of the next line to read
  std::string step_;
  std::string fix_;
  std::optional<std::size_t> count_;
  std::array<Bound, 3> bounds_{};
  bool is_skewed_ = false;
};

}  // namespace

ParticleColumns columns_in_dump(const std::string& file, std::string_view text,
                                const ParticleReading& reading) {
  std::string unit;
  const std::vector<Step> steps = steps_of(text, unit);
  if (steps.empty()) {
    throw base::InputError({.where = file,
                            .value = "has no ITEM: TIMESTEP",
                            .rule = "a text dump of particles, as dump ... custom writes it",
                            .fix = "dump id, x, y, z and radius."});
  }
  std::vector<std::string> labels;
  for (const Step& step : steps) labels.push_back(step.label);
  const std::size_t chosen = chosen_step(file, labels, reading);
  const std::string fix = chosen == 0
                              ? std::string("copy it again, or let the run write it to its end.")
                              : fmt::format("copy it again; or take the {} before, {}.",
                                            base::field("time step"), labels[chosen - 1]);
  ParticleColumns found = StepReader(file, text, steps[chosen], fix).read();
  found.unit = unit;
  found.step = labels[chosen];
  found.steps = static_cast<int>(steps.size());
  return found;
}

}  // namespace repose::calibrate
