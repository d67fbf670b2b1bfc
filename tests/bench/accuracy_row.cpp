#include "tests/bench/accuracy_row.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <stdexcept>

#include <fmt/format.h>

#include "tests/bench/obvious_script.h"
#include "vision/drawing/overlay.h"

namespace repose::bench {
namespace {

using vision::MeasureStatus;

constexpr std::array<std::string_view, 3> kMethods = {"auto", "paper", "script"};

std::optional<double> degrees(std::optional<double> angle_rad) {
  if (!angle_rad) return std::nullopt;
  return *angle_rad * 180 / std::numbers::pi;
}

/// For a table cell, so without double quotes.
std::string codes_of(const vision::ReposeAngle& measured) {
  std::string codes;
  if (measured.status == MeasureStatus::refused) {
    codes = measured.reason;
    std::replace(codes.begin(), codes.end(), '"', '\'');
    return codes;
  }
  for (const auto& warning : measured.warnings) {
    if (!codes.empty()) codes += ' ';
    codes += warning.code;
  }
  return codes;
}

void fill_in_script(Row& row, const vision::Picture& picture) {
  const auto angles = obvious_script(picture);
  row.left.measured_deg = degrees(angles.left_rad);
  row.right.measured_deg = degrees(angles.right_rad);
  row.mean.measured_deg = row.left.measured_deg ? row.left.measured_deg : row.right.measured_deg;
  if (angles.left_rad && angles.right_rad) {
    row.mean.measured_deg = (*row.left.measured_deg + *row.right.measured_deg) / 2;
  }
  row.status = row.mean.measured_deg ? MeasureStatus::ok : MeasureStatus::refused;
}

void fill_in(Row& row, const vision::ReposeAngle& measured) {
  row.mean.measured_deg = degrees(measured.angle_rad);
  row.mean.uncertainty_deg = degrees(measured.uncertainty_rad);
  row.left.measured_deg = degrees(measured.left.angle_rad);
  row.left.uncertainty_deg = degrees(measured.left.uncertainty_rad);
  row.right.measured_deg = degrees(measured.right.angle_rad);
  row.right.uncertainty_deg = degrees(measured.right.uncertainty_rad);
  row.status = measured.status;
  row.confidence = measured.confidence;
  row.segmentation = measured.segmentation;
  row.warnings = codes_of(measured);
}

std::string number(std::optional<double> value) {
  return value ? fmt::format("{:.4f}", *value) : "";
}

std::string title_of(const Row& row) {
  return fmt::format("{} {} {}: true {} (left {}, right {})", row.subject->condition,
                     row.subject->seed, row.method, number(row.mean.true_deg),
                     number(row.left.true_deg), number(row.right.true_deg));
}

void measure(Row& row, const KnownPicture& known, const std::string& overlay_folder) {
  vision::MeasureOptions options;
  options.method = row.method == "paper" ? vision::Method::paper : vision::Method::automatic;
  options.camera_pitch_rad = known.told_pitch_rad;
  const auto measured = vision::measure_repose_angle(known.picture, options);
  fill_in(row, measured);
  if (overlay_folder.empty()) return;
  const auto name = fmt::format("{}-{}-{}-{}.png", row.subject->section, row.subject->condition,
                                row.subject->seed, row.method);
  vision::write_picture(
      std::filesystem::path(overlay_folder) / name,
      vision::draw_overlay(known.picture, measured, {.title = title_of(row), .excluded = {}}));
}

}  // namespace

std::optional<double> SideErrors::error_deg() const {
  if (!true_deg || !measured_deg) return std::nullopt;
  return *measured_deg - *true_deg;
}

std::optional<bool> SideErrors::covered() const {
  const auto error = error_deg();
  if (!error || !uncertainty_deg) return std::nullopt;
  return std::abs(*error) <= *uncertainty_deg;
}

std::span<const std::string_view> methods() { return kMethods; }

std::vector<Row> measure_rows(const Subject& subject,
                              std::span<const std::string_view> with_methods,
                              const std::string& overlay_folder) {
  const KnownPicture known = subject.take();
  Row row;
  row.subject = &subject;
  row.mean.true_deg = degrees(known.heap.mean_rad());
  row.left.true_deg = degrees(known.heap.left_rad);
  row.right.true_deg = degrees(known.heap.right_rad);
  row.seen_deg = degrees(known.seen.mean_rad());
  std::vector<Row> rows(with_methods.size(), row);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].method = with_methods[i];
    if (rows[i].method == "script") {
      fill_in_script(rows[i], known.picture);
    } else {
      measure(rows[i], known, overlay_folder);
    }
  }
  return rows;
}

void write_csv(const std::string& file, std::span<const Row> rows) {
  std::ofstream out(file);
  if (!out) {
    throw std::invalid_argument(file + ": cannot be written. Fix: name an existing folder.");
  }
  constexpr std::array<const char*, 3> kStatus = {"ok", "flagged", "refused"};
  out << "section,condition,seed,method,true_deg,measured_deg,uncertainty_deg,left_true_deg,left_"
         "deg,"
         "left_uncertainty_deg,right_true_deg,right_deg,right_uncertainty_deg,seen_deg,status,"
         "confidence,segmentation,warnings\n";
  for (const Row& row : rows) {
    out << fmt::format("{},{},{},{}", row.subject->section, row.subject->condition,
                       row.subject->seed, row.method);
    for (const SideErrors& side : {row.mean, row.left, row.right}) {
      out << fmt::format(",{},{},{}", number(side.true_deg), number(side.measured_deg),
                         number(side.uncertainty_deg));
    }
    out << fmt::format(",{},{},{:.3f},{},\"{}\"\n", number(row.seen_deg),
                       kStatus[static_cast<std::size_t>(row.status)], row.confidence,
                       row.segmentation, row.warnings);
  }
}

}  // namespace repose::bench
