#include "cli/measure/measure_table.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "cli/common/degrees.h"
#include "cli/common/terminal.h"
#include "vision/measure/status_name.h"

namespace repose::cli {
namespace {

constexpr std::size_t kAngleWidth = 12;  // "23.38 ± 0.52"
constexpr std::size_t kTiltWidth = 5;
constexpr std::size_t kConfidenceWidth = 5;
constexpr std::size_t kStatusWidth = 8;
constexpr std::size_t kGapWidth = 2;
constexpr std::size_t kRestWidth =
    3 * kAngleWidth + kTiltWidth + kConfidenceWidth + kStatusWidth + 6 * kGapWidth;
constexpr std::size_t kNarrowestName = 8;
constexpr const char* kNothing = "–";

std::string angle_cell(const std::optional<double>& angle_rad,
                       const std::optional<double>& uncertainty_rad) {
  if (!angle_rad) return kNothing;
  std::string angle = fmt::format("{:5.2f}", to_degrees(*angle_rad));
  if (!uncertainty_rad) return angle;
  return fmt::format("{} ± {:.2f}", angle, to_degrees(*uncertainty_rad));
}

std::string flank_cell(const vision::Flank& flank, vision::MeasureStatus status) {
  if (flank.angle_rad) return angle_cell(flank.angle_rad, flank.uncertainty_rad);
  return status == vision::MeasureStatus::refused ? kNothing : name_of(flank.status);
}

std::string status_cell(const MeasuredPicture& picture, bool has_colour) {
  const bool is_measured = picture.outcome == Outcome::measured;
  const auto status = picture.angle.status;
  std::string name = is_measured ? name_of(status) : "not read";
  if (!has_colour) return name;
  constexpr const char *kGreen = "\033[32m", *kYellow = "\033[33m", *kRed = "\033[31m";
  const char* colour = is_measured && status == vision::MeasureStatus::ok        ? kGreen
                       : is_measured && status == vision::MeasureStatus::flagged ? kYellow
                                                                                 : kRed;
  return fmt::format("{}{}\033[0m", colour, name);
}

class Table {
 public:
  Table(const TableStyle& style, std::size_t name_width) : style_(style), name_width_(name_width) {}

  /// A name that is wider than its column has a line of its own.
  void add_row(std::string_view name, std::string_view angle, std::string_view left,
               std::string_view right, std::string_view tilt, std::string_view confidence,
               std::string_view status) {
    const bool fits = letters(name) <= name_width_;
    if (!fits) text_ += fmt::format("{}\n", name);
    text_ += fmt::format("{}  {}  {}  {}  {}  {}  {}\n", padded(fits ? name : "", name_width_),
                         padded(angle, kAngleWidth), padded(left, kAngleWidth),
                         padded(right, kAngleWidth), right_aligned(tilt, kTiltWidth),
                         right_aligned(confidence, kConfidenceWidth), status);
  }

  /// Text below a row, wrapped, its first line behind `mark`.
  void add_remark(std::string_view mark, std::string_view remark) {
    const std::string indent(2 + letters(mark), ' ');
    const auto width = static_cast<std::size_t>(std::max(20, style_.columns)) - indent.size();
    std::string before = fmt::format("  {}", mark);
    for (const std::string& line : wrapped(remark, width)) {
      text_ += before + line + '\n';
      before = indent;
    }
  }

  const std::string& text() const { return text_; }

 private:
  const TableStyle& style_;
  std::size_t name_width_;
  std::string text_;
};

void add_definitions(Table& table, const vision::ReposeAngle& angle) {
  for (const vision::NamedAngle& definition : angle.definitions) {
    table.add_remark(fmt::format("{:5.2f}°  ", to_degrees(definition.angle_rad)),
                     fmt::format("{}: {}", definition.name, definition.description));
  }
  for (const auto& [side, flank] : {std::pair("left", &angle.left), {"right", &angle.right}}) {
    for (const vision::WindowAngle& other : flank->other_windows) {
      table.add_remark(fmt::format("{:5.2f}°  ", to_degrees(other.angle_rad)),
                       fmt::format("{} side, window {:.0f}–{:.0f} % of the height", side,
                                   100 * other.window_from, 100 * other.window_to));
    }
  }
}

void add_picture(Table& table, const MeasuredPicture& picture, const TableStyle& style) {
  const vision::ReposeAngle& angle = picture.angle;
  const std::string status = status_cell(picture, style.has_colour);
  if (picture.outcome != Outcome::measured) {
    table.add_row(picture.file, kNothing, kNothing, kNothing, kNothing, kNothing, status);
    return;
  }
  table.add_row(
      picture.file, angle_cell(angle.angle_rad, angle.uncertainty_rad),
      flank_cell(angle.left, angle.status), flank_cell(angle.right, angle.status),
      angle.ground_tilt_rad ? fmt::format("{:.2f}", to_degrees(*angle.ground_tilt_rad)) : kNothing,
      fmt::format("{:.2f}", angle.confidence), status);
  if (angle.status == vision::MeasureStatus::refused) {
    table.add_remark("refused: ", angle.reason);
  }
  for (const vision::Warning& warning : angle.warnings) table.add_remark("! ", warning.message);
  if (style.shows_definitions) add_definitions(table, angle);
}

/// As wide as the longest name that leaves room for the numbers.
std::size_t name_width(const std::vector<MeasuredPicture>& pictures, int columns) {
  const auto available = static_cast<std::size_t>(std::max(0, columns));
  std::size_t width = kNarrowestName;
  for (const MeasuredPicture& picture : pictures) {
    const std::size_t count = letters(picture.file);
    if (count + kRestWidth <= available) width = std::max(width, count);
  }
  return width;
}

}  // namespace

std::string measure_table(const std::vector<MeasuredPicture>& pictures, const TableStyle& style) {
  Table table(style, name_width(pictures, style.columns));
  table.add_row("picture", "angle [°]", "left [°]", "right [°]", "tilt", "conf.", "status");
  for (const MeasuredPicture& picture : pictures) add_picture(table, picture, style);
  return table.text();
}

}  // namespace repose::cli
