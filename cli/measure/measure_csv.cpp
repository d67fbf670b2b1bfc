#include "cli/measure/measure_csv.h"

#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/csv.h"
#include "cli/common/degrees.h"
#include "vision/measure/status_name.h"

namespace repose::cli {
namespace {

constexpr const char* kHeader =
    "file,status,angle_deg,uncertainty_deg,"
    "left_status,left_deg,left_uncertainty_deg,left_r2,left_points,"
    "right_status,right_deg,right_uncertainty_deg,right_r2,right_points,"
    "ground_tilt_deg,window_from,window_to,method,segmentation,confidence,"
    "strays,grain_px,height_px,base_px,hints,warnings,reason,"
    "time_s,film_from_s,film_to_s,film_frames,frames_per_s,"
    "camera,scale,mm_per_px,mm_per_px_uncertainty,height_mm,height_mm_uncertainty,"
    "base_mm,base_mm_uncertainty,cone_volume_ml,cone_volume_ml_uncertainty,"
    "left_run_out_mm,left_run_out_mm_uncertainty,right_run_out_mm,right_run_out_mm_uncertainty,"
    "size_reason\n";

/// One row, field by field.
class Row {
 public:
  void add_text(std::string_view text) { fields_.emplace_back(text); }
  void add_number(const std::optional<double>& value) {
    fields_.push_back(value ? fmt::format("{}", *value) : "");
  }
  void add_count(int value) { fields_.push_back(fmt::format("{}", value)); }
  void add_degrees(const std::optional<double>& angle_rad) {
    add_number(angle_rad ? std::optional(rounded_degrees(*angle_rad)) : std::nullopt);
  }
  std::string line() const { return base::csv_row(fields_); }

 private:
  std::vector<std::string> fields_;
};

void add_flank(Row& row, const vision::Flank& flank) {
  row.add_text(name_of(flank.status));
  row.add_degrees(flank.angle_rad);
  row.add_degrees(flank.uncertainty_rad);
  row.add_number(flank.r2);
  row.add_count(flank.points);
}

std::string warning_codes(const std::vector<vision::Warning>& warnings) {
  std::vector<std::string> codes;
  codes.reserve(warnings.size());
  for (const vision::Warning& warning : warnings) codes.push_back(warning.code);
  return fmt::format("{}", fmt::join(codes, ";"));
}

/// Of pictures empty.
void add_film(Row& row, const std::optional<FilmedPicture>& filmed) {
  constexpr int kFields = 5;
  if (!filmed) {
    for (int field = 0; field < kFields; ++field) row.add_text("");
    return;
  }
  const auto& stretch = filmed->stretch;
  row.add_number(filmed->time_s);
  row.add_number(stretch ? std::optional(stretch->from_s) : std::nullopt);
  row.add_number(stretch ? std::optional(stretch->to_s) : std::nullopt);
  row.add_text(stretch ? fmt::format("{}", stretch->frames) : "");
  row.add_number(filmed->film.frames_per_s);
}

/// Empty where there is no scale.
void add_sizes(Row& row, const MeasuredPicture& picture) {
  const vision::HeapSizes& sizes = picture.sizes;
  row.add_text(picture.lens ? picture.told.scale.lens_file.string() : "");
  row.add_text(!picture.has_scale ? "" : picture.board ? "board" : "given");
  for (const auto* estimate :
       {&sizes.mm_per_px, &sizes.height_mm, &sizes.base_mm, &sizes.cone_volume_ml,
        &sizes.left_run_out_mm, &sizes.right_run_out_mm}) {
    row.add_number(*estimate ? std::optional((*estimate)->value) : std::nullopt);
    row.add_number(*estimate ? std::optional((*estimate)->uncertainty) : std::nullopt);
  }
  row.add_text(sizes.reason);
}

std::string measured_line(const MeasuredPicture& picture) {
  const vision::ReposeAngle& angle = picture.angle;
  Row row;
  row.add_text(picture.file);
  row.add_text(name_of(angle.status));
  row.add_degrees(angle.angle_rad);
  row.add_degrees(angle.uncertainty_rad);
  add_flank(row, angle.left);
  add_flank(row, angle.right);
  row.add_degrees(angle.ground_tilt_rad);
  row.add_number(angle.window[0]);
  row.add_number(angle.window[1]);
  row.add_text(name_of(angle.method));
  row.add_text(angle.segmentation);
  row.add_number(angle.confidence);
  row.add_count(angle.strays);
  row.add_number(angle.grain_px);
  row.add_number(angle.height_px);
  row.add_number(angle.base_px);
  row.add_text(picture.told.measuring.hints.text());
  row.add_text(warning_codes(angle.warnings));
  row.add_text(angle.reason);
  add_film(row, picture.filmed);
  add_sizes(row, picture);
  return row.line();
}

/// Nothing is known of it but why.
std::string unread_line(const MeasuredPicture& picture) {
  constexpr int kUnknownFields = 24;  // between status and reason
  Row row;
  row.add_text(picture.file);
  row.add_text(name_of(vision::MeasureStatus::refused));
  for (int field = 0; field < kUnknownFields; ++field) row.add_text("");
  row.add_text(picture.error);
  add_film(row, picture.filmed);
  add_sizes(row, picture);
  return row.line();
}

}  // namespace

std::string measure_csv(const std::vector<MeasuredPicture>& pictures) {
  std::string csv = kHeader;
  for (const MeasuredPicture& picture : pictures) {
    csv += picture.outcome == Outcome::measured ? measured_line(picture) : unread_line(picture);
  }
  return csv;
}

}  // namespace repose::cli
