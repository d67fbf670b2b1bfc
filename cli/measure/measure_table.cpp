#include "cli/measure/measure_table.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "cli/common/degrees.h"
#include "cli/common/table.h"
#include "cli/common/verdict_colour.h"
#include "cli/measure/proposal_text.h"
#include "vision/measure/status_name.h"

namespace repose::cli {
namespace {

std::string degrees_cell(const std::optional<double>& angle_rad,
                         const std::optional<double>& uncertainty_rad) {
  if (!angle_rad) return kNothing;
  std::string angle = fmt::format("{:5.2f}", to_degrees(*angle_rad));
  if (!uncertainty_rad) return angle;
  return fmt::format("{} ± {:.2f}", angle, to_degrees(*uncertainty_rad));
}

std::string flank_cell(const vision::Flank& flank, vision::MeasureStatus status) {
  if (flank.angle_rad) return degrees_cell(flank.angle_rad, flank.uncertainty_rad);
  return status == vision::MeasureStatus::refused ? kNothing : name_of(flank.status);
}

Colour row_colour(const MeasuredPicture& picture, bool has_colour) {
  if (!has_colour) return Colour::none;
  if (picture.outcome != Outcome::measured) return Colour::red;
  return colour_of(picture.angle.status);
}

void add_definitions(Table& table, const vision::ReposeAngle& angle) {
  for (const vision::NamedAngle& definition : angle.definitions) {
    table.add_note(fmt::format("{}{:5.2f}°  ", kBelow, to_degrees(definition.angle_rad)),
                   fmt::format("{}: {}", definition.name, definition.description));
  }
  for (const auto& [side, flank] : {std::pair("left", &angle.left), {"right", &angle.right}}) {
    for (const vision::WindowAngle& other : flank->other_windows) {
      table.add_note(fmt::format("{}{:5.2f}°  ", kBelow, to_degrees(other.angle_rad)),
                     fmt::format("{} side, window {:.0f}–{:.0f} % of the height", side,
                                 100 * other.window_from, 100 * other.window_to));
    }
  }
}

/// What of the film was measured.
std::string film_text(const FilmedPicture& filmed) {
  const std::string film = fmt::format("{:.4g} frames per second, {:.3g} s",
                                       filmed.film.frames_per_s, filmed.film.length_s);
  if (!filmed.stretch) return "film of " + film;
  return fmt::format("at rest from {:.2f} to {:.2f} s: mean of {} frames of the film ({})",
                     filmed.stretch->from_s, filmed.stretch->to_s, filmed.stretch->frames, film);
}

/// Its file is in the row of the heap at rest; what is to be known of it is in the files alone, for
/// there may be hundreds.
void add_frame(Table& table, const MeasuredPicture& picture, const TableStyle& style) {
  const vision::ReposeAngle& angle = picture.angle;
  table.add_row(
      {fmt::format("{:7.2f} s", *picture.filmed->time_s),
       degrees_cell(angle.angle_rad, angle.uncertainty_rad), flank_cell(angle.left, angle.status),
       flank_cell(angle.right, angle.status),
       angle.ground_tilt_rad ? fmt::format("{:.2f}", to_degrees(*angle.ground_tilt_rad)) : kNothing,
       fmt::format("{:.2f}", angle.confidence), name_of(angle.status)},
      row_colour(picture, style.has_colour));
}

/// "105.2 ± 3.1": as many digits as the uncertainty has.
std::string size_text(const vision::Estimate& estimate) {
  constexpr double kTwoDigits = 10;
  int digits = 0;
  for (double step = estimate.uncertainty; step > 0 && step < kTwoDigits && digits < 4;
       step *= 10) {
    ++digits;
  }
  return fmt::format("{:.{}f} ± {:.{}f}", estimate.value, digits, estimate.uncertainty, digits);
}

/// Sizes in millimetres, in one line.
std::string sizes_text(const MeasuredPicture& picture) {
  const vision::HeapSizes& sizes = picture.sizes;
  std::string text;
  const auto add = [&](const char* name, const std::optional<vision::Estimate>& estimate,
                       const char* unit) {
    if (!estimate) return;
    text += fmt::format("{}{} {} {}", text.empty() ? "" : ", ", name, size_text(*estimate), unit);
  };
  add("height", sizes.height_mm, "mm");
  add("base", sizes.base_mm, "mm");
  add("cone's volume", sizes.cone_volume_ml, "ml");
  add("run-out left", sizes.left_run_out_mm, "mm");
  add("right", sizes.right_run_out_mm, "mm");
  add("scale", sizes.mm_per_px, "mm per pixel");
  return text;
}

std::string board_text(const vision::SeenBoard& board) {
  if (!board.pitch_rad) return fmt::format("{} corners; {}", board.corners, board.missing);
  return fmt::format("{} corners; the camera looks down by {:.1f} ± {:.1f}°", board.corners,
                     to_degrees(board.pitch_rad->value), to_degrees(board.pitch_rad->uncertainty));
}

void add_sizes(Table& table, const MeasuredPicture& picture) {
  if (picture.sizes.mm_per_px) table.add_note(kBelow, sizes_text(picture));
  if (picture.board) table.add_note(fmt::format("{}board: ", kBelow), board_text(*picture.board));
  if (picture.angle.status != vision::MeasureStatus::refused && !picture.sizes.reason.empty()) {
    table.add_note(fmt::format("{}no sizes: ", kBelow), picture.sizes.reason);
  }
}

void add_picture(Table& table, const MeasuredPicture& picture, const TableStyle& style) {
  if (is_of_series(picture)) return add_frame(table, picture, style);
  const vision::ReposeAngle& angle = picture.angle;
  const Colour colour = row_colour(picture, style.has_colour);
  if (picture.outcome != Outcome::measured) {
    table.add_row({picture.file, kNothing, kNothing, kNothing, kNothing, kNothing, "not read"},
                  colour);
    return;
  }
  table.add_row(
      {picture.file, degrees_cell(angle.angle_rad, angle.uncertainty_rad),
       flank_cell(angle.left, angle.status), flank_cell(angle.right, angle.status),
       angle.ground_tilt_rad ? fmt::format("{:.2f}", to_degrees(*angle.ground_tilt_rad)) : kNothing,
       fmt::format("{:.2f}", angle.confidence), name_of(angle.status)},
      colour);
  if (picture.filmed) table.add_note(kBelow, film_text(*picture.filmed));
  if (angle.status == vision::MeasureStatus::refused) {
    table.add_note(fmt::format("{}refused: ", kBelow), angle.reason);
    if (picture.proposal) {
      table.add_note(fmt::format("{}try: ", kBelow), proposal_text(picture));
    }
  }
  add_sizes(table, picture);
  for (const vision::Warning& warning : angle.warnings) {
    table.add_note(fmt::format("{}! ", kBelow), warning.message);
  }
  if (style.shows_definitions) add_definitions(table, angle);
}

}  // namespace

std::string measure_table(const std::vector<MeasuredPicture>& pictures, const TableStyle& style) {
  constexpr std::size_t kAngleWidth = 12;  // "23.38 ± 0.52"
  Table table({{.heading = "picture"},
               {.heading = "angle [°]", .min_width = kAngleWidth},
               {.heading = "left [°]", .min_width = kAngleWidth},
               {.heading = "right [°]", .min_width = kAngleWidth},
               {.heading = "tilt [°]", .align = Align::right},
               {.heading = "conf.", .align = Align::right},
               {.heading = "status"}});
  for (const MeasuredPicture& picture : pictures) add_picture(table, picture, style);
  return table.text(style.columns);
}

}  // namespace repose::cli
