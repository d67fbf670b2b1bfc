#include "vision/hints/hint_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "base/error_list.h"
#include "base/toml_nesting.h"
#include "base/whole_file.h"

namespace repose::vision {
namespace {

namespace fs = std::filesystem;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kLargestPixel = 1e6;

/// Reads the values of one hint file; what is wrong with them is collected.
class HintReader {
 public:
  HintReader(const toml::table& table, const fs::path& file) : table_(table), file_(file) {}

  template <std::size_t kCount>
  std::optional<std::array<double, kCount>> numbers(const char* key, const char* meaning) {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return std::nullopt;
    return numbers_of<kCount>(*node, key, meaning);
  }

  /// A list of such groups.
  template <std::size_t kCount>
  std::vector<std::array<double, kCount>> groups(const char* key, const char* meaning) {
    std::vector<std::array<double, kCount>> all;
    const toml::node* node = table_.get(key);
    if (node == nullptr) return all;
    if (!node->is_array()) {
      add(*node, key, fmt::format("must be a list of {}", meaning));
      return all;
    }
    for (const toml::node& item : *node->as_array()) {
      if (const auto group = numbers_of<kCount>(item, key, meaning)) all.push_back(*group);
    }
    return all;
  }

  std::optional<double> number(const char* key) {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return std::nullopt;
    const auto value = node->value<double>();
    if (!value || !std::isfinite(*value)) add(*node, key, "must be a number");
    return value;
  }

  std::string text(const char* key) {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return {};
    const auto value = node->value<std::string>();
    if (!value) add(*node, key, "must be a file's name in quotes");
    return value.value_or("");
  }

  void refuse_other_keys(std::initializer_list<std::string_view> known) {
    for (const auto& [key, node] : table_) {
      if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
      add(node, std::string(key.str()),
          fmt::format("is not a hint. Known hints: {}", fmt::join(known, ", ")));
    }
  }

  void throw_if_any() const { errors_.throw_if_any(); }

 private:
  void add(const toml::node& node, const std::string& key, const std::string& rule) {
    errors_.add(fmt::format("{}:{}: {}: {}. Fix: correct it, or delete the line.", file_.string(),
                            node.source().begin.line, key, rule));
  }

  template <std::size_t kCount>
  std::optional<std::array<double, kCount>> numbers_of(const toml::node& node, const char* key,
                                                       const char* meaning) {
    std::array<double, kCount> values{};
    const toml::array* list = node.as_array();
    bool is_good = list != nullptr && list->size() == kCount;
    for (std::size_t i = 0; is_good && i < kCount; ++i) {
      const auto value = list->get(i)->value<double>();
      is_good = value && std::abs(*value) <= kLargestPixel;  // NaN fails
      values[i] = value.value_or(0);
    }
    if (is_good) return values;
    add(node, key, fmt::format("must be {}", meaning));
    return std::nullopt;
  }

  const toml::table& table_;
  const fs::path& file_;
  base::ErrorList errors_;
};

constexpr const char* kBox = "[x, y, width, height] in pixels";
constexpr const char* kLine = "[x1, y1, x2, y2] in pixels";
constexpr const char* kPlace = "[x, y] in pixels";

Box box_of(const std::array<double, 4>& numbers) {
  const auto pixel = [&](std::size_t i) { return static_cast<int>(std::lround(numbers[i])); };
  return {.x = pixel(0), .y = pixel(1), .width = pixel(2), .height = pixel(3)};
}

toml::table parsed(const std::string& text, const fs::path& file) {
  if (const auto line = base::line_of_deep_key(text)) {
    throw std::invalid_argument(
        fmt::format("{}:{}: a key has more than {} points. Fix: correct this line, or delete the "
                    "file.",
                    file.string(), *line, base::kMostPointsInAKey));
  }
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw std::invalid_argument(fmt::format(
        "{}:{}: {}. Rule: the text must be TOML (https://toml.io). Fix: correct this line, or "
        "delete the file.",
        file.string(), error.source().begin.line, error.description()));
  }
}

/// Adds what is not there yet: saved again, a list stays the same.
template <class Item, class IsSame>
void add_new(std::vector<Item>& items, const Item& item, IsSame is_same) {
  const auto same = [&](const Item& other) { return is_same(item, other); };
  if (std::none_of(items.begin(), items.end(), same)) items.push_back(item);
}

void add_places(HintReader& reader, const char* key, std::vector<Point>& places) {
  for (const auto& [x, y] : reader.groups<2>(key, kPlace)) {
    add_new(places, Point{x, y},
            [](const Point& a, const Point& b) { return a.x == b.x && a.y == b.y; });
  }
}

void add_boxes(HintReader& reader, std::vector<Box>& boxes) {
  for (const auto& box : reader.groups<4>("exclude", kBox)) {
    add_new(boxes, box_of(box), [](const Box& a, const Box& b) {
      return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
    });
  }
}

std::string pixel(double value) { return fmt::format("{:.6g}", value); }

std::string text_of(const Box& box) {
  return fmt::format("[{}, {}, {}, {}]", box.x, box.y, box.width, box.height);
}

std::string text_of(const Point& point) {
  return fmt::format("[{}, {}]", pixel(point.x), pixel(point.y));
}

template <class Item>
std::string list_of(const std::vector<Item>& items) {
  std::vector<std::string> texts;
  for (const Item& item : items) texts.push_back(text_of(item));
  return fmt::format("[{}]", fmt::join(texts, ", "));
}

}  // namespace

fs::path hint_file_of(const fs::path& picture) {
  fs::path file = picture;
  file += ".repose.toml";
  return file;
}

MeasureOptions with_saved_hints(MeasureOptions options, const fs::path& picture) {
  const fs::path file = hint_file_of(picture);
  constexpr std::uintmax_t kLargest_bytes = 1 << 20;
  const std::optional<std::string> text = base::read_file_if_there(file, kLargest_bytes);
  if (!text) return options;
  const toml::table table = parsed(*text, file);
  HintReader reader(table, file);
  reader.refuse_other_keys({"heap", "ground", "keep", "drop", "mask", "exclude", "pitch_deg"});
  Hints& hints = options.hints;
  hints.source = file.filename().string();
  const auto heap = reader.numbers<4>("heap", kBox);
  if (heap && !hints.heap) hints.heap = box_of(*heap);
  const auto ground = reader.numbers<4>("ground", kLine);
  if (ground && !hints.ground) {
    const auto& [x1, y1, x2, y2] = *ground;
    hints.ground = Segment{{x1, y1}, {x2, y2}};
  }
  add_places(reader, "keep", hints.keep);
  add_places(reader, "drop", hints.drop);
  add_boxes(reader, options.excluded);
  const std::optional<double> pitch_deg = reader.number("pitch_deg");
  if (pitch_deg && !options.camera_pitch_rad) options.camera_pitch_rad = *pitch_deg * kDegree;
  const std::string mask = reader.text("mask");
  reader.throw_if_any();
  if (!mask.empty() && hints.mask.empty()) {
    hints.mask_file = picture.parent_path() / mask;
    hints.mask = read_picture(hints.mask_file);
  }
  return options;
}

void save_hints(const MeasureOptions& options, const fs::path& picture) {
  const Hints& hints = options.hints;
  std::string text = fmt::format("# Hints for {}, in its pixels: read whenever it is measured.\n",
                                 picture.filename().string());
  const auto add = [&](const char* key, const std::string& value) {
    text += fmt::format("{} = {}\n", key, value);
  };
  if (hints.heap) add("heap", text_of(*hints.heap));
  if (hints.ground) {
    const auto& [from, to] = *hints.ground;
    add("ground",
        fmt::format("[{}, {}, {}, {}]", pixel(from.x), pixel(from.y), pixel(to.x), pixel(to.y)));
  }
  if (!hints.keep.empty()) add("keep", list_of(hints.keep));
  if (!hints.drop.empty()) add("drop", list_of(hints.drop));
  if (!hints.mask_file.empty()) {
    const fs::path beside = fs::absolute(picture).parent_path();
    const fs::path near = fs::proximate(fs::absolute(hints.mask_file), beside);
    add("mask", (std::ostringstream() << toml::value<std::string>(near.generic_string())).str());
  }
  if (!options.excluded.empty()) add("exclude", list_of(options.excluded));
  if (options.camera_pitch_rad) {
    add("pitch_deg", fmt::format("{:.6g}", *options.camera_pitch_rad / kDegree));
  }
  base::write_whole_file(hint_file_of(picture), text);
}

}  // namespace repose::vision
