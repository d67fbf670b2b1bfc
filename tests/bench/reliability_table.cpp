#include "tests/bench/reliability_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "tests/bench/share.h"

namespace repose::bench {
namespace {

using testing::Group;

constexpr double kGoodEnough_deg = 1;

/// std::nullopt if it got no angle.
std::optional<bool> is_right(const Row& row) {
  if (!row.mean.measured_deg) return std::nullopt;
  const auto error = row.mean.error_deg();
  if (!error) return false;
  return std::abs(*error) <= std::max(kGoodEnough_deg, row.mean.uncertainty_deg.value_or(0));
}

struct Bin {
  std::string_view name;
  double below;  ///< upper limit of its pictures' confidence; the previous bin's is the lower limit
  int pictures = 0;
  int invented = 0;  ///< angles where there is no heap
  Share right = {};
  Share right_and_ok = {};  ///< of those with the status ok

  void add(const Row& row) {
    const auto right_one = is_right(row);
    ++pictures;
    invented += row.mean.measured_deg && !row.mean.true_deg ? 1 : 0;
    right.add(right_one);
    if (row.status == vision::MeasureStatus::ok) right_and_ok.add(right_one);
  }
};

constexpr std::string_view kBinLine =
    "{:<14} {:>8} | {:>6} {:>6} {:>7} {:>7} | {:>5} {:>6} {:>7}\n";

std::string line(const Bin& bin) {
  return fmt::format(kBinLine, bin.name, bin.pictures, bin.right.all, bin.right.hits,
                     bin.right.percent(), bin.invented, bin.right_and_ok.all, bin.right_and_ok.hits,
                     bin.right_and_ok.percent());
}

}  // namespace

std::string reliability_table(std::span<const Row> rows) {
  std::array bins = {Bin{"below 0.35", .35}, Bin{"0.35 to 0.5", .5}, Bin{"0.5 to 0.7", .7},
                     Bin{"0.7 to 0.9", .9}, Bin{"0.9 and above", 2}};
  Bin total{"all of these", 0};
  for (const Row& row : rows) {
    const auto its = std::find_if(bins.begin(), bins.end(),
                                  [&](const Bin& bin) { return row.confidence < bin.below; });
    its->add(row);
    total.add(row);
  }
  std::string text = fmt::format(kBinLine, "confidence", "pictures", "angles", "right", "right %",
                                 "no heap", "ok", "right", "right %");
  for (const Bin& bin : bins) text += line(bin);
  return text + line(total) +
         "right: within the interval or 1 degree of the truth; the others were refused\n";
}

std::string coverage_table(std::span<const Row> rows) {
  constexpr std::array kGroups = {
      std::pair{Group::clean, "clean"}, std::pair{Group::degraded, "degraded"},
      std::pair{Group::hollow, "hollow"}, std::pair{Group::sample, "sample"},
      std::pair{Group::misplaced, "misplaced"}};
  constexpr std::string_view kLine = "{:<14} {:>9} | {:>14} {:>5}\n";
  std::string text = fmt::format(kLine, "group", "intervals", "hold the truth", "%");
  Share total;
  for (const auto& [group, name] : kGroups) {
    Share covered;
    for (const Row& row : rows) {
      if (row.subject->group != group) continue;
      covered.add(row.mean.covered());
      total.add(row.mean.covered());
    }
    if (covered.all > 0) {
      text += fmt::format(kLine, name, covered.all, covered.hits, covered.percent());
    }
  }
  if (total.all == 0) return "";
  return text + fmt::format(kLine, "all of these", total.all, total.hits, total.percent());
}

}  // namespace repose::bench
