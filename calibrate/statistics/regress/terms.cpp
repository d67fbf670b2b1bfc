#include <fmt/format.h>

#include "calibrate/statistics/regress/regression.h"

namespace repose::calibrate {

std::vector<Term> terms_of(SurfaceModel model, std::size_t factors) {
  std::vector<Term> terms = {{}};
  for (std::size_t i = 0; i < factors; ++i) terms.push_back({i});
  if (model == SurfaceModel::linear) return terms;
  for (std::size_t i = 0; i < factors; ++i) {
    for (std::size_t j = i + 1; j < factors; ++j) terms.push_back({i, j});
  }
  if (model == SurfaceModel::interaction) return terms;
  for (std::size_t i = 0; i < factors; ++i) terms.push_back({i, i});
  return terms;
}

std::string name_of(const Term& term, const std::vector<Factor>& factors) {
  if (term.empty()) return "1";
  const std::string& first = factors[term.front()].name;
  if (term.size() == 1) return first;
  if (term.front() == term.back()) return first + "^2";
  return fmt::format("{}*{}", first, factors[term.back()].name);
}

}  // namespace repose::calibrate
