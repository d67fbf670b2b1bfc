#include "calibrate/statistics/factor_rules.h"

#include <cmath>
#include <set>

#include <fmt/format.h>

namespace repose::calibrate {

void check_factors(const std::vector<Factor>& factors, std::size_t least, std::size_t most,
                   base::Faults& errors) {
  errors.require(
      factors.size() >= least && factors.size() <= most,
      {.value = fmt::format("{} factors: this design takes {} to {}", factors.size(), least, most),
       .fix = "name as many."});
  std::set<std::string> names;
  for (const Factor& factor : factors) {
    errors.require(!factor.name.empty(), {.value = "a factor has no name", .fix = "NAME=MIN:MAX."});
    errors.require(
        names.insert(factor.name).second,
        {.where = factor.name, .value = "is named twice", .fix = "give each factor once."});
    constexpr double kMost = 1e100;  // squares and differences of levels are still numbers
    errors.require(!(std::abs(factor.low) > kMost || std::abs(factor.high) > kMost),
                   {.value = fmt::format("{} = {:g}:{:g}: a level is out of range", factor.name,
                                         factor.low, factor.high),
                    .rule = fmt::format("at most {:g} either way", kMost),
                    .fix = "choose another unit."});
    errors.require(factor.low < factor.high,
                   {.value = fmt::format("{} = {:g}:{:g}: the lower level", factor.name, factor.low,
                                         factor.high),
                    .rule = "must be below the higher",
                    .fix = fmt::format("{}=MIN:MAX.", factor.name)});
  }
}

void check_count(const char* what, int count, int least, int most, base::Faults& errors) {
  errors.require(count >= least && count <= most,
                 {.value = fmt::format("{} = {}:", what, count),
                  .rule = fmt::format("must be from {} to {}", least, most),
                  .fix = "choose one of these."});
}

}  // namespace repose::calibrate
