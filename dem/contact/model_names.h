#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "dem/contact/material.h"

namespace repose::dem {

/// Names of the damping models in files.
inline constexpr std::array<std::pair<DampingModel, std::string_view>, 2> kDampingNames = {{
    {DampingModel::per_contact, "per_contact"},
    {DampingModel::shared, "shared"},
}};

inline std::string name_of(DampingModel model) {
  for (const auto& [known, name] : kDampingNames) {
    if (known == model) return std::string(name);
  }
  return {};
}

/// States what a coefficient of restitution means for a clump.
inline std::string damping_definition(DampingModel model) {
  return model == DampingModel::shared
             ? "contacts of two bodies share their reduced mass by elastic energy, and rebound "
               "together as one would"
             : "each contact damps with the whole reduced mass, so that a restitution belongs to "
               "the number of spheres";
}

inline std::optional<DampingModel> damping_model_named(std::string_view name) {
  for (const auto& [model, known] : kDampingNames) {
    if (known == name) return model;
  }
  return std::nullopt;
}

/// Names of the rolling models in files.
inline constexpr std::array<std::pair<RollingModel, std::string_view>, 4> kRollingNames = {{
    {RollingModel::none, "none"},
    {RollingModel::constant_torque, "constant_torque"},
    {RollingModel::relative_constant_torque, "relative_constant_torque"},
    {RollingModel::elastic_plastic, "elastic_plastic"},
}};

inline std::string name_of(RollingModel model) {
  for (const auto& [known, name] : kRollingNames) {
    if (known == model) return std::string(name);
  }
  return {};
}

/// The contact model in a few words.
inline constexpr std::string_view kContactModel = "Hertz-Mindlin (no slip)";

/// How the torque of rolling friction is defined.
inline std::string rolling_definition(RollingModel model) {
  switch (model) {
    case RollingModel::none:
      return "no rolling friction";
    case RollingModel::constant_torque:
      return "on each body mu_r F_n times its own distance from centre of mass to contact, against "
             "its own spin";
    case RollingModel::relative_constant_torque:
      return "mu_r F_n times the reduced radius, against the relative spin";
    case RollingModel::elastic_plastic:
      break;
  }
  return "rolling spring with a plastic limit of mu_r F_n times the reduced radius";
}

inline std::optional<RollingModel> rolling_model_named(std::string_view name) {
  for (const auto& [model, known] : kRollingNames) {
    if (known == name) return model;
  }
  return std::nullopt;
}

}  // namespace repose::dem
