#include "cli/measure/summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "cli/common/degrees.h"

namespace repose::cli {
namespace {

std::string left_out_text(const Summary& summary) {
  std::vector<std::string> parts;
  if (summary.flagged > 0) parts.push_back(fmt::format("{} flagged", summary.flagged));
  if (summary.refused > 0) parts.push_back(fmt::format("{} refused", summary.refused));
  if (summary.not_read > 0) parts.push_back(fmt::format("{} not read", summary.not_read));
  if (parts.empty()) return {};
  return fmt::format("\nleft out of the mean: {}", fmt::join(parts, ", "));
}

}  // namespace

Summary summarise(const std::vector<MeasuredPicture>& pictures) {
  Summary summary;
  std::vector<double> angles_rad;
  for (const MeasuredPicture& picture : pictures) {
    if (picture.outcome != Outcome::measured) {
      ++summary.not_read;
    } else if (picture.angle.status == vision::MeasureStatus::refused) {
      ++summary.refused;
    } else if (picture.angle.status == vision::MeasureStatus::flagged) {
      ++summary.flagged;
    } else if (picture.angle.angle_rad) {
      angles_rad.push_back(*picture.angle.angle_rad);
    }
  }
  if (!angles_rad.empty()) summary.angle_rad = calibrate::summarise(angles_rad);
  return summary;
}

std::string summary_text(const Summary& summary) {
  const std::string left_out = left_out_text(summary);
  if (!summary.angle_rad) return "no mean: no picture has status ok" + left_out;
  const auto& [n, mean, sd, uncertainty] = *summary.angle_rad;
  if (!sd || !uncertainty) {
    return fmt::format("mean {:.2f}° n = 1, which has no scatter{}", to_degrees(mean), left_out);
  }
  return fmt::format(
      "mean {:.2f}° sd {:.2f}° n = {}, 95 % interval of the mean {:.2f} … {:.2f}° "
      "(Student){}",
      to_degrees(mean), to_degrees(*sd), n, to_degrees(mean - *uncertainty),
      to_degrees(mean + *uncertainty), left_out);
}

std::string summary_json(const Summary& summary) {
  nlohmann::ordered_json json{
      {"n", 0}, {"mean_deg", nullptr}, {"sd_deg", nullptr}, {"interval_deg", nullptr}};
  if (summary.angle_rad) {
    const auto& [n, mean, sd, uncertainty] = *summary.angle_rad;
    json["n"] = n;
    json["mean_deg"] = rounded_degrees(mean);
    if (sd) json["sd_deg"] = rounded_degrees(*sd);
    if (uncertainty) {
      json["interval_deg"] = {rounded_degrees(mean - *uncertainty),
                              rounded_degrees(mean + *uncertainty)};
    }
  }
  json["flagged"] = summary.flagged;
  json["refused"] = summary.refused;
  json["not_read"] = summary.not_read;
  return json.dump(2) + '\n';
}

}  // namespace repose::cli
