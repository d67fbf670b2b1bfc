#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "base/input_error.h"

/// JSON answers to the page.
namespace repose::studio {

using Json = nlohmann::ordered_json;

inline constexpr const char* kJson = "application/json";

inline std::string text_of(const Json& json) {
  // File names need not be UTF-8, JSON must be.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// Something was changed elsewhere since the page read it, and is not overwritten.
class ChangedMeanwhile : public base::InputError {
  using base::InputError::InputError;
};

}  // namespace repose::studio
