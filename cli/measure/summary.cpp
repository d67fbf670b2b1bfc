#include "cli/measure/summary.h"

#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace repose::cli {
namespace {

/// More digits than any camera resolves, without the noise of the conversion.
double rounded(double angle_deg) { return std::round(angle_deg * 1e6) / 1e6; }

std::string remarks_on(const Summary& summary) {
  std::string text;
  if (summary.pictures.flagged > 0) {
    text += fmt::format("\n{} of these flagged: look at them", summary.pictures.flagged);
  }
  std::vector<std::string> left_out;
  if (summary.pictures.refused > 0) {
    left_out.push_back(fmt::format("{} refused", summary.pictures.refused));
  }
  if (summary.copies > 0) {
    left_out.push_back(
        fmt::format("{} {} of others", summary.copies, summary.copies == 1 ? "copy" : "copies"));
  }
  if (summary.not_read > 0) left_out.push_back(fmt::format("{} not read", summary.not_read));
  if (!left_out.empty()) {
    text += fmt::format("\nleft out of the mean: {}", fmt::join(left_out, ", "));
  }
  return text;
}

}  // namespace

Summary summarise(const std::vector<MeasuredPicture>& pictures) {
  Summary summary;
  std::vector<calibrate::PictureAngle> angles;
  for (const MeasuredPicture& picture : pictures) {
    if (is_of_series(picture)) continue;
    if (!picture.copy_of.empty()) {
      ++summary.copies;
      continue;
    }
    if (picture.outcome == Outcome::measured) {
      angles.push_back({picture.angle.status, picture.angle.angle_rad});
    } else {
      ++summary.not_read;
    }
  }
  summary.pictures = calibrate::mean_of_pictures(angles);
  return summary;
}

std::string summary_text(const Summary& summary) {
  const std::string remarks = remarks_on(summary);
  if (!summary.pictures.angle_deg) return "no mean: no picture could be measured" + remarks;
  const auto& [n, mean, sd, uncertainty] = *summary.pictures.angle_deg;
  if (!sd || !uncertainty) {
    return fmt::format("mean {:.2f}° n = 1, which has no scatter{}", mean, remarks);
  }
  return fmt::format(
      "mean {:.2f}° sd {:.2f}° n = {}, 95 % interval of the mean {:.2f} … {:.2f}° "
      "(Student){}",
      mean, *sd, n, mean - *uncertainty, mean + *uncertainty, remarks);
}

std::string summary_json(const Summary& summary) {
  nlohmann::ordered_json json{
      {"n", 0}, {"mean_deg", nullptr}, {"sd_deg", nullptr}, {"interval_deg", nullptr}};
  if (summary.pictures.angle_deg) {
    const auto& [n, mean, sd, uncertainty] = *summary.pictures.angle_deg;
    json["n"] = n;
    json["mean_deg"] = rounded(mean);
    if (sd) json["sd_deg"] = rounded(*sd);
    if (uncertainty) {
      json["interval_deg"] = {rounded(mean - *uncertainty), rounded(mean + *uncertainty)};
    }
  }
  json["flagged"] = summary.pictures.flagged;
  json["refused"] = summary.pictures.refused;
  json["not_read"] = summary.not_read;
  json["copies"] = summary.copies;
  return json.dump(2) + '\n';
}

}  // namespace repose::cli
