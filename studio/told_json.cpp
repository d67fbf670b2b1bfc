#include "studio/told_json.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/input_error.h"
#include "base/units.h"
#include "calibrate/measured/json_text.h"

namespace repose::studio {
namespace {

/// Reads values; each error names its key.
class Reader {
 public:
  Reader(const Json& json, base::Faults& faults) : json_(json), faults_(faults) {}

  bool has(const char* key) const { return json_.contains(key) && !json_.at(key).is_null(); }

  /// @param count  how many numbers are required
  std::optional<std::vector<double>> numbers(const char* key, std::size_t count,
                                             const char* rule) const {
    if (!has(key)) return std::nullopt;
    return numbers_of(key, json_.at(key), count, rule);
  }

  std::vector<std::vector<double>> lists(const char* key, std::size_t count,
                                         const char* rule) const {
    std::vector<std::vector<double>> lists;
    if (!has(key)) return lists;
    if (!json_.at(key).is_array()) {
      refuse(key, rule);
      return lists;
    }
    for (const Json& item : json_.at(key)) {
      if (auto list = numbers_of(key, item, count, rule)) lists.push_back(*std::move(list));
    }
    return lists;
  }

  std::optional<double> number(const char* key, const char* rule) const {
    if (!has(key)) return std::nullopt;
    if (json_.at(key).is_number() && std::isfinite(json_.at(key).get<double>())) {
      return json_.at(key).get<double>();
    }
    refuse(key, rule);
    return std::nullopt;
  }

  std::optional<std::string> text(const char* key, const char* rule) const {
    if (!has(key)) return std::nullopt;
    if (json_.at(key).is_string()) return json_.at(key).get<std::string>();
    refuse(key, rule);
    return std::nullopt;
  }

  bool yes(const char* key) const {
    if (!has(key)) return false;
    if (json_.at(key).is_boolean()) return json_.at(key).get<bool>();
    refuse(key, "true or false");
    return false;
  }

  void refuse(const char* key, const char* rule) const {
    faults_.add({.where = key, .value = "is " + json_.at(key).dump(), .rule = rule});
  }

 private:
  std::optional<std::vector<double>> numbers_of(const char* key, const Json& json,
                                                std::size_t count, const char* rule) const {
    constexpr double kFarthest_px = 1e6;
    std::vector<double> numbers;
    if (json.is_array() && json.size() == count) {
      for (const Json& number : json) {
        if (!number.is_number() || !(std::abs(number.get<double>()) < kFarthest_px)) break;
        numbers.push_back(number.get<double>());
      }
    }
    if (numbers.size() == count) return numbers;
    refuse(key, rule);
    return std::nullopt;
  }

  const Json& json_;
  base::Faults& faults_;
};

constexpr const char* kBoxRule = "four numbers: x, y, width, height in pixels";
constexpr const char* kLineRule = "four numbers: x1, y1, x2, y2 in pixels";
constexpr const char* kPlacesRule = "pairs of numbers: x, y in pixels";

vision::Box box_of(const std::vector<double>& numbers) {
  const auto whole = [&](std::size_t k) { return static_cast<int>(std::lround(numbers[k])); };
  return {.x = whole(0), .y = whole(1), .width = whole(2), .height = whole(3)};
}

vision::Segment line_of(const std::vector<double>& numbers) {
  return {{numbers[0], numbers[1]}, {numbers[2], numbers[3]}};
}

void read_hints(const Reader& reader, vision::MeasureOptions& measuring) {
  vision::Hints& hints = measuring.hints;
  const auto turn_deg = reader.number("rotate_deg", "0, 90, 180 or 270");
  hints.turn_deg = static_cast<int>(turn_deg.value_or(0));
  if (turn_deg && hints.turn_deg != 0 &&
      std::ranges::find(vision::kTurns_deg, hints.turn_deg) == vision::kTurns_deg.end()) {
    reader.refuse("rotate_deg", "0, 90, 180 or 270");
  }
  hints.heap.reset();
  if (const auto box = reader.numbers("heap", 4, kBoxRule)) hints.heap = box_of(*box);
  hints.ground.reset();
  if (const auto line = reader.numbers("ground", 4, kLineRule)) hints.ground = line_of(*line);
  hints.half.reset();
  if (const auto half = reader.text("half", "left or right")) {
    if (*half == "left") hints.half = vision::Side::left;
    if (*half == "right") hints.half = vision::Side::right;
    if (!hints.half) reader.refuse("half", "left or right");
  }
  hints.keep.clear();
  hints.drop.clear();
  for (const auto& [key, places] : {std::pair("keep", &hints.keep), {"drop", &hints.drop}}) {
    for (const auto& place : reader.lists(key, 2, kPlacesRule)) {
      places->push_back({place[0], place[1]});
    }
  }
  measuring.excluded.clear();
  for (const auto& box : reader.lists("exclude", 4, kBoxRule)) {
    measuring.excluded.push_back(box_of(box));
  }
}

void read_scale(const Reader& reader, const Json& told, base::Faults& faults,
                vision::ScaleOptions& scale) {
  scale.finds_board = reader.yes("board");
  scale.scale.reset();
  if (!reader.has("scale")) return;
  const Json& json = told.at("scale");
  const Reader of_scale(json, faults);
  const auto line = of_scale.numbers("line", 4, kLineRule);
  const auto length_mm = of_scale.number("length_mm", "a distance in mm above 0");
  if (!line || !length_mm) {
    if (!of_scale.has("line") || !of_scale.has("length_mm")) {
      reader.refuse("scale", "an object with line and length_mm");
    }
    return;
  }
  scale.scale = vision::ScaleBar{.line = line_of(*line), .length_mm = *length_mm};
  if (auto fault = vision::problem_of(*scale.scale)) faults.add(*std::move(fault));
  if (scale.finds_board) {
    faults.add({.where = "scale", .value = "there is a board, too", .rule = "one scale"});
  }
}

}  // namespace

Json told_json(const vision::PictureSettings& told) {
  const vision::MeasureOptions& measuring = told.measuring;
  const vision::Hints& hints = measuring.hints;
  Json json{{"rotate_deg", hints.turn_deg},
            {"heap", box_json(hints.heap)},
            {"half", hints.half ? Json(name_of(*hints.half)) : Json()},
            {"ground", line_json(hints.ground)},
            {"keep", places_json(hints.keep)},
            {"drop", places_json(hints.drop)},
            {"exclude", boxes_json(measuring.excluded)},
            {"scale", nullptr},
            {"board", told.scale.finds_board},
            {"pitch_deg", degrees(measuring.camera_pitch_rad)},
            {"window", {measuring.window_from, measuring.window_to}},
            {"definition", measuring.definition.empty() ? Json() : Json(measuring.definition)},
            {"has_mask", !hints.mask_file.empty()},
            {"painted", Json::array()}};
  if (const auto& bar = told.scale.scale) {
    json["scale"] = {{"line", line_json(bar->line)}, {"length_mm", bar->length_mm}};
  }
  return json;
}

vision::PictureSettings with_told(vision::PictureSettings settings, const Json& told) {
  base::Faults faults;
  if (!told.is_object()) {
    throw base::InputError({.value = "what was said of the picture is no object"});
  }
  const Json known = told_json({});
  for (const auto& [key, value] : told.items()) {
    faults.require(known.contains(key), {.where = key, .value = "is not known"});
  }
  const Reader reader(told, faults);
  vision::MeasureOptions& measuring = settings.measuring;
  read_hints(reader, measuring);
  read_scale(reader, told, faults, settings.scale);
  const auto pitch_deg = reader.number("pitch_deg", "a number in degrees");
  measuring.camera_pitch_rad = pitch_deg ? std::optional(*pitch_deg * kDegree) : std::nullopt;
  const vision::MeasureOptions usual;
  const auto window = reader.numbers("window", 2, "two fractions of the height");
  measuring.window_from = window ? window->front() : usual.window_from;
  measuring.window_to = window ? window->back() : usual.window_to;
  measuring.definition = reader.text("definition", "the name of a definition").value_or("");
  faults.add_all(measuring.problems());
  faults.throw_if_any();
  return settings;
}

namespace {

/// std::nullopt if it is not a stroke; errors in its path are collected.
std::optional<vision::BrushStroke> stroke_of(const Json& json, base::Faults& faults) {
  using Says = vision::BrushStroke::Says;
  static const std::map<std::string, Says> kSays{
      {"heap", Says::heap}, {"no_heap", Says::no_heap}, {"nothing", Says::nothing}};
  constexpr double kWidest_px = 1e4;
  if (!json.is_object()) return std::nullopt;
  const Reader reader(json, faults);
  const std::string says = reader.text("says", "heap, no_heap or nothing").value_or("");
  const double width_px = reader.number("width", "a number of pixels").value_or(0);
  if (!kSays.contains(says) || !(width_px > 0 && width_px < kWidest_px)) return std::nullopt;
  vision::BrushStroke stroke{.says = kSays.at(says), .width_px = width_px, .path = {}};
  for (const auto& place : reader.lists("path", 2, kPlacesRule)) {
    stroke.path.push_back({place[0], place[1]});
  }
  return stroke;
}

}  // namespace

std::vector<vision::BrushStroke> painted_in(const Json& told) {
  constexpr const char* kRule =
      "strokes with says (heap, no_heap or nothing), a width in pixels above 0 and a path";
  std::vector<vision::BrushStroke> strokes;
  base::Faults faults;
  const Reader reader(told, faults);
  if (!reader.has("painted")) return strokes;
  if (!told.at("painted").is_array()) reader.refuse("painted", kRule);
  for (const Json& json : told.at("painted").is_array() ? told.at("painted") : Json::array()) {
    auto stroke = stroke_of(json, faults);
    if (!stroke) {
      reader.refuse("painted", kRule);
      break;
    }
    strokes.push_back(*std::move(stroke));
  }
  faults.throw_if_any();
  return strokes;
}

Json marks_json(const calibrate::MeasuredAgain& again) {
  const vision::ReposeAngle& angle = again.measured.angle;
  const auto side = [](const vision::Flank& flank) -> Json {
    return {{"line", line_json(flank.line)},
            {"apron_line", flank.apron ? line_json(flank.apron->line_with) : Json()}};
  };
  return {{"width", again.picture.width},
          {"height", again.picture.height},
          {"outline", places_json(angle.outline)},
          {"ground", line_json(angle.ground)},
          {"left", side(angle.left)},
          {"right", side(angle.right)}};
}

}  // namespace repose::studio
