#include "vision/hints/hint_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "base/toml_nesting.h"
#include "base/units.h"
#include "vision/camera/lens_file.h"

namespace repose::vision {

namespace {

/// Reads the values of one hint file and collects their errors.
class HintReader {
 public:
  HintReader(const toml::table& table, const std::filesystem::path& file)
      : table_(table), file_(file) {}

  template <std::size_t kCount>
  std::optional<std::array<double, kCount>> numbers(const char* key, const char* meaning) {
    const toml::node* node = table_.get(key);
    if (node == nullptr) return std::nullopt;
    return numbers_of<kCount>(*node, key, meaning);
  }

  /// A list of such arrays.
  template <std::size_t kCount>
  std::vector<std::array<double, kCount>> groups(const char* key, const char* meaning) {
    std::vector<std::array<double, kCount>> all;
    const toml::node* node = table_.get(key);
    if (node == nullptr) return all;
    if (!node->is_array()) {
      add(*node, key, "", fmt::format("must be a list of {}", meaning));
      return all;
    }
    for (const toml::node& item : *node->as_array()) {
      if (const auto group = numbers_of<kCount>(item, key, meaning)) all.push_back(*group);
    }
    return all;
  }

  std::optional<double> number(const char* key);
  /// A number above 0.
  std::optional<double> positive(const char* key);
  std::optional<bool> truth(const char* key);
  std::optional<Side> side(const char* key);
  int turn_deg(const char* key);
  std::string file_name(const char* key);

  void refuse_other_keys(std::initializer_list<std::string_view> known);
  /// Refuses the value of an existing key, because of its range or other keys.
  void refuse(const char* key, const std::string& value, const std::string& rule);
  void throw_if_any() const { errors_.throw_if_any(); }

 private:
  static constexpr double kLargestPixel = 1e6;

  void add(const toml::node& node, const std::string& key, const std::string& value,
           const std::string& rule);

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
    add(node, key, "", fmt::format("must be {}", meaning));
    return std::nullopt;
  }

  const toml::table& table_;
  const std::filesystem::path& file_;
  base::Faults errors_;
};

namespace fs = std::filesystem;

std::optional<double> HintReader::number(const char* key) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return std::nullopt;
  const auto value = node->value<double>();
  if (!value || !std::isfinite(*value)) add(*node, key, "", "must be a number");
  return value;
}

std::optional<double> HintReader::positive(const char* key) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return std::nullopt;
  const auto value = node->value<double>();
  if (value && *value > 0 && *value <= kLargestPixel) return value;  // NaN fails
  add(*node, key, "", "must be a number above 0");
  return std::nullopt;
}

std::optional<bool> HintReader::truth(const char* key) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return std::nullopt;
  const auto value = node->value<bool>();
  if (!value) add(*node, key, "", "must be true or false");
  return value;
}

std::optional<Side> HintReader::side(const char* key) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return std::nullopt;
  for (const Side side : {Side::left, Side::right}) {
    if (node->value<std::string>() == name_of(side)) return side;
  }
  add(*node, key, "", "must be \"left\" or \"right\"");
  return std::nullopt;
}

int HintReader::turn_deg(const char* key) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return 0;
  for (const int turn : kTurns_deg) {
    if (node->value<double>() == turn) return turn;
  }
  add(*node, key, "",
      fmt::format("must be one of {}: degrees clockwise", fmt::join(kTurns_deg, ", ")));
  return 0;
}

std::string HintReader::file_name(const char* key) {
  const toml::node* node = table_.get(key);
  if (node == nullptr) return {};
  const auto value = node->value<std::string>();
  if (!value) add(*node, key, "", "must be a file's name in quotes");
  return value.value_or("");
}

void HintReader::refuse_other_keys(std::initializer_list<std::string_view> known) {
  for (const auto& [key, node] : table_) {
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    add(node, std::string(key.str()),
        fmt::format("is not a hint. Known hints: {}", fmt::join(known, ", ")), "");
  }
}

void HintReader::refuse(const char* key, const std::string& value, const std::string& rule) {
  if (const toml::node* node = table_.get(key)) add(*node, key, value, rule);
}

void HintReader::add(const toml::node& node, const std::string& key, const std::string& value,
                     const std::string& rule) {
  errors_.add({.where = fmt::format("{}:{}: {}", file_.string(), node.source().begin.line, key),
               .value = value,
               .rule = rule,
               .fix = "correct it, or delete the line."});
}

/// The text of a hint file.
/// @throws base::InputError  it is not TOML.
toml::table parse_hints(const std::string& text, const fs::path& file) {
  if (const auto line = base::line_of_deep_key(text)) {
    throw base::InputError(
        {.where = fmt::format("{}:{}", file.string(), *line),
         .value = fmt::format("a key has more than {} points", base::kMaxPointsInAKey),
         .fix = "correct this line, or delete the file."});
  }
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    throw base::InputError({.where = fmt::format("{}:{}", file.string(), error.source().begin.line),
                            .value = fmt::format("{}", error.description()),
                            .rule = "the text must be TOML (https://toml.io)",
                            .fix = "correct this line, or delete the file."});
  }
}

namespace fs = std::filesystem;

constexpr const char* kBox = "[x, y, width, height] in pixels";
constexpr const char* kLine = "[x1, y1, x2, y2] in pixels";
constexpr const char* kPlaceRule = "[x, y] in pixels";
constexpr const char* kScale =
    "[x1, y1, x2, y2, mm]: two points in pixels, at least 10 apart, and their distance in mm";

Box box_of(const std::array<double, 4>& numbers) {
  const auto pixel = [&](std::size_t i) { return static_cast<int>(std::lround(numbers[i])); };
  return {.x = pixel(0), .y = pixel(1), .width = pixel(2), .height = pixel(3)};
}

/// Adds the item unless it is already there, so that saving again does not change a list.
template <class Item, class IsSame>
void add_new(std::vector<Item>& items, const Item& item, IsSame is_same) {
  const auto same = [&](const Item& other) { return is_same(item, other); };
  if (std::none_of(items.begin(), items.end(), same)) items.push_back(item);
}

void add_places(HintReader& reader, const char* key, std::vector<Point>& places) {
  for (const auto& [x, y] : reader.groups<2>(key, kPlaceRule)) {
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

std::optional<ScaleBar> scale_of(HintReader& reader) {
  const auto numbers = reader.numbers<5>("scale", kScale);
  if (!numbers) return std::nullopt;
  const auto& [x1, y1, x2, y2, length_mm] = *numbers;
  const ScaleBar bar{.line = {{x1, y1}, {x2, y2}}, .length_mm = length_mm};
  if (!(length_mm > 0) || std::hypot(x2 - x1, y2 - y1) < kShortestBar_px) {
    reader.refuse("scale", "", fmt::format("must be {}", kScale));
  } else if (const auto fault = problem_of(bar)) {
    reader.refuse("scale", fault->value, fault->rule);
  } else {
    return bar;
  }
  return std::nullopt;
}

/// The file's scale settings; of the lens, only the file name.
ScaleOptions read_scale(HintReader& reader) {
  ScaleOptions scale;
  scale.lens_file = reader.file_name("camera_file");
  scale.finds_board = reader.truth("board").value_or(false);
  scale.square_mm = reader.positive("square_mm").value_or(scale.square_mm);
  if (scale.square_mm < kSmallestSquare_mm || scale.square_mm > kLargestSquare_mm) {
    reader.refuse("square_mm", "",
                  fmt::format("must be from {:g} to {:g}, of a printed board", kSmallestSquare_mm,
                              kLargestSquare_mm));
  }
  scale.board_offset_mm = reader.positive("board_behind_mm").value_or(0);
  scale.scale = scale_of(reader);
  if (scale.finds_board) {
    reader.refuse("scale", "stands beside board = true", "one scale");
  } else {
    reader.refuse("square_mm", "is of a board", "it needs board = true");
    reader.refuse("board_behind_mm", "is of a board", "it needs board = true");
  }
  if (scale.lens_file.empty() && scale.board_offset_mm > 0) {
    reader.refuse("board_behind_mm", "needs the focal length", "it needs camera_file");
  }
  return scale;
}

/// Fills in what was not given: the lens, and one scale.
void add_scale(const ScaleOptions& saved, const fs::path& folder, ScaleOptions& given) {
  if (!given.lens && !saved.lens_file.empty()) {
    given.lens_file = folder / saved.lens_file;
    given.lens = read_lens_file(given.lens_file);
  }
  if (given.finds_board || given.scale) return;
  given.finds_board = saved.finds_board;
  given.square_mm = saved.square_mm;
  given.board_offset_mm = saved.board_offset_mm;
  given.scale = saved.scale;
}

/// Two points and their distance determine sizes but do not affect angles.
bool changes_angles(const toml::table& table) {
  return std::any_of(table.begin(), table.end(),
                     [](const auto& entry) { return entry.first != "scale"; });
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

/// A file's name relative to the picture's folder.
std::string near_text(const fs::path& file, const fs::path& picture) {
  const fs::path beside = fs::absolute(picture).parent_path();
  const fs::path near = fs::proximate(fs::absolute(file), beside);
  return (std::ostringstream() << toml::value<std::string>(near.generic_string())).str();
}

std::string scale_text(const ScaleOptions& scale, const fs::path& picture) {
  std::string text;
  if (!scale.lens_file.empty()) {
    text += fmt::format("camera_file = {}\n", near_text(scale.lens_file, picture));
  }
  if (scale.scale) {
    const auto& [from, to] = scale.scale->line;
    text += fmt::format("scale = [{}, {}, {}, {}, {:.6g}]\n", pixel(from.x), pixel(from.y),
                        pixel(to.x), pixel(to.y), scale.scale->length_mm);
  }
  if (!scale.finds_board) return text;
  text += "board = true\n";
  if (scale.square_mm != kBoardSquare_mm) {
    text += fmt::format("square_mm = {:.6g}\n", scale.square_mm);
  }
  if (scale.board_offset_mm > 0)
    text += fmt::format("board_behind_mm = {:.6g}\n", scale.board_offset_mm);
  return text;
}

}  // namespace

fs::path hint_file_of(const fs::path& picture) {
  fs::path file = picture;
  file += ".repose.toml";
  return file;
}

namespace {

/// The settings completed from the file beside the picture.
PictureSettings with_file(PictureSettings given, const fs::path& picture) {
  const fs::path file = hint_file_of(picture);
  constexpr std::uintmax_t kLargest_bytes = 1 << 20;
  const std::optional<std::string> text = base::read_file_if_there(file, kLargest_bytes);
  if (!text) return given;
  const toml::table table = parse_hints(*text, file);
  HintReader reader(table, file);
  reader.refuse_other_keys({"rotate", "heap", "half", "ground", "keep", "drop", "mask", "exclude",
                            "pitch_deg", "scale", "board", "square_mm", "board_behind_mm",
                            "camera_file"});
  MeasureOptions& options = given.measuring;
  Hints& hints = options.hints;
  if (changes_angles(table)) hints.source = file.filename().string();
  const int turn_deg = reader.turn_deg("rotate");
  if (hints.turn_deg == 0) hints.turn_deg = turn_deg;
  const auto heap = reader.numbers<4>("heap", kBox);
  if (heap && !hints.heap) hints.heap = box_of(*heap);
  const std::optional<Side> half = reader.side("half");
  if (half && !hints.half) hints.half = half;
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
  const std::string mask = reader.file_name("mask");
  const ScaleOptions scale = read_scale(reader);
  reader.throw_if_any();
  if (!mask.empty() && hints.mask.empty()) {
    hints.mask_file = picture.parent_path() / mask;
    hints.mask = read_picture(hints.mask_file);
  }
  add_scale(scale, picture.parent_path(), given.scale);
  return given;
}

}  // namespace

PictureSettings with_saved_hints(PictureSettings given, const fs::path& picture) {
  PictureSettings told = with_file(std::move(given), picture);
  Hints& hints = told.measuring.hints;
  hints.mask = turned(hints.mask, hints.turn_deg);
  return told;
}

void save_hints(const PictureSettings& settings, const fs::path& picture) {
  const MeasureOptions& options = settings.measuring;
  const Hints& hints = options.hints;
  std::string text = fmt::format("# Hints for {}, in its pixels: read whenever it is measured.\n",
                                 picture.filename().string());
  const auto add = [&](const char* key, const std::string& value) {
    text += fmt::format("{} = {}\n", key, value);
  };
  if (hints.turn_deg != 0) add("rotate", fmt::format("{}", hints.turn_deg));
  if (hints.heap) add("heap", text_of(*hints.heap));
  if (hints.half) add("half", fmt::format("\"{}\"", name_of(*hints.half)));
  if (hints.ground) {
    const auto& [from, to] = *hints.ground;
    add("ground",
        fmt::format("[{}, {}, {}, {}]", pixel(from.x), pixel(from.y), pixel(to.x), pixel(to.y)));
  }
  if (!hints.keep.empty()) add("keep", list_of(hints.keep));
  if (!hints.drop.empty()) add("drop", list_of(hints.drop));
  if (!hints.mask_file.empty()) add("mask", near_text(hints.mask_file, picture));
  if (!options.excluded.empty()) add("exclude", list_of(options.excluded));
  if (options.camera_pitch_rad) {
    add("pitch_deg", fmt::format("{:.6g}", *options.camera_pitch_rad / kDegree));
  }
  text += scale_text(settings.scale, picture);
  base::write_whole_file(hint_file_of(picture), text);
}

}  // namespace repose::vision
