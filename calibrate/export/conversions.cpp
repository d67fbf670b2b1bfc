#include "calibrate/export/conversions.h"

#include <cmath>

#include <fmt/format.h>

#include "calibrate/export/rolling.h"
#include "dem/contact/model_names.h"
#include "dem/contact/restitution.h"

namespace repose::calibrate {
namespace {

/// LIGGGHTS takes restitution above .05 only.
constexpr double kMinLiggghtsRestitution = .0501;

struct RestitutionLaw {
  const char* name;
  const char* law;
  const char* limits;
};

RestitutionLaw restitution_law(ExportTarget target) {
  constexpr const char* kPulls =
      "The damper may pull and has the textbook factor, which then gives the same rebound of a "
      "sphere. Spheres of a clump that land at once lose a different fraction of the speed from "
      "ours.";
  switch (target) {
    case ExportTarget::liggghts:
      return {"coefficientRestitution", "speed after per speed before a central impact", kPulls};
    case ExportTarget::lammps:
      return {
          "damping tsuji",
          "damper p(value) sqrt(2/3 S_n m*), p a polynomial of degree 6; it may pull",
          "The value is that for which p is the textbook factor times sqrt(3/2), and may be "
          "below 0. Spheres of a clump that land at once lose a different fraction of the speed "
          "from ours."};
    case ExportTarget::yade:
      return {"betan",
              "damper 2 betan sqrt(S_n m*), which never pulls: betan is half of our factor c(e)",
              "A clump's spheres are given the clump's mass, which YADE uses for damping."};
    case ExportTarget::edem:
      break;
  }
  return {"Coefficient of Restitution", "speed after per speed before a central impact",
          "EDEM's damper has the textbook factor. Where tensile damping is disabled, low values "
          "rebound too high (0.1 gives 0.25): calibrate the drop there."};
}

/// The polynomial by which LAMMPS turns a restitution into the factor of its `damping tsuji`
/// (LAMMPS documentation, "pair_style granular", eq. for alpha); falls with `value` below 1.
double tsuji_polynomial(double value) {
  double sum = 0;
  for (const double term : {4.8218, -18.022, 27.467, -22.348, 11.087, -4.2783, 1.2728}) {
    sum = sum * value + term;
  }
  return sum;
}

/// Where it takes a value, 0 to 6 (restitution from .01 on): by halving.
double tsuji_value(double factor) {
  double low = -1;
  double high = 1;
  constexpr int kHalvings = 60;
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = .5 * (low + high);
    (tsuji_polynomial(middle) > factor ? low : high) = middle;
  }
  return .5 * (low + high);
}

double exported_restitution(ExportTarget target, double restitution) {
  if (target == ExportTarget::yade) return dem::damping_factor(restitution) / 2;
  if (target == ExportTarget::lammps) {
    return tsuji_value(std::sqrt(1.5) * dem::textbook_damping_factor(restitution));
  }
  if (target == ExportTarget::liggghts) return std::max(restitution, kMinLiggghtsRestitution);
  return restitution;
}

Conversion restitution(ExportTarget target, const std::string& pair, double value) {
  const RestitutionLaw law = restitution_law(target);
  Conversion converted{.coefficient = pair + "restitution",
                       .value = value,
                       .exported = exported_restitution(target, value),
                       .target_name = law.name,
                       .ours =
                           "speed after per speed before a central impact of two spheres; the "
                           "damper never pulls",
                       .theirs = law.law,
                       .limits = law.limits};
  if (target == ExportTarget::edem) converted.fidelity = Fidelity::close;
  if (target == ExportTarget::liggghts && converted.exported > value) {
    converted.fidelity = Fidelity::approximate;
    converted.limits = "LIGGGHTS accepts only values above .05.";
  }
  return converted;
}

std::string friction_name(ExportTarget target) {
  switch (target) {
    case ExportTarget::liggghts:
      return "coefficientFriction";
    case ExportTarget::lammps:
      return "tangential mindlin_rescale, last value";
    case ExportTarget::yade:
      return "frictAngle, its tangent";
    case ExportTarget::edem:
      break;
  }
  return "Coefficient of Static Friction";
}

Conversion sliding(ExportTarget target, const std::string& pair, double value) {
  Conversion converted{.coefficient = pair + "sliding_friction",
                       .value = value,
                       .exported = value,
                       .target_name = friction_name(target),
                       .ours = "Coulomb's limit of a Mindlin spring without slip",
                       .theirs = "the same"};
  if (target == ExportTarget::liggghts || target == ExportTarget::yade) {
    converted.limits =
        "Their spring keeps its force when the contact unloads, ours shrinks with the contact: "
        "oblique impacts cause slightly more spin.";
  }
  return converted;
}

std::string rolling_name(ExportTarget target) {
  switch (target) {
    case ExportTarget::liggghts:
      return "coefficientRollingFriction";
    case ExportTarget::lammps:
      return "rolling sds, last value";
    case ExportTarget::yade:
      return "eta";
    case ExportTarget::edem:
      break;
  }
  return "Coefficient of Rolling Friction";
}

Conversion rolling(ExportTarget target, const std::string& pair, Partner partner,
                   const ExportFacts& facts, double value) {
  const dem::RollingModel model = facts.study().model.rolling;
  const RollingConversion own = convert_rolling(target, model, partner, facts.grain());
  Conversion converted{.coefficient = pair + "rolling_friction",
                       .value = value,
                       .exported = value * own.factor,
                       .target_name = rolling_name(target),
                       .fidelity = own.fidelity,
                       .ours = rolling_law(model),
                       .theirs = rolling_law(target, model),
                       .limits = own.limits};
  if (value == 0 || model == dem::RollingModel::none) {
    converted.exported = 0;
    converted.fidelity = Fidelity::exact;
    converted.limits = "Without rolling friction there is nothing to convert.";
  }
  return converted;
}

/// By what grains touch: "wall", "tube" and so on, "particle".
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
