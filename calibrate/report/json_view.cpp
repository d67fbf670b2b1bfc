#include "calibrate/report/json_view.h"

#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace repose::calibrate::report {

using Json = nlohmann::ordered_json;

/// A place in a tree that all its views keep alive.
struct JsonView::Part {
  std::shared_ptr<const Json> tree;
  const Json* here = nullptr;
};

JsonView::JsonView() = default;
JsonView::JsonView(std::shared_ptr<const Part> part) : part_(std::move(part)) {}

JsonView JsonView::of_text(const std::string& text) {
  auto tree = std::make_shared<const Json>(Json::parse(text, nullptr, false));
  if (tree->is_discarded()) return {};
  const Json* root = tree.get();
  return JsonView(std::make_shared<const Part>(Part{std::move(tree), root}));
}

JsonView JsonView::of_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return {};
  const JsonView view = of_text({std::istreambuf_iterator<char>(in), {}});
  if (!view.exists() || !view.part_->here->is_object()) {
    throw std::invalid_argument(fmt::format(
        "{}: is damaged, no JSON object. Fix: repose calibrate writes it again.", file.string()));
  }
  return view;
}

bool JsonView::exists() const { return part_ != nullptr && !part_->here->is_null(); }

JsonView JsonView::operator[](std::string_view key) const {
  if (part_ == nullptr || !part_->here->is_object()) return {};
  const auto found = part_->here->find(std::string(key));
  if (found == part_->here->end()) return {};
  return JsonView(std::make_shared<const Part>(Part{part_->tree, &*found}));
}

std::vector<JsonView> JsonView::items() const {
  std::vector<JsonView> items;
  if (part_ == nullptr || !part_->here->is_array()) return items;
  for (const Json& item : *part_->here) {
    items.push_back(JsonView(std::make_shared<const Part>(Part{part_->tree, &item})));
  }
  return items;
}

std::vector<std::pair<std::string, JsonView>> JsonView::members() const {
  std::vector<std::pair<std::string, JsonView>> members;
  if (part_ == nullptr || !part_->here->is_object()) return members;
  for (const auto& [key, value] : part_->here->items()) {
    members.emplace_back(key, JsonView(std::make_shared<const Part>(Part{part_->tree, &value})));
  }
  return members;
}

std::optional<double> JsonView::number() const {
  if (part_ == nullptr || !part_->here->is_number()) return std::nullopt;
  return part_->here->get<double>();
}

std::string JsonView::text() const {
  if (part_ == nullptr || !part_->here->is_string()) return {};
  return part_->here->get<std::string>();
}

bool JsonView::is_true() const {
  return part_ != nullptr && part_->here->is_boolean() && part_->here->get<bool>();
}

std::vector<double> JsonView::numbers() const {
  std::vector<double> numbers;
  for (const JsonView& item : items()) {
    numbers.push_back(item.number().value_or(std::numeric_limits<double>::quiet_NaN()));
  }
  return numbers;
}

std::string JsonView::shown() const {
  if (!exists()) return "–";
  if (const auto value = number()) return fmt::format("{:.6g}", *value);
  if (part_->here->is_string()) return text();
  return part_->here->dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace repose::calibrate::report
