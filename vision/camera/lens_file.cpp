#include "vision/camera/lens_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "base/toml_nesting.h"

namespace repose::vision {
namespace {

namespace fs = std::filesystem;

struct NamedNumber {
  const char* name = "";
  LensNumber Lens::*number = nullptr;
  const char* unit = "";
  bool is_needed = false;
};

constexpr std::array<NamedNumber, 8> kNamedNumbers = {
    NamedNumber{"focal", &Lens::focal_px, "_px", true},
    NamedNumber{"centre_x", &Lens::centre_x_px, "_px", true},
    NamedNumber{"centre_y", &Lens::centre_y_px, "_px", true},
    NamedNumber{"k1", &Lens::k1},
    NamedNumber{"k2", &Lens::k2},
    NamedNumber{"p1", &Lens::p1},
    NamedNumber{"p2", &Lens::p2},
    NamedNumber{"k3", &Lens::k3},
};

std::string key_of(const NamedNumber& number) { return std::string(number.name) + number.unit; }
std::string uncertainty_key_of(const NamedNumber& number) {
  return std::string(number.name) + "_uncertainty" + number.unit;
}

constexpr double kLargest = 1e6;

/// Reads the numbers of one camera file and collects their errors.
class LensReader {
 public:
  LensReader(const toml::table& table, const fs::path& file) : table_(table), file_(file) {}

  double number(const std::string& key, bool is_needed) {
    known_.push_back(key);
    const toml::node* node = table_.get(key);
    if (node == nullptr) {
      if (is_needed) add(1, key, "is missing", "a number");
      return 0;
    }
    const auto value = node->value<double>();
    if (value && std::abs(*value) <= kLargest) return *value;  // NaN fails
    add(line_of(*node), key, "", "must be a number");
    refused_.push_back(key);
    return 0;
  }

  /// Checks a number that was read; each key is reported once.
  void require(bool holds, const std::string& key, const char* value, const char* rule) {
    const toml::node* node = table_.get(key);
    if (holds || node == nullptr) return;
    if (std::find(refused_.begin(), refused_.end(), key) != refused_.end()) return;
    add(line_of(*node), key, value, rule);
  }

  void refuse_other_keys() {
    for (const auto& [key, node] : table_) {
      if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
      add(line_of(node), std::string(key.str()), "is not a key of a camera file",
          fmt::format("its keys are {}", fmt::join(known_, ", ")));
    }
  }

  void throw_if_any() const { errors_.throw_if_any(); }

 private:
  static unsigned line_of(const toml::node& node) { return node.source().begin.line; }
  void add(unsigned line, const std::string& key, const std::string& value,
           const std::string& rule) {
    errors_.add({.where = fmt::format("{}:{}", file_.string(), line),
                 .subject = key,
                 .value = value,
                 .rule = rule,
                 .fix = "correct it, or run repose camera again."});
  }

  const toml::table& table_;
  const fs::path& file_;
  std::vector<std::string> known_;
  std::vector<std::string> refused_;
  base::Faults errors_;
};

/// The largest term of the radial distortion at a given distance from the axis.
const char* largest_term(const Lens& lens, double r) {
  const double r2 = r * r;
  const std::array<std::pair<const char*, double>, 3> terms = {
      {{"k1", std::abs(lens.k1.value) * r2},
       {"k2", std::abs(lens.k2.value) * r2 * r2},
       {"k3", std::abs(lens.k3.value) * r2 * r2 * r2}}};
  return std::max_element(terms.begin(), terms.end(),
                          [](const auto& a, const auto& b) { return a.second < b.second; })
      ->first;
}

/// Numbers of another camera, or mistyped ones, are possible and affect every size and angle.
void check_plausible(const Lens& lens, LensReader& reader) {
  // Straight lines stay straight up to about 140 degrees; telescopes see a third of a degree.
  constexpr double kWidest = .18, kNarrowest = 170;
  const double width = std::max(lens.width, lens.height);
  const double focal = lens.focal_px.value;
  reader.require(focal >= kWidest * width && focal <= kNarrowest * width, "focal_px", "",
                 "must be from 0.18 to 170 times the longer side of the picture: lenses show 140 "
                 "to 0.3 degrees");
  reader.require(lens.centre_x_px.value >= 0 && lens.centre_x_px.value <= lens.width, "centre_x_px",
                 "", "must lie in the picture");
  reader.require(lens.centre_y_px.value >= 0 && lens.centre_y_px.value <= lens.height,
                 "centre_y_px", "", "must lie in the picture");
  // Effect of the distortion on the picture's farthest corner; and nothing may be seen twice.
  const double x = std::max(lens.centre_x_px.value, lens.width - lens.centre_x_px.value) / focal;
  const double y = std::max(lens.centre_y_px.value, lens.height - lens.centre_y_px.value) / focal;
  const double corner = std::hypot(x, y);
  constexpr double kMaxMoved = .6;  // a fisheye lens not declared as one has half of it
  constexpr int kSteps = 100;
  double before = 0;
  for (int step = 1; step <= kSteps; ++step) {
    const double r = corner * step / kSteps, r2 = r * r;
    const double factor = 1 + r2 * (lens.k1.value + r2 * (lens.k2.value + r2 * lens.k3.value));
    const bool is_possible = std::abs(factor - 1) <= kMaxMoved && factor * r > before;
    before = factor * r;
    if (is_possible) continue;
    reader.require(false, largest_term(lens, r),
                   "moves the edge of the picture by more than 60 %, or folds it", "no lens does");
    break;
  }
  constexpr double kMaxTilted = .1;
  reader.require(std::abs(lens.p1.value) * corner <= kMaxTilted, "p1",
                 "moves the corner of the picture by more than 10 %", "no lens does");
  reader.require(std::abs(lens.p2.value) * corner <= kMaxTilted, "p2",
                 "moves the corner of the picture by more than 10 %", "no lens does");
}

toml::table parsed(const std::string& text, const fs::path& file) {
  std::string what;
  unsigned line = 1;
  if (const auto deep = base::line_of_deep_key(text)) {
    line = static_cast<unsigned>(*deep);
    what = "a key has too many points";
  } else {
    try {
      return toml::parse(text);
    } catch (const toml::parse_error& error) {
      line = error.source().begin.line;
      what = error.description();
    }
  }
  throw base::InputError({.where = fmt::format("{}:{}", file.string(), line),
                          .value = what,
                          .rule = "a camera file is TOML (https://toml.io)",
                          .fix = "correct this line, or run repose camera again."});
}

}  // namespace

std::string lens_file_text(const Lens& lens, const std::string& origin) {
  std::string text = fmt::format(
      "# The lens of a camera, by repose camera: {}.\n"
      "# It holds for this zoom and focus, and for whole pictures of any size:\n"
      "#   repose measure PICTURE --camera-file THIS_FILE\n"
      "# uncertainty: half-width of the 95 % interval.\n\n"
      "width_px = {}\nheight_px = {}\n\n"
      "# Focal length, and the place of the lens's axis, from the top left corner.\n",
      origin, lens.width, lens.height);
  for (const NamedNumber& number : kNamedNumbers) {
    const auto& [value, uncertainty] = lens.*number.number;
    if (!number.is_needed && value == 0 && uncertainty == 0) continue;
    if (number.number == &Lens::k1) {
      text +=
          "\n# Distortion (Brown-Conrady, as in OpenCV); coefficients that are not named are 0.\n";
    }
    const char* digits =
        number.is_needed ? "{} = {:.3f}\n{} = {:.3f}\n" : "{} = {:.6g}\n{} = {:.2g}\n";
    text += fmt::format(fmt::runtime(digits), key_of(number), value, uncertainty_key_of(number),
                        uncertainty);
  }
  return text;
}

Lens read_lens_file(const fs::path& file) {
  constexpr std::uintmax_t kLargest_bytes = 1 << 20;
  const std::string text = base::read_whole_file(file, kLargest_bytes);
  const toml::table table = parsed(text, file);
  LensReader reader(table, file);
  Lens lens;
  const double width = reader.number("width_px", true);
  const double height = reader.number("height_px", true);
  for (const NamedNumber& number : kNamedNumbers) {
    LensNumber& read = lens.*number.number;
    read.value = reader.number(key_of(number), number.is_needed);
    read.uncertainty = reader.number(uncertainty_key_of(number), false);
    reader.require(read.uncertainty >= 0, uncertainty_key_of(number), "", "must not be below 0");
  }
  const auto is_side = [](double side) { return side >= 1 && side == std::floor(side); };
  reader.require(is_side(width), "width_px", "", "must be a whole number above 0");
  reader.require(is_side(height), "height_px", "", "must be a whole number above 0");
  reader.require(lens.focal_px.value > 0, "focal_px", "", "must be above 0");
  reader.refuse_other_keys();
  if (is_side(width) && is_side(height) && lens.focal_px.value > 0) {
    lens.width = static_cast<int>(width);
    lens.height = static_cast<int>(height);
    check_plausible(lens, reader);
  }
  reader.throw_if_any();
  return lens;
}

}  // namespace repose::vision
