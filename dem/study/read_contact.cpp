#include "dem/study/read_contact.h"

#include <array>
#include <limits>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "dem/contact/model_names.h"
#include "dem/study/read_shared.h"

namespace repose::dem {
namespace {

// Ranges accepted by ContactTable.
constexpr Range kRestitution = from_to(kMinRestitution, 1);
constexpr Range kRestitutionBySpeed = from_to(kMinRestitution, kMaxRestitutionBySpeed);
constexpr Range kExponent = from_to(0, kMaxRestitutionExponent);
constexpr Range kFriction = from_to(0, 100);

/// Prior knowledge: { min = 0.1, max = 0.6, mean = 0.3, sd = 0.05 }.
void read_known(Section& bounds, const BoundsRules& rules, Coefficient& coefficient) {
  coefficient.known_mean = bounds.number("mean", rules.mean, "mean = 0.3");
  coefficient.known_sd = bounds.number("sd", rules.widths, "sd = 0.05");
  if (bounds.has("mean") != bounds.has("sd")) {
    bounds.errors().add(bounds.place(),
                        fmt::format("{} has {}", bounds.path(),
                                    bounds.has("mean") ? "a mean and no sd" : "an sd and no mean"),
                        "what is known beforehand is a mean and its standard deviation",
                        "give both, or take it out");
  }
}

/// Where the bounds come from: { min = 0, max = 0.8, bounds = "convenience" }.
void read_origin(Section& bounds, Coefficient& coefficient) {
  const std::string example = R"(bounds = "known" or bounds = "convenience")";
  const auto given = bounds.text("bounds", example);
  if (!given) return;
  if (*given == "known" || *given == "convenience") {
    coefficient.are_bounds_known = *given == "known";
    return;
  }
  bounds.errors().add(
      bounds.value("bounds")->place, fmt::format("{} = \"{}\"", bounds.full("bounds"), *given),
      "\"known\", where no such material lies outside, or \"convenience\"", example);
}

}  // namespace

void read_bounds(Section bounds, const ConfigValue& whole, const BoundsRules& rules,
                 const std::string& example, bool takes_value, Coefficient& coefficient) {
  if (takes_value) coefficient.value = bounds.number("value", rules.bounds, "value = 0.3");
  const auto min = bounds.number("min", rules.bounds, example);
  const auto max = bounds.number("max", rules.bounds, example);
  for (const char* key : {"min", "max"}) {
    if (bounds.has(key)) continue;
    bounds.errors().add(bounds.place(), fmt::format("{}.{} is missing", bounds.path(), key),
                        "both bounds, or a number", "for example " + example);
  }
  read_known(bounds, rules, coefficient);
  read_origin(bounds, coefficient);
  coefficient.useful_half_width =
      bounds.number("useful_half_width", rules.widths, "useful_half_width = 0.05");
  bounds.reject_unknown_keys();
  if (!min || !max) return;
  coefficient.min = *min;
  coefficient.max = *max;
  const auto wrong = [&](const char* rule, const char* fix) {
    bounds.errors().add(bounds.place(), fmt::format("{} = {}", bounds.path(), whole.shown), rule,
                        fix);
  };
  if (*min >= *max) wrong("min below max", "swap them, or give one number");
  const auto is_outside = [&](const std::optional<double>& number) {
    return number && *min < *max && (*number < *min || *number > *max);
  };
  if (is_outside(coefficient.known_mean)) {
    wrong("mean within min and max", "widen the bounds, or correct the mean");
  }
  if (is_outside(coefficient.value)) {
    wrong("value within min and max", "widen the bounds, or correct the value");
  }
}

namespace {

Coefficient read_coefficient(Section& pair, const std::string& key, const Range& range,
                             const std::string& number,
                             const std::string& some_bounds = "{ min = 0.1, max = 0.6 }") {
  const std::string bounds = fmt::format("{} = {}", key, some_bounds);
  const std::string rule = range.rule() + ", or bounds to find it in";
  const std::string example = fmt::format("{} = {} or {}", key, number, bounds);
  Coefficient coefficient;
  const ConfigValue* value = pair.value(key);
  if (value == nullptr) {
    if (pair.exists()) pair.missing(key, rule, example);
  } else if (value->kind == ConfigValue::Kind::table) {
    constexpr double kMax = 100;
    read_bounds(pair.section(key), *value,
                {.bounds = range, .mean = from_to(0, kMax), .widths = above(0, kMax)}, example,
                true, coefficient);
  } else {
    coefficient.value = pair.number(key, range, example);
  }
  return coefficient;
}

/// Speed dependence of restitution, if the study has it: an exponent and the speed at which the
/// restitution holds.
void read_speed(Section& pair, CoefficientSet& set) {
  constexpr const char* kExponentKey = "restitution_exponent";
  constexpr const char* kSpeedKey = "restitution_speed_m_s";
  constexpr double kFastest_m_s = 1000;
  const bool has_exponent = pair.has(kExponentKey);
  if (has_exponent) {
    set.restitution_exponent =
        read_coefficient(pair, kExponentKey, kExponent, "0.1", "{ min = 0, max = 0.25 }");
  } else {
    pair.value(kExponentKey);  // marks the key as known
  }
  set.restitution_speed_m_s =
      pair.number(kSpeedKey, above(0, kFastest_m_s), "restitution_speed_m_s = 3");
  if (has_exponent == pair.has(kSpeedKey)) return;
  pair.errors().add(
      pair.value(has_exponent ? kExponentKey : kSpeedKey)->place,
      fmt::format("{} is given without {}", pair.full(has_exponent ? kExponentKey : kSpeedKey),
                  has_exponent ? kSpeedKey : kExponentKey),
      "an impact at v restores restitution (v / restitution_speed_m_s)^-restitution_exponent",
      has_exponent ? "add the speed at which restitution is what it is, such as that of the drops"
                   : "take it out, or add restitution_exponent = { min = 0, max = 0.25 }");
}

/// A missing pair is reported once, not key by key.
CoefficientSet read_pair(Section& contact, const std::string& key) {
  if (contact.exists() && !contact.has(key)) {
    contact.errors().add(
        contact.place(), fmt::format("section [{}] is missing", contact.full(key)),
        "every pair has its coefficients, known or to be found",
        fmt::format("add [{}] with restitution, sliding_friction and rolling_friction, each a "
                    "number or {{ min = 0.1, max = 0.6 }}",
                    contact.full(key)));
  }
  Section pair = contact.section(key);
  const Range& restitution = pair.has("restitution_exponent") ? kRestitutionBySpeed : kRestitution;
  CoefficientSet set{
      .restitution = read_coefficient(pair, "restitution", restitution, "0.3"),
      .sliding_friction = read_coefficient(pair, "sliding_friction", kFriction, "0.4"),
      .rolling_friction = read_coefficient(pair, "rolling_friction", kFriction, "0.04")};
  read_speed(pair, set);
  pair.reject_unknown_keys();
  return set;
}

PairCoefficients values_of(const CoefficientSet& set) {
  constexpr double kOpen = std::numeric_limits<double>::quiet_NaN();
  return {.restitution = set.restitution.value.value_or(kOpen),
          .sliding_friction = set.sliding_friction.value.value_or(kOpen),
          .rolling_friction = set.rolling_friction.value.value_or(kOpen),
          .restitution_exponent = set.restitution_exponent.value.value_or(kOpen),
          .restitution_speed_m_s = set.restitution_speed_m_s.value_or(0)};
}

/// Reads the model named by `key`, one of `names`. Unchanged if not stated.
template <typename Model, std::size_t kCount>
void read_model(Section& contact, const std::string& key,
                const std::array<std::pair<Model, std::string_view>, kCount>& names,
                Model& chosen) {
  const std::string example = fmt::format("{} = \"{}\"", key, name_of(chosen));
  const auto given = contact.text(key, example);
  if (!given) return;
  std::string known;
  for (const auto& [model, name] : names) {
    if (name == *given) {
      chosen = model;
      return;
    }
    known += fmt::format("{}\"{}\"", known.empty() ? "" : ", ", name);
  }
  contact.wrong(*contact.value(key), "one of " + known, "for example " + example);
}

/// Coefficients with a part of another material than the plate's: material and coefficients must
/// both be given, or neither.
void read_part(Section& contact, WallPart part, Study& study) {
  const std::string key = "particle_" + name_of(part);
  const bool has_material = study.model.parts.contains(part);
  if (!has_material && !contact.has(key)) {
    contact.value(key);  // marks the key as known
    return;
  }
  const CoefficientSet set = read_pair(contact, key);
  if (!has_material) {
    contact.errors().add(
        contact.value(key)->place,
        fmt::format("{} has coefficients, and [wall.{}] is missing", contact.full(key),
                    name_of(part)),
        "a part with coefficients of its own has a material of its own",
        fmt::format("add [wall.{}] with young_modulus_pa and poisson_ratio, or take [{}] out",
                    name_of(part), contact.full(key)));
    return;
  }
  study.particle_parts[part] = set;
  study.model.parts[part].with_grain = values_of(set);
}

}  // namespace

void read_contact(Section contact, Study& study) {
  read_model(contact, "rolling_model", kRollingNames, study.model.rolling);
  read_model(contact, "damping", kDampingNames, study.model.damping);
  study.particle_wall = read_pair(contact, "particle_wall");
  study.particle_particle = read_pair(contact, "particle_particle");
  study.model.grain_wall = values_of(study.particle_wall);
  study.model.grain_grain = values_of(study.particle_particle);
  for (const auto& [part, part_name] : kWallParts) read_part(contact, part, study);
  contact.reject_unknown_keys();
}

}  // namespace repose::dem
