#include "dem/contact/contact_table.h"

#include <cmath>

#include <fmt/format.h>

#include "base/input_error.h"
#include "dem/contact/restitution.h"

namespace repose::dem {
namespace {

void require(base::Faults& errors, bool holds, const std::string& where, const char* coefficient,
             double value, const char* rule) {
  errors.require(holds, {.where = where,
                         .subject = coefficient,
                         .value = fmt::format("is {:g}", value),
                         .rule = rule});
}

void check(const Material& material, base::Faults& errors) {
  const std::string name = "material " + material.name;
  const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
  require(errors, positive(material.density_kg_m3), name, "density_kg_m3", material.density_kg_m3,
          "above 0");
  require(errors, positive(material.young_modulus_pa), name, "young_modulus_pa",
          material.young_modulus_pa, "above 0");
  require(errors, material.poisson_ratio >= 0 && material.poisson_ratio < .5, name, "poisson_ratio",
          material.poisson_ratio, "0 to below .5");
}

void check(const PairCoefficients& pair, const std::string& names, base::Faults& errors) {
  const auto friction = [](double value) { return value >= 0 && value <= 100; };
  require(errors, pair.restitution >= kMinRestitution && pair.restitution <= 1, names,
          "restitution", pair.restitution, ".01 to 1");
  require(errors, friction(pair.sliding_friction), names, "sliding_friction", pair.sliding_friction,
          "0 or above");
  require(errors, friction(pair.rolling_friction), names, "rolling_friction", pair.rolling_friction,
          "0 or above");
  if (pair.restitution_exponent == 0) return;
  require(errors,
          pair.restitution_exponent > 0 && pair.restitution_exponent <= kMaxRestitutionExponent,
          names, "restitution_exponent", pair.restitution_exponent, "0 to .25");
  require(errors, pair.restitution_speed_m_s > 0 && std::isfinite(pair.restitution_speed_m_s),
          names, "restitution_speed_m_s", pair.restitution_speed_m_s,
          "above 0, the speed that the restitution is of");
  require(errors, !(pair.restitution > kMaxRestitutionBySpeed), names, "restitution",
          pair.restitution, "at most .99 where it depends on the speed");
}

ContactLaw law_of(const Material& a, const Material& b, const PairCoefficients& pair) {
  const auto normal_compliance = [](const Material& m) {
    return (1 - m.poisson_ratio * m.poisson_ratio) / m.young_modulus_pa;
  };
  const auto shear_compliance = [](const Material& m) {
    return 2 * (2 - m.poisson_ratio) * (1 + m.poisson_ratio) / m.young_modulus_pa;
  };
  const double young = 1 / (normal_compliance(a) + normal_compliance(b));
  const double shear = 1 / (shear_compliance(a) + shear_compliance(b));
  const double tangential_root = std::sqrt(4 * shear / young);
  return {.reduced_young_pa = young,
          .reduced_shear_pa = shear,
          .normal_damping = damping_factor(pair.restitution),
          .tangential_damping = textbook_damping_factor(pair.restitution) * tangential_root,
          .sliding_friction = pair.sliding_friction,
          .rolling_friction = pair.rolling_friction,
          .by_speed = SpeedDamping(pair),
          .tangential_root = tangential_root};
}

}  // namespace

ContactTable::ContactTable(std::vector<Material> materials, std::vector<PairCoefficients> pairs,
                           RollingModel rolling, DampingModel damping)
    : materials_(std::move(materials)),
      pairs_(std::move(pairs)),
      rolling_(rolling),
      damping_(damping) {
  const std::size_t count = materials_.size();
  if (pairs_.size() != count * count) {
    throw base::InputError(
        {.value = fmt::format("{} materials need {} pairs of coefficients; {} are given", count,
                              count * count, pairs_.size())});
  }
  base::Faults errors;
  for (const Material& material : materials_) check(material, errors);
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const Material& a = materials_[k / count];
    const Material& b = materials_[k % count];
    check(pairs_[k], a.name + " on " + b.name, errors);
  }
  errors.throw_if_any();
  laws_.reserve(pairs_.size());
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    laws_.push_back(law_of(materials_[k / count], materials_[k % count], pairs_[k]));
    is_by_speed_ = is_by_speed_ || !laws_.back().by_speed.is_constant();
  }
}

}  // namespace repose::dem
