#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "dem/contact/material.h"

namespace repose::dem {

/// What files call the damping models.
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

/// What a coefficient of restitution means for a clump.
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

}  // namespace repose::dem
