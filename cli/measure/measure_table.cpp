#include "cli/measure/measure_table.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/angle_definition.h"
#include "base/units.h"
#include "calibrate/measured/measured_command.h"
#include "calibrate/measured/measured_file.h"
#include "cli/common/table.h"
#include "vision/measure/repose_angle.h"
#include "vision/scan/scanned_heap.h"

namespace repose::cli {

namespace {

/// The command that measures a refused picture with the proposal and all its other settings; and
/// its result, or that its positions need correcting.
std::string proposal_text(const calibrate::MeasuredPicture& picture) {
  const vision::Proposal& proposal = *picture.proposal;
  calibrate::MeasuredPicture proposed;
  proposed.file = picture.file;
  proposed.filmed = picture.filmed;
  proposed.told = calibrate::with_proposal(picture.told, proposal);
  const std::string command = calibrate::measure_command(proposed);
  if (!proposal.angle_rad)
    return command + "  with your own corners of the heap and its ground line";
  return fmt::format(
      "{}  which gives {:.2f} ± {:.2f}; {}", command, to_degrees(*proposal.angle_rad),
      to_degrees(proposal.uncertainty_rad.value_or(0)),
      proposal.turn_deg != 0 ? "does the picture lie on its side?" : "look at its overlay");
}

std::string degrees_cell(const std::optional<double>& angle_rad,
                         const std::optional<double>& uncertainty_rad) {
  if (!angle_rad) return kMissing;
  std::string angle = fmt::format("{:5.2f}", to_degrees(*angle_rad));
  if (!uncertainty_rad) return angle;
  return fmt::format("{} ± {:.2f}", angle, to_degrees(*uncertainty_rad));
}

std::string flank_cell(const vision::Flank& flank, vision::MeasureStatus status) {
  if (flank.angle_rad) return degrees_cell(flank.angle_rad, flank.uncertainty_rad);
  return status == vision::MeasureStatus::refused ? kMissing : name_of(flank.status);
}

Colour row_colour(const calibrate::MeasuredPicture& picture, bool has_colour) {
  if (!has_colour) return Colour::none;
  if (picture.outcome != calibrate::Outcome::measured) return Colour::red;
  return colour_of(picture.angle.status);
}

void add_definitions(Table& table, const vision::ReposeAngle& angle) {
  for (const vision::NamedAngle& definition : angle.definitions) {
    table.add_note(fmt::format("{}{}  ", kNoteIndent,
                               degrees_cell(definition.angle_rad, definition.uncertainty_rad)),
                   fmt::format("{}: {}", definition.name, definition.description));
  }
  for (const auto& [side, flank] : {std::pair("left", &angle.left), {"right", &angle.right}}) {
    for (const vision::WindowAngle& other : flank->other_windows) {
      table.add_note(fmt::format("{}{:5.2f}°  ", kNoteIndent, to_degrees(other.angle_rad)),
                     fmt::format("{} side, window {:.0f}–{:.0f} % of the height", side,
                                 100 * other.window_from, 100 * other.window_to));
    }
    if (!flank->apron) continue;
    table.add_note(
        fmt::format("{}{:5.2f}°  ", kNoteIndent, to_degrees(flank->apron->angle_with_rad)),
        fmt::format("{} side, its apron below {:.0f} % of the height counted in full", side,
                    100 * flank->apron->from));
  }
}

/// Which part of the film was measured.
std::string film_text(const calibrate::FilmedPicture& filmed) {
  const std::string film = fmt::format("{:.4g} frames per second, {:.3g} s",
                                       filmed.film.frames_per_s, filmed.film.length_s);
  if (!filmed.stretch) return "film of " + film;
  return fmt::format("at rest from {:.2f} to {:.2f} s: mean of {} frames of the film ({})",
                     filmed.stretch->from_s, filmed.stretch->to_s, filmed.stretch->frames, film);
}

/// The file is named in the row of the heap at rest; notes on frames are only in the output files,
/// as there may be hundreds.
void add_frame(Table& table, const calibrate::MeasuredPicture& picture, const TableStyle& style) {
  const vision::ReposeAngle& angle = picture.angle;
  table.add_row(
      {fmt::format("{:7.2f} s", *picture.filmed->time_s),
       degrees_cell(angle.angle_rad, angle.uncertainty_rad), flank_cell(angle.left, angle.status),
       flank_cell(angle.right, angle.status),
       angle.ground_tilt_rad ? fmt::format("{:.2f}", to_degrees(*angle.ground_tilt_rad)) : kMissing,
       fmt::format("{:.2f}", angle.confidence), name_of(angle.status)},
      row_colour(picture, style.has_colour));
}

/// "105.2 ± 3.1": with the digits of the uncertainty.
std::string size_text(const vision::Estimate& estimate) {
  if (estimate.uncertainty == 0) return fmt::format("{:.4g}", estimate.value);
  constexpr double kTwoDigits = 10;
  int digits = 0;
  for (double step = estimate.uncertainty; step > 0 && step < kTwoDigits && digits < 4;
       step *= 10) {
    ++digits;
  }
  return fmt::format("{:.{}f} ± {:.{}f}", estimate.value, digits, estimate.uncertainty, digits);
}

/// Sizes in millimetres, in one line.
std::string sizes_text(const calibrate::MeasuredPicture& picture) {
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

void add_sizes(Table& table, const calibrate::MeasuredPicture& picture) {
  if (picture.sizes.mm_per_px) table.add_note(kNoteIndent, sizes_text(picture));
  if (picture.board)
    table.add_note(fmt::format("{}board: ", kNoteIndent), board_text(*picture.board));
  if (picture.angle.status != vision::MeasureStatus::refused && !picture.sizes.reason.empty()) {
    table.add_note(fmt::format("{}no sizes: ", kNoteIndent), picture.sizes.reason);
  }
}

/// What pictures of the heap would show.
std::string silhouettes_text(const std::optional<calibrate::ScanViews>& silhouettes) {
  if (!silhouettes || !silhouettes->angle.angle_rad) {
    return fmt::format("its silhouettes give no angle: {}",
                       silhouettes ? silhouettes->angle.reason : "they were not drawn");
  }
  return fmt::format(
      "in silhouette from {} sides, as pictures show it: {:.2f} ± {:.2f}° ({}, sd {:.2f}°); "
      "compare "
      "and studies take this one",
      calibrate::kHeapViews, to_degrees(*silhouettes->angle.angle_rad),
      to_degrees(silhouettes->angle.uncertainty_rad.value_or(0)),
      name_of(silhouettes->angle.status), to_degrees(silhouettes->between_views_rad.value_or(0)));
}

/// For a scan, whose heap has azimuths instead of sides.
void add_scan(Table& table, const calibrate::MeasuredPicture& picture,
              const vision::ScannedHeap& scan, const TableStyle& style) {
  const vision::ReposeAngle& angle = scan.angle;
  table.add_row({picture.file, degrees_cell(angle.angle_rad, angle.uncertainty_rad), kMissing,
                 kMissing, kMissing, kMissing, name_of(angle.status)},
                row_colour(picture, style.has_colour));
  if (angle.status == vision::MeasureStatus::refused) {
    table.add_note(fmt::format("{}refused: ", kNoteIndent), angle.reason);
    return;
  }
  const auto seen = std::count_if(scan.azimuths.begin(), scan.azimuths.end(),
                                  [](const auto& one) { return one.angle_rad.has_value(); });
  table.add_note(kNoteIndent, fmt::format("scan: mean of {} azimuths, which scatter by sd {:.2f}°",
                                          seen, to_degrees(scan.azimuth_sd_rad.value_or(0))));
  table.add_note(kNoteIndent, silhouettes_text(picture.silhouettes));
  std::string sizes;
  if (scan.height_mm) sizes += fmt::format("height {} mm", size_text(*scan.height_mm));
  if (scan.base_mm) sizes += fmt::format(", base {} mm", size_text(*scan.base_mm));
  if (scan.volume_ml) sizes += fmt::format(", volume {} ml", size_text(*scan.volume_ml));
  if (!sizes.empty()) table.add_note(kNoteIndent, sizes);
  if (!scan.size_reason.empty()) {
    table.add_note(fmt::format("{}no sizes: ", kNoteIndent), scan.size_reason);
  }
  for (const vision::Warning& warning : angle.warnings) {
    table.add_note(fmt::format("{}! ", kNoteIndent), warning.message);
  }
  if (style.shows_definitions) add_definitions(table, angle);
}

std::string positions_text(const calibrate::MeasuredPositions& positions) {
  std::string text = positions.file.text();
  const auto counted = std::ranges::count_if(
      positions.views, [](const auto& view) { return view.angle_rad.has_value(); });
  if (positions.between_views_rad) {
    text += fmt::format("; mean of {} views, which scatter by {:.2f}° (sd)", counted,
                        to_degrees(*positions.between_views_rad));
  }
  return text;
}

void add_picture(Table& table, const calibrate::MeasuredPicture& picture, const TableStyle& style) {
  if (is_of_series(picture)) return add_frame(table, picture, style);
  const vision::ReposeAngle& angle = picture.angle;
  const Colour colour = row_colour(picture, style.has_colour);
  if (picture.outcome != calibrate::Outcome::measured) {
    table.add_row({picture.file, kMissing, kMissing, kMissing, kMissing, kMissing, "not read"},
                  colour);
    return;
  }
  if (picture.scan) return add_scan(table, picture, *picture.scan, style);
  table.add_row(
      {picture.file, degrees_cell(angle.angle_rad, angle.uncertainty_rad),
       flank_cell(angle.left, angle.status), flank_cell(angle.right, angle.status),
       angle.ground_tilt_rad ? fmt::format("{:.2f}", to_degrees(*angle.ground_tilt_rad)) : kMissing,
       fmt::format("{:.2f}", angle.confidence), name_of(angle.status)},
      colour);
  if (picture.filmed) table.add_note(kNoteIndent, film_text(*picture.filmed));
  if (picture.positions) table.add_note(kNoteIndent, positions_text(*picture.positions));
  if (angle.status == vision::MeasureStatus::refused) {
    table.add_note(fmt::format("{}refused: ", kNoteIndent), angle.reason);
    if (picture.proposal) {
      table.add_note(fmt::format("{}try: ", kNoteIndent), proposal_text(picture));
    }
  }
  add_sizes(table, picture);
  for (const vision::Warning& warning : angle.warnings) {
    table.add_note(fmt::format("{}! ", kNoteIndent), warning.message);
  }
  if (style.shows_definitions) add_definitions(table, angle);
}

}  // namespace

std::string measure_table(const std::vector<calibrate::MeasuredPicture>& pictures,
                          const TableStyle& style) {
  constexpr std::size_t kAngleWidth = 12;  // "23.38 ± 0.52"
  Table table({{.heading = "picture"},
               {.heading = "angle [°]", .min_width = kAngleWidth},
               {.heading = "left [°]", .min_width = kAngleWidth},
               {.heading = "right [°]", .min_width = kAngleWidth},
               {.heading = "tilt [°]", .align = Align::right},
               {.heading = "conf.", .align = Align::right},
               {.heading = "status"}});
  for (const calibrate::MeasuredPicture& picture : pictures) add_picture(table, picture, style);
  return table.text(style.columns);
}

}  // namespace repose::cli
