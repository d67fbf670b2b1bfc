#include "tests/bench/accuracy_table.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <vector>

#include <fmt/format.h>

#include "tests/bench/share.h"

namespace repose::bench {
namespace {

using testing::Group;
using vision::MeasureStatus;

/// A result of status ok with a larger error than this is a silent error.
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

struct Summary {
  int pictures = 0;
  Sample errors;
  Share covered;
  Sample half_widths;
  Sample flank_errors;
  Share flank_covered;
  int missing_flanks = 0;   ///< exist but not measured, in pictures that were not refused
  int invented_flanks = 0;  ///< measured but do not exist
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
    "{:<18} {:>4} | {:>6} {:>6} {:>5} {:>6} | {:>6} {:>6} {:>5} {:>5} {:>5} | {:>4} {:>4} {:>4}\n";

std::string head() {
  return fmt::format("{:<18} {:>4} | {:^26} | {:^31} | {:^14}\n", "", "", "picture's mean [deg]",
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

constexpr std::string_view kRefusalLine = "{:<18} {:>4} | {:>4} {:>4} {:>4} | {:>5}\n";

std::string refusal_line(std::string_view name, const Summary& s) {
  const int ok = s.pictures - s.refused - s.flagged;
  return fmt::format(kRefusalLine, name, s.pictures, ok, s.flagged, s.refused,
                     fmt::format("{:.1f}", 100.0 * ok / s.pictures));
}

std::string_view target_of(Group group) {
  switch (group) {
    case Group::clean:
      return "to reach: median <= 0.15, 95 % <= 0.5, coverage 90-99 %, none > 2 unflagged\n";
    case Group::degraded:
      return "to reach: median <= 0.3, 95 % <= 1, coverage 90-99 %, none > 2 unflagged, "
             "refused <= 3 %\n";
    case Group::hollow:
    case Group::sample:
    case Group::misplaced:
    case Group::not_measurable:
      break;
  }
  return "";
}

struct NamedSummary {
  std::string_view condition;
  Summary summary;
};

/// One for each condition, in the order of the rows.
std::vector<NamedSummary> summaries(std::span<const Row> rows) {
  std::vector<NamedSummary> all;
  for (const Row& row : rows) {
    const auto is_its = [&](const NamedSummary& one) {
      return one.condition == row.subject->condition;
    };
    auto found = std::find_if(all.begin(), all.end(), is_its);
    if (found == all.end()) found = all.insert(all.end(), {row.subject->condition, {}});
    found->summary.add(row);
  }
  return all;
}

std::vector<Row> of_group(std::span<const Row> rows, Group group) {
  std::vector<Row> chosen;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(chosen),
               [&](const Row& row) { return row.subject->group == group; });
  return chosen;
}

std::string signed_mean(const std::vector<double>& values) {
  if (values.empty()) return "-";
  const double sum = std::accumulate(values.begin(), values.end(), 0.0);
  return fmt::format("{:+.2f}", sum / static_cast<double>(values.size()));
}

/// Errors of an angle caused by the camera and by the measurement.
struct Bias {
  std::string_view condition;
  std::vector<double> of_camera_deg = {};
  std::vector<double> of_measurement_deg = {};
  std::vector<double> of_both_deg = {};

  void add(const Row& row) {
    const auto error = row.mean.error_deg();
    if (!error) return;
    of_camera_deg.push_back(*row.seen_deg - *row.mean.true_deg);
    of_measurement_deg.push_back(*row.mean.measured_deg - *row.seen_deg);
    of_both_deg.push_back(*error);
  }
};

}  // namespace

std::string group_table(std::span<const Row> rows, Group group) {
  const auto chosen = of_group(rows, group);
  if (chosen.empty()) return "";
  const auto conditions = summaries(chosen);
  std::string text = head();
  for (const auto& [condition, summary] : conditions) text += line(condition, summary);
  if (conditions.size() > 1) {
    Summary total;
    for (const Row& row : chosen) total.add(row);
    text += line("all of these", total);
  }
  return text + std::string(target_of(group)) + '\n';
}

std::string refusal_table(std::span<const Row> rows) {
  std::string text;
  const auto chosen = of_group(rows, Group::not_measurable);
  for (const auto& [condition, s] : summaries(chosen)) {
    text += refusal_line(condition, s);
  }
  if (text.empty()) return "";
  Summary total;
  for (const Row& row : chosen) total.add(row);
  return fmt::format(kRefusalLine, "no angle exists", "n", "ok", "flag", "refd", "ok %") + text +
         refusal_line("all of these", total) + "to reach: all refused\n";
}

std::string bias_table(std::span<const Row> rows) {
  std::vector<Bias> biases;
  for (const Row& row : rows) {
    if (!row.seen_deg) continue;
    if (biases.empty() || biases.back().condition != row.subject->condition) {
      biases.push_back({row.subject->condition});
    }
    biases.back().add(row);
  }
  std::string text;
  for (const Bias& bias : biases) {
    text += fmt::format("{:<18} {:>4} | {:>17} {:>22} {:>15}\n", bias.condition,
                        bias.of_both_deg.size(), signed_mean(bias.of_camera_deg),
                        signed_mean(bias.of_measurement_deg), signed_mean(bias.of_both_deg));
  }
  if (text.empty()) return "";
  return fmt::format("{:<18} {:>4} | {:>17} {:>22} {:>15}\n", "mean signed [deg]", "n",
                     "outline less heap", "measured less outline", "both") +
         text + '\n';
}

}  // namespace repose::bench
