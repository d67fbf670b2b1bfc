#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "dem/contact/material.h"

namespace repose::dem {

/// What files call the rolling models.
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

inline std::optional<RollingModel> rolling_model_named(std::string_view name) {
  for (const auto& [model, known] : kRollingNames) {
    if (known == name) return model;
  }
  return std::nullopt;
}

}  // namespace repose::dem
