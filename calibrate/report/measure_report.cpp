#include "calibrate/report/measure_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/angle_definition.h"
#include "base/units.h"
#include "base/version.h"
#include "calibrate/experiment/heap_angle.h"
#include "calibrate/report/document.h"
#include "calibrate/report/picture_data.h"
#include "calibrate/report/report_of.h"
#include "calibrate/report/wording.h"
#include "calibrate/statistics/summary.h"
#include "vision/measure/repose_angle.h"

namespace repose::calibrate::report {
namespace {

using vision::MeasureStatus;

std::optional<double> degrees(const std::optional<double>& angle_rad) {
  if (!angle_rad) return std::nullopt;
  return to_degrees(*angle_rad);
}

std::string name_of_file(const MeasuredPhotograph& picture) {
  const std::size_t slash = picture.file.find_last_of('/');
  return shortened(slash == std::string::npos ? picture.file : picture.file.substr(slash + 1));
}

std::string status_of(const MeasuredPhotograph& picture) {
  return picture.error.empty() ? name_of(picture.angle.status) : "not read";
}

std::string remarks_of(const MeasuredPhotograph& picture) {
  if (!picture.error.empty()) return shortened(picture.error, 500);
  std::string text = picture.angle.reason;
  for (const vision::Warning& warning : picture.angle.warnings) {
    if (!text.empty()) text += ' ';
    text += warning.message;
  }
  return shortened(text, 1000);
}

calibrate::PictureSet set_of(const std::vector<MeasuredPhotograph>& pictures) {
  std::vector<calibrate::SetPicture> set;
  for (const MeasuredPhotograph& picture : pictures) {
    if (!picture.error.empty()) continue;
    set.push_back(calibrate::set_picture_of(picture.angle, picture.heap));
  }
  return calibrate::set_of_pictures(set);
}

std::string mean_text(const calibrate::Summary& mean, const char* what) {
  if (!mean.mean_uncertainty) {
    return fmt::format("{} {}°, from a single one.", what, shown(mean.mean, 2));
  }
  return fmt::format("{} {}°, 95 % interval {}° to {}° (standard deviation {}°, n = {}).", what,
                     shown(mean.mean, 2), shown(mean.mean - *mean.mean_uncertainty, 2),
                     shown(mean.mean + *mean.mean_uncertainty, 2), shown(mean.sd, 2), mean.n);
}

std::string answer_text(const std::vector<MeasuredPhotograph>& pictures,
                        const calibrate::PictureSet& set) {
  const auto outliers =
      std::ranges::count(set.outliers, false, &calibrate::OutlyingPicture::is_counted);
  const auto left_out = static_cast<long>(pictures.size()) - set.pictures - outliers;
  std::string text = set.heaps_deg ? mean_text(*set.heaps_deg, "Mean angle of repose")
                                   : "No picture gave a usable number.";
  if (set.within_sd_deg) {
    text += fmt::format(
        " These are {} pictures of {} {}, and n counts heaps; pictures of one heap have a "
        "standard deviation of {}°.",
        set.pictures, set.heaps_deg->n, set.heaps_deg->n == 1 ? "heap" : "heaps",
        shown(set.within_sd_deg, 2));
    if (set.between_sd_deg) {
      text += fmt::format(" Without that, the heaps themselves have {}°.",
                          shown(set.between_sd_deg, 2));
    }
  }
  if (set.ok_deg && set.flagged > 0) text += ' ' + mean_text(*set.ok_deg, "Of those that are ok");
  if (outliers > 0) {
    text += fmt::format(
        " Left out of the mean: {} flagged and an outlier among the others, named "
        "below.",
        outliers);
    text += ' ' + mean_text(*set.all_deg, "With what was left out:");
  }
  if (set.flagged > 0) text += fmt::format(" Flagged: {} of these.", set.flagged);
  if (left_out > 0) text += fmt::format(" Excluded: {} refused or unreadable.", left_out);
  if (set.pictures > 1) {
    text += fmt::format(
        " All share ± {}° by the camera's pitch and distance, which more pictures "
        "do not lower.",
        shown(set.camera_deg, 2));
  }
  return text;
}

Table pictures_table(const std::vector<MeasuredPhotograph>& pictures) {
  Table table{.name = "pictures",
              .title = "Pictures (± is the half-width of the 95 % interval)",
              .data = {.columns = {{.name = "picture", .unit = {}},
                                   {.name = "angle", .unit = "°", .decimals = 2},
                                   {.name = "±", .unit = "°", .decimals = 2},
                                   {.name = "left", .unit = "°", .decimals = 2},
                                   {.name = "right", .unit = "°", .decimals = 2},
                                   {.name = "status", .unit = {}},
                                   {.name = "remarks", .unit = {}}},
                       .rows = {}}};
  for (const MeasuredPhotograph& picture : pictures) {
    const vision::ReposeAngle& angle = picture.angle;
    table.data.add({name_of_file(picture), cell(degrees(angle.angle_rad)),
                    cell(degrees(angle.uncertainty_rad)), cell(degrees(angle.left.angle_rad)),
                    cell(degrees(angle.right.angle_rad)), status_of(picture), remarks_of(picture)});
  }
  return table;
}

constexpr std::size_t kManyPictures = 40;  // more than names fit below a chart

/// A range of angles slightly larger than their error bars; long bars are cut off.
std::array<double, 2> range_of(const Chart& chart) {
  constexpr double kLongest_deg = 12, kRoom_deg = 1, kUpright_deg = 90;
  double low = kUpright_deg, high = 0;
  for (const std::vector<Cell>& row : chart.data.rows) {
    const auto number = [&](std::size_t column) { return std::get_if<double>(&row[column]); };
    if (number(2) == nullptr) continue;
    const double angle = *number(2);
    const double from = number(3) == nullptr ? angle : *number(3);
    const double to = number(4) == nullptr ? angle : *number(4);
    low = std::min(low, std::max(from, angle - kLongest_deg));
    high = std::max(high, std::min(to, angle + kLongest_deg));
  }
  return {std::max(0.0, std::floor(low - kRoom_deg)),
          std::min(kUpright_deg, std::ceil(high + kRoom_deg))};
}

/// Each picture's angle with its interval, in the order of the pictures, and the mean with its
/// interval.
Chart angles_chart(const std::vector<MeasuredPhotograph>& pictures,
                   const std::optional<calibrate::Summary>& mean) {
  Chart chart = plane_chart("angles", "Angles", {.name = "picture", .unit = {}},
                            {.name = "angle of repose", .unit = "°"});
  const bool has_names = pictures.size() <= kManyPictures;
  const auto place = [&](std::size_t k) -> Cell {
    if (!has_names) return static_cast<double>(k + 1);
    return fmt::format("{}: {}", k + 1, name_of_file(pictures[k]));
  };
  std::vector<std::size_t> shown;
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    const vision::ReposeAngle& measured = pictures[k].angle;
    if (!pictures[k].error.empty() || !measured.angle_rad) continue;
    shown.push_back(k);
    const double angle = *degrees(measured.angle_rad);
    const auto half = degrees(measured.uncertainty_rad);
    const bool is_ok = measured.status == MeasureStatus::ok;
    add_point(chart, is_ok ? "ok" : "flagged", is_ok ? Look::dots : Look::runs, place(k), angle,
              half ? Cell(angle - *half) : Cell(), half ? Cell(angle + *half) : Cell());
  }
  if (mean && shown.size() > 1) {
    const double half = mean->mean_uncertainty.value_or(0);
    for (const std::size_t k : {shown.front(), shown.back()}) {
      add_point(chart, "mean, 95 %", Look::measured, place(k), mean->mean, mean->mean - half,
                mean->mean + half);
    }
  }
  if (!shown.empty()) chart.y_range = range_of(chart);
  chart.has_whole_x = !has_names;
  chart.caption =
      "Bars are the 95 % intervals of single pictures; the band is that of their mean, from their "
      "scatter.";
  return chart;
}

PictureRow overlays_row(const std::vector<MeasuredPhotograph>& pictures) {
  PictureRow row;
  for (const MeasuredPhotograph& picture : pictures) {
    if (picture.overlay.bytes.empty()) continue;
    const auto angle = degrees(picture.angle.angle_rad);
    const std::string what =
        angle ? fmt::format("angle of repose {}° ± {}°, {}", shown(angle, 2),
                            shown(degrees(picture.angle.uncertainty_rad), 2), status_of(picture))
              : "refused: " + shortened(picture.angle.reason, 300);
    const std::string text = name_of_file(picture) + ": " + what;
    row.pictures.push_back(
        shown_jpeg(picture.overlay, "Photograph with the measurement drawn in. " + text, text));
    row.pictures.back().command = picture.command;
  }
  return row;
}

}  // namespace

PageJpeg overlay_for_page(const vision::Picture& picture, const vision::ReposeAngle& angle,
                          const vision::OverlayNotes& notes, std::size_t pictures) {
  const vision::Picture overlay = vision::draw_overlay(picture, angle, notes);
  PageJpeg jpeg = page_overlay(overlay, pictures);
  jpeg.picture_width = picture.width;
  jpeg.picture_height = picture.height;
  jpeg.area = vision::area_in_overlay(picture, overlay);
  return jpeg;
}

PageJpeg page_overlay(const vision::Picture& overlay, std::size_t pictures) {
  return page_jpeg(overlay, longest_side_px(pictures));
}

Report measure_report(const std::vector<MeasuredPhotograph>& pictures,
                      const vision::MeasureOptions& options) {
  const calibrate::PictureSet set = set_of(pictures);
  const std::string named = options.definition_text();
  Document document{
      .title = fmt::format("{} picture{}", pictures.size(), pictures.size() == 1 ? "" : "s"),
      .kind = "Angles of repose",
      .state = {},
      .chapters = {},
      .program = base::kProgram};
  Chapter answer{.id = "answer", .title = "The answer", .blocks = {}};
  answer.blocks.push_back(Paragraph{answer_text(pictures, set)});
  Chart chart = angles_chart(pictures, set.heaps_deg);
  if (!chart.data.rows.empty()) answer.blocks.push_back(ChartRow{{std::move(chart)}});
  answer.blocks.push_back(pictures_table(pictures));
  document.chapters.push_back(std::move(answer));
  PictureRow row = overlays_row(pictures);
  if (!row.pictures.empty()) {
    document.chapters.push_back(
        {.id = "pictures", .title = "Pictures", .blocks = {std::move(row)}});
  }
  document.chapters.push_back(
      {.id = "methods",
       .title = "How the angle is measured",
       .blocks = {Paragraph{fmt::format(
           "On each flank, {}; the angle of repose is the mean of both, relative to the ground "
           "line. ± "
           "is the half-width of the 95 % interval for that one heap; the scatter between heaps is "
           "not included.",
           named.empty() ? std::string(base::kUsualDefinition.description) : named)}}});
  return report_of(std::move(document));
}

}  // namespace repose::calibrate::report
