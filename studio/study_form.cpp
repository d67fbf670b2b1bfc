#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "calibrate/start/new_request.h"
#include "calibrate/statistics/bench/sheet.h"
#include "calibrate/statistics/table/table.h"
#include "dem/experiment/experiment_table.h"
#include "studio/study_folder.h"

namespace repose::studio {
namespace {

/// Advice names the page's fields, not command-line options.
std::string text_of(const base::Fault& fault) { return base::with_names(fault.text()); }

Json bounds_json(const calibrate::ContactBounds& bounds) {
  const auto range = [](const calibrate::CoefficientBounds& one) { return Json{one.min, one.max}; };
  return {{"restitution", range(bounds.restitution)},
          {"sliding_friction", range(bounds.sliding_friction)},
          {"rolling_friction", range(bounds.rolling_friction)}};
}

/// Reads the form; what is not a text or number becomes an error of its field.
class Said {
 public:
  Said(const Json& json, base::Faults& faults) : json_(json), faults_(faults) {}

  std::string text(const char* key) const {
    const auto found = json_.find(key);
    return found != json_.end() && found->is_string() ? found->get<std::string>() : std::string();
  }

  /// A cell of the form, with a decimal point or comma; std::nullopt if it is empty.
  std::optional<double> number(const std::string& text, const char* field) const {
    if (text.find_first_not_of(' ') == std::string::npos) return std::nullopt;
    const auto value = calibrate::number_of(text);
    faults_.require(
        value.has_value(),
        {.subject = field, .value = fmt::format("is \"{}\"", text), .rule = "a number"});
    return value;
  }

  /// Several numbers, of which all or none must be given.
  template <std::size_t count>
  std::optional<std::array<double, count>> numbers(const char* key, const char* field) const {
    const std::vector<std::string> texts = this->texts(key);
    std::array<double, count> values{};
    std::size_t given = 0;
    for (std::size_t k = 0; k < std::min(count, texts.size()); ++k) {
      const auto value = number(texts[k], field);
      if (!value) continue;
      values[k] = *value;
      ++given;
    }
    if (given == 0) return std::nullopt;
    if (given < count) {
      faults_.add({.subject = field,
                   .value = fmt::format("has {} of its {} numbers", given, count),
                   .fix = "fill in all of them, or none."});
      return std::nullopt;
    }
    return values;
  }

  std::vector<std::string> texts(const char* key) const {
    std::vector<std::string> texts;
    const auto found = json_.find(key);
    if (found == json_.end() || !found->is_array()) return texts;
    for (const Json& one : *found) {
      if (one.is_string()) texts.push_back(one.get<std::string>());
    }
    return texts;
  }

 private:
  const Json& json_;
  base::Faults& faults_;
};

/// A name in the folder; paths out of it are refused.
std::string name_in(const Said& said, base::Faults& faults) {
  std::string name = said.text("study");
  const bool is_plain = !name.empty() && name.front() != '.' && name.front() != '-' &&
                        name.find('/') == std::string::npos;
  faults.require(is_plain, {.subject = "study",
                            .value = name.empty() ? "has no name" : fmt::format("is {}", name),
                            .rule = "a name without slashes that begins with no point or dash",
                            .fix = "peas, say."});
  if (!is_plain) return "new.toml";
  return name.ends_with(".toml") ? name : name + ".toml";
}

/// A draft and its description for the page.
struct Draft {
  std::string name;
  calibrate::RequestedStudy made;
  Json json;
};

Json sheets_json(const calibrate::NewStudy& study) {
  Json sheets = Json::array();
  for (const calibrate::NewSheet& sheet : calibrate::sheets_of(study)) {
    sheets.push_back(
        {{"experiment", sheet.experiment->name}, {"name", sheet.name}, {"columns", sheet.columns}});
  }
  return sheets;
}

/// Defaults of the form's fields.
Json usual_json(calibrate::NewRequest request) {
  request.grain_mm.reset();
  request.density_kg_m3.reset();
  request.tube_mm.reset();
  const calibrate::NewStudy usual = calibrate::requested_study(request).study;
  return {{"grain_mm", usual.sizes_mm},
          {"density_kg_m3", usual.density_kg_m3},
          {"tube_mm", {usual.tube_diameter_mm, usual.tube_height_mm}}};
}

Draft drafted(const std::filesystem::path& folder, const Json& json) {
  base::Faults faults;
  if (!json.is_object()) throw base::InputError({.value = "what was sent is no object"});
  const Said said(json, faults);
  Draft draft;
  draft.name = name_in(said, faults);
  const bool has_name = faults.empty();
  calibrate::NewRequest request{.study = folder / draft.name,
                                .grains = said.text("grains"),
                                .plate = said.text("plate"),
                                .experiments = said.texts("experiments")};
  for (const auto& [part, name] : dem::kWallParts) {
    request.parts.emplace(part, said.text(std::string(name).c_str()));
  }
  request.grain_mm = said.numbers<3>("grain_mm", "size");
  request.density_kg_m3 = said.number(said.text("density_kg_m3"), "density");
  request.tube_mm = said.numbers<2>("tube_mm", "size of the tube");
  draft.made = calibrate::requested_study(request);
  Json told = Json::array();
  const auto tell = [&](const base::Fault& fault) {
    told.push_back(
        {{"field", fault.subject.empty() ? "study" : fault.subject}, {"text", text_of(fault)}});
  };
  for (const base::Fault& fault : faults.all()) tell(fault);
  for (const base::Fault& fault : draft.made.faults) {
    if (has_name || !fault.subject.empty()) tell(fault);
  }
  Json assumed = Json::array();
  for (const calibrate::Assumption& one : calibrate::assumptions_of(draft.made.study)) {
    assumed.push_back(one.text);
  }
  const auto sticky = calibrate::sticking_of(draft.made.study);
  const Json usual = usual_json(request);
  request.study = draft.name;
  draft.json = {{"command", calibrate::new_command(request)},
                {"faults", told},
                {"title", calibrate::title_of(draft.made.study)},
                {"assumed", assumed},
                {"warning", sticky ? Json(*sticky) : Json(nullptr)},
                {"sheets", sheets_json(draft.made.study)},
                {"usual", usual}};
  return draft;
}

}  // namespace

Json new_study_form() {
  Json form{{"grains", Json::array()},
            {"plates", Json::array()},
            {"parts", Json::array()},
            {"experiments", Json::array()},
            {"usual_grain", calibrate::kUsualGrain},
            {"usual_plate", calibrate::kUsualPlate}};
  for (const calibrate::GrainKind& kind : calibrate::grain_kinds()) {
    form["grains"].push_back({{"name", kind.name},
                              {"plural", kind.plural},
                              {"with_wall", bounds_json(kind.with_wall)},
                              {"with_grain", bounds_json(kind.with_grain)},
                              {"source", kind.source}});
  }
  for (const calibrate::PlateKind& kind : calibrate::plate_kinds()) {
    form["plates"].push_back(kind.name);
  }
  for (const auto& [part, name] : dem::kWallParts) form["parts"].push_back(name);
  for (const dem::ExperimentEntry& entry : dem::all_experiments()) {
    Json parts = Json::array();
    for (const dem::WallPart part : entry.parts) parts.push_back(name_of(part));
    form["experiments"].push_back({{"name", entry.name},
                                   {"description", entry.description},
                                   {"value_name", entry.value_name},
                                   {"unit", entry.unit},
                                   {"is_default", entry.is_default},
                                   {"has_tube", entry.needs_tube},
                                   {"parts", parts}});
  }
  return form;
}

Json drafted_study(const std::filesystem::path& folder, const Json& said) {
  return drafted(folder, said).json;
}

Json start_study(const std::filesystem::path& folder, const Json& said) {
  Draft draft = drafted(folder, said);
  base::Faults faults;
  for (const Json& fault : draft.json.at("faults")) {
    faults.add({.value = fault.at("text").get<std::string>()});
  }
  faults.throw_if_any();
  calibrate::write_new_study(draft.made.study, folder / draft.name);
  draft.json["study"] = draft.name;
  return draft.json;
}

}  // namespace repose::studio
