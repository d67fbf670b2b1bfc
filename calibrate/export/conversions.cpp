#include "calibrate/export/conversions.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "calibrate/export/target_entry.h"
#include "dem/contact/model_names.h"

namespace repose::calibrate {
namespace {

Conversion restitution(ExportTarget target, const std::string& pair, double value) {
  const RestitutionCounterpart theirs = target->restitution(value);
  return {.coefficient = pair + "restitution",
          .value = value,
          .exported = theirs.value,
          .target_name = theirs.name,
          .fidelity = theirs.fidelity,
          .ours =
              "speed after per speed before a central impact of two spheres; the "
              "damper never pulls",
          .theirs = theirs.law,
          .limits = theirs.limits};
}

Conversion sliding(ExportTarget target, const std::string& pair, double value) {
  return {.coefficient = pair + "sliding_friction",
          .value = value,
          .exported = value,
          .target_name = std::string(target->sliding_name),
          .fidelity = Fidelity::exact,
          .ours = "Coulomb's limit of a Mindlin spring without slip",
          .theirs = "the same",
          .limits = std::string(target->sliding_limits)};
}

Conversion rolling(ExportTarget target, const std::string& pair, Partner partner,
                   const ExportFacts& facts, double value) {
  const dem::RollingModel model = facts.study().model.rolling;
  const RollingConversion own = convert_rolling(target, model, partner, facts.grain());
  Conversion converted{.coefficient = pair + "rolling_friction",
                       .value = value,
                       .exported = value * own.factor,
                       .target_name = std::string(target->rolling_name),
                       .fidelity = own.fidelity,
                       .ours = rolling_law(model),
                       .theirs = target->rolling_law(model),
                       .limits = own.limits};
  if (value == 0 || model == dem::RollingModel::none) {
    converted.exported = 0;
    converted.fidelity = Fidelity::exact;
    converted.limits = "Without rolling friction there is nothing to convert.";
  }
  return converted;
}

/// Coefficients by what grains touch: "wall", "tube" and so on, "particle".
std::vector<std::pair<std::string, const dem::PairCoefficients*>> pairs_of(
    const ExportFacts& facts) {
  const dem::Model& model = facts.study().model;
  std::vector<std::pair<std::string, const dem::PairCoefficients*>> pairs = {
      {"wall", &model.grain_wall}};
  for (const dem::WallPart part : facts.parts()) {
    pairs.emplace_back(name_of(part), &facts.surface(part).with_grain);
  }
  if (facts.has_grain_contacts()) pairs.emplace_back("particle", &model.grain_grain);
  return pairs;
}

void add_pair(const ExportFacts& facts, ExportTarget target, Partner partner,
              const std::string& other, const dem::PairCoefficients& values,
              std::vector<Conversion>& all) {
  const std::string pair = "contact.particle_" + other + '.';
  all.push_back(restitution(target, pair, values.restitution));
  all.push_back(sliding(target, pair, values.sliding_friction));
  all.push_back(rolling(target, pair, partner, facts, values.rolling_friction));
}

}  // namespace

std::vector<Conversion> conversions_of(const ExportFacts& facts, ExportTarget target) {
  std::vector<Conversion> all;
  for (const auto& [other, pair] : pairs_of(facts)) {
    const Partner partner = other == "particle" ? Partner::grain : Partner::wall;
    add_pair(facts, target, partner, other, *pair, all);
  }
  return all;
}

double exported(const std::vector<Conversion>& conversions, const std::string& coefficient) {
  for (const Conversion& conversion : conversions) {
    if (conversion.coefficient == coefficient) return conversion.exported;
  }
  return std::nan("");
}

std::pair<double, double> exported_bounds(const ExportFacts& facts, ExportTarget target,
                                          const Conversion& conversion,
                                          std::pair<double, double> ours) {
  const std::string& name = conversion.coefficient;
  const std::string pair = name.substr(0, name.rfind('.') + 1);
  const Partner partner = pair == "contact.particle_particle." ? Partner::grain : Partner::wall;
  const auto theirs = [&](double value) {
    if (name.ends_with("restitution")) return restitution(target, pair, value).exported;
    if (name.ends_with("sliding_friction")) return sliding(target, pair, value).exported;
    return rolling(target, pair, partner, facts, value).exported;
  };
  const double one = theirs(ours.first), other = theirs(ours.second);
  return {std::min(one, other), std::max(one, other)};
}

std::string pair_text(const std::string& coefficient) {
  constexpr std::string_view kBefore = "contact.particle_";
  const std::string other =
      coefficient.substr(kBefore.size(), coefficient.rfind('.') - kBefore.size());
  return "grain with " + (other == "particle" ? std::string("grain") : other);
}

std::vector<base::Fault> refusals(const ExportFacts& facts, const ExportRequest& request,
                                  const std::vector<Conversion>& conversions) {
  std::vector<base::Fault> errors;
  const std::size_t spheres = facts.grain().spheres.size();
  if (facts.study().model.damping == dem::DampingModel::shared && spheres > 1) {
    errors.push_back(
        {.subject = "contact.damping",
         .value = fmt::format(
             "= \"shared\" has no counterpart in {}, where each contact of the clump's {} spheres "
             "damps with the whole mass: the more of them touch at once, the less it would rebound "
             "than here. No single factor makes up for that, so --approximate does not help",
             name_of(request.target), spheres),
         .fix =
             "calibrate with damping = \"per_contact\", whose restitution belongs to this clump."});
  }
  for (const auto& [other, pair] : pairs_of(facts)) {
    if (pair->restitution_exponent == 0) continue;
    errors.push_back(
        {.value = fmt::format(
             "contact.particle_{0}.restitution_exponent = {1:g} has no counterpart in {2}, where "
             "restitution is the same at all speeds: impacts slower or faster than {3:g} m/s would "
             "rebound otherwise than here, so --approximate does not help",
             other, pair->restitution_exponent, name_of(request.target),
             pair->restitution_speed_m_s),
         .fix = "calibrate without it, with drops whose impacts are as fast as those of the "
                "process."});
  }
  if (request.takes_approximate) return errors;
  for (const Conversion& conversion : conversions) {
    if (conversion.fidelity != Fidelity::approximate) continue;
    const std::string target = name_of(request.target);
    errors.push_back(
        {.subject = conversion.coefficient,
         .value = fmt::format("= {:.4g} ({}) has no exact counterpart in {}. {}", conversion.value,
                              dem::name_of(facts.study().model.rolling), target, conversion.limits),
         .fix = fmt::format("--approximate exports {:.4g}; or calibrate with a rolling_model that "
                            "{} has.",
                            conversion.exported, target)});
  }
  return errors;
}

}  // namespace repose::calibrate
