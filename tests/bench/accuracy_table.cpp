#include "tests/bench/accuracy_table.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace repose::bench {
namespace {

using testing::Condition;
using testing::Group;
using vision::MeasureStatus;

/// An ok number farther from the truth than this is a lie nobody was warned of.
constexpr double kSilentError_deg = 2;

struct Sample {
  std::vector<double> values;

  void add(std::optional<double> value) {
    if (value) values.push_back(std::abs(*value));
  }

  /// Linear between order statistics; "-" when there are none.
  std::string quantile(double part) const {
    if (values.empty()) return "-";
    auto sorted = values;
    std::sort(sorted.begin(), sorted.end());
    const double place = part * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const auto above = std::min(below + 1, sorted.size() - 1);
    const double value =
        sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
    return fmt::format("{:.2f}", value);
  }
};

struct Share {
  int hits = 0;
  int all = 0;

  void add(std::optional<bool> hit) {
    if (!hit) return;
    ++all;
    hits += *hit ? 1 : 0;
  }

  std::string percent() const { return all == 0 ? "-" : fmt::format("{:.0f}", 100.0 * hits / all); }
};

struct Summary {
  int pictures = 0;
  Sample errors;
  Share covered;
  Sample half_widths;
  Sample flank_errors;
  Share flank_covered;
  int missing_flanks = 0;   ///< exist, not measured, in pictures that were not refused
  int invented_flanks = 0;  ///< measured, do not exist
  int refused = 0;
  int flagged = 0;
  int silent = 0;

  void add(const Row& row) {
    ++pictures;
    const bool is_refused = row.status == MeasureStatus::refused;
    refused += is_refused ? 1 : 0;
    flagged += row.status == MeasureStatus::flagged ? 1 : 0;
    errors.add(row.mean.error_deg());
    covered.add(row.mean.covered());
    half_widths.add(row.mean.uncertainty_deg);
    const auto error = row.mean.error_deg();
    const bool is_wrong = error && std::abs(*error) > kSilentError_deg;
    silent += row.status == MeasureStatus::ok && is_wrong ? 1 : 0;
    for (const SideErrors& side : {row.left, row.right}) {
      flank_errors.add(side.error_deg());
      flank_covered.add(side.covered());
      missing_flanks += !is_refused && side.true_deg && !side.measured_deg ? 1 : 0;
      invented_flanks += !side.true_deg && side.measured_deg ? 1 : 0;
    }
  }
};

constexpr std::string_view kLine =
    "{:<16} {:>4} | {:>6} {:>6} {:>5} {:>6} | {:>6} {:>6} {:>5} {:>5} {:>5} | {:>4} {:>4} {:>4}\n";

std::string head() {
  return fmt::format("{:<16} {:>4} | {:^26} | {:^31} | {:^14}\n", "", "", "picture's mean [deg]",
                     "flanks [deg]", "pictures") +
         fmt::format(kLine, "condition", "n", "median", "95 %", "cov %", "half-w", "median", "95 %",
                     "cov %", "miss", "extra", "refd", "flag", ">2");
}

std::string line(std::string_view name, const Summary& s) {
  return fmt::format(kLine, name, s.pictures, s.errors.quantile(0.5), s.errors.quantile(0.95),
                     s.covered.percent(), s.half_widths.quantile(0.5), s.flank_errors.quantile(0.5),
                     s.flank_errors.quantile(0.95), s.flank_covered.percent(), s.missing_flanks,
                     s.invented_flanks, s.refused, s.flagged, s.silent);
}

std::string_view target_of(Group group) {
  switch (group) {
    case Group::clean:
      return "to reach: median <= 0.15, 95 % <= 0.5, coverage 90-99 %, none > 2 unflagged\n";
    case Group::degraded:
      return "to reach: median <= 0.3, 95 % <= 1, coverage 90-99 %, none > 2 unflagged, "
             "refused <= 3 %\n";
    case Group::sample:
    case Group::not_measurable:
      break;
  }
  return "";
}

}  // namespace

std::string group_table(std::span<const Row> rows, Group group, std::string_view method) {
  std::string text;
  Summary total;
  int conditions = 0;
  for (const Condition& condition : testing::conditions()) {
    Summary summary;
    for (const Row& row : rows) {
      if (row.condition != &condition || row.method != method || condition.group != group) continue;
      summary.add(row);
      total.add(row);
    }
    if (summary.pictures == 0) continue;
    text += line(condition.name, summary);
    ++conditions;
  }
  if (conditions == 0) return "";
  if (conditions > 1) text += line("all of these", total);
  return head() + text + std::string(target_of(group)) + '\n';
}

std::string refusal_table(std::span<const Row> rows, std::string_view method) {
  std::string text;
  for (const Condition& condition : testing::conditions()) {
    if (condition.group != Group::not_measurable) continue;
    Summary summary;
    for (const Row& row : rows) {
      if (row.condition == &condition && row.method == method) summary.add(row);
    }
    if (summary.pictures == 0) continue;
    text += fmt::format("{:<16} {:>4} | refused {:>3}, flagged {:>3}, angle without a word {:>3}\n",
                        condition.name, summary.pictures, summary.refused, summary.flagged,
                        summary.pictures - summary.refused - summary.flagged);
  }
  return text.empty() ? "" : "no angle exists (to reach: all refused)\n" + text;
}

}  // namespace repose::bench
