#include "calibrate/statistics/factor_rules.h"

#include <cmath>
#include <set>

#include <fmt/format.h>

namespace repose::calibrate {

void check_factors(const std::vector<Factor>& factors, std::size_t least, std::size_t most,
                   base::ErrorList& errors) {
  errors.require(factors.size() >= least && factors.size() <= most,
                 fmt::format("{} factors: this design takes {} to {}. Fix: name as many.",
                             factors.size(), least, most));
  std::set<std::string> names;
  for (const Factor& factor : factors) {
    errors.require(!factor.name.empty(), "a factor has no name. Fix: NAME=MIN:MAX.");
    errors.require(names.insert(factor.name).second,
                   fmt::format("{}: is named twice. Fix: give each factor once.", factor.name));
    constexpr double kMost = 1e100;  // squares and differences of levels are still numbers
    errors.require(
        !(std::abs(factor.low) > kMost || std::abs(factor.high) > kMost),
        fmt::format("{} = {:g}:{:g}: a level is out of range. Rule: at most {:g} either way. Fix: "
                    "choose another unit.",
                    factor.name, factor.low, factor.high, kMost));
    errors.require(factor.low < factor.high,
                   fmt::format("{} = {:g}:{:g}: the lower level must be below the higher. Fix: "
                               "{}=MIN:MAX.",
                               factor.name, factor.low, factor.high, factor.name));
  }
}

void check_count(const char* what, int count, int least, int most, base::ErrorList& errors) {
  errors.require(count >= least && count <= most,
                 fmt::format("{} = {}: must be from {} to {}. Fix: choose one of these.", what,
                             count, least, most));
}

}  // namespace repose::calibrate
