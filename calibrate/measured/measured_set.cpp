#include "calibrate/measured/measured_set.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace repose::calibrate {
namespace {

/// More digits than any camera resolves, without conversion noise.
double rounded(double angle_deg) { return std::round(angle_deg * 1e6) / 1e6; }

std::string mean_text(const Summary& mean) {
  const auto& [n, middle, sd, uncertainty] = mean;
  if (!sd || !uncertainty) return fmt::format("{:.2f}° only one heap: no scatter", middle);
  return fmt::format(
      "{:.2f}° sd {:.2f}° n = {}, 95 % interval of the mean {:.2f} … {:.2f}° (Student)", middle,
      *sd, n, middle - *uncertainty, middle + *uncertainty);
}

/// A further mean, after the first, which explains the numbers.
std::string other_text(const char* what, const Summary& mean) {
  const auto& [n, middle, sd, uncertainty] = mean;
  if (!sd || !uncertainty) return fmt::format("\n{}: {:.2f}° n = 1", what, middle);
  return fmt::format("\n{}: {:.2f}° sd {:.2f}° n = {}, 95 % {:.2f} … {:.2f}°", what, middle, *sd, n,
                     middle - *uncertainty, middle + *uncertainty);
}

/// Whether the two are means of different pictures.
bool is_other(const std::optional<Summary>& one, const std::optional<Summary>& other) {
  return one && (!other || one->n != other->n || one->mean != other->mean);
}

/// The mean without pictures that a reader may not want in it, and with those that were left out.
std::string other_means(const PictureSet& set) {
  std::string text;
  if (set.flagged > 0 && !set.ok_deg) {
    text += "\nno picture is ok: all in the mean are flagged";
  } else if (is_other(set.ok_deg, set.heaps_deg)) {
    text += other_text("of those that are ok", *set.ok_deg);
  }
  if (is_other(set.all_deg, set.heaps_deg)) {
    text += other_text("of all that could be measured", *set.all_deg);
  }
  return text;
}

std::string heaps_text(const PictureSet& set) {
  std::string text;
  if (set.within_sd_deg && set.heaps_deg) {
    text += fmt::format(
        "\n{} pictures of {} {}, n counts heaps; those of one heap scatter by sd {:.2f}°",
        set.pictures, set.heaps_deg->n, set.heaps_deg->n == 1 ? "heap" : "heaps",
        *set.within_sd_deg);
    if (set.between_sd_deg) {
      text += fmt::format(", the heaps themselves by sd {:.2f}°", *set.between_sd_deg);
    }
    for (const HeapOfSet& heap : set.heaps) {
      text += fmt::format("\nheap {}: {:.2f} ± {:.2f}° by {} {}", heap.name, heap.angle_deg,
                          heap.within_deg.value_or(0), heap.pictures,
                          heap.pictures == 1 ? "picture" : "pictures");
    }
  }
  if (set.heaps_deg && set.heaps_deg->n > 1 && set.camera_deg >= .005) {
    text +=
        fmt::format("\nall share ± {:.2f}° by the camera's pitch, which more pictures do not lower",
                    set.camera_deg);
  }
  return text;
}

std::string remarks_on(const MeasuredSet& summary) {
  const PictureSet& set = summary.pictures;
  std::string text;
  if (set.flagged > 0) text += fmt::format("\n{} of these flagged: look at them", set.flagged);
  std::vector<std::string> left_out;
  for (const NamedOutlier& outlier : summary.outliers) {
    const std::string what = fmt::format("{} {:.2f}°", outlier.file, outlier.angle_deg);
    if (outlier.is_counted) {
      text += fmt::format("\nan outlier, counted: {}", what);
    } else {
      left_out.push_back("the outlier " + what);
    }
  }
  if (set.refused > 0) left_out.push_back(fmt::format("{} refused", set.refused));
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

/// The angle of a scan differs from that of pictures.
std::string scans_text(const MeasuredSet& summary) {
  if (summary.scans == 0) return "";
  std::string text;
  if (summary.scans < summary.pictures.pictures) {
    text = fmt::format(
        "\n{} of these are scans, with the angle of their slices; pictures and "
        "particles show that of silhouettes: do not mix them",
        summary.scans);
  }
  if (summary.silhouettes.heaps_deg) {
    text += other_text("of the scans in silhouette, as compare and studies take them",
                       *summary.silhouettes.heaps_deg);
  }
  return text;
}

}  // namespace

MeasuredSet measured_set(const std::vector<MeasuredPicture>& pictures) {
  MeasuredSet summary;
  std::vector<SetPicture> set;
  std::vector<const MeasuredPicture*> from;
  std::vector<SetPicture> silhouettes;
  for (const MeasuredPicture& picture : pictures) {
    if (is_of_series(picture)) continue;
    if (!picture.copy_of.empty()) {
      ++summary.copies;
      continue;
    }
    if (picture.outcome == Outcome::measured) {
      set.push_back(set_picture_of(picture.angle, picture.heap));
      from.push_back(&picture);
      if (!picture.scan || !picture.silhouettes) continue;
      summary.scans += picture.angle.angle_rad ? 1 : 0;
      silhouettes.push_back(set_picture_of(picture.silhouettes->angle, picture.heap));
    } else {
      ++summary.not_read;
    }
  }
  summary.pictures = set_of_pictures(set);
  if (!silhouettes.empty()) summary.silhouettes = set_of_pictures(silhouettes);
  for (const OutlyingPicture& outlier : summary.pictures.outliers) {
    summary.outliers.push_back({.file = from[outlier.place]->file,
                                .angle_deg = *set[outlier.place].angle_deg,
                                .score = outlier.score,
                                .is_counted = outlier.is_counted});
  }
  return summary;
}

void name_outliers(std::vector<MeasuredPicture>& pictures) {
  const MeasuredSet summary = measured_set(pictures);
  for (std::size_t k = 0; k < summary.outliers.size(); ++k) {
    const auto named = std::ranges::find_if(pictures, [&](const MeasuredPicture& picture) {
      return picture.file == summary.outliers[k].file && !is_of_series(picture);
    });
    named->angle.warnings.push_back(
        {"outlier",
         text_of(summary.pictures.outliers[k], summary.pictures, summary.outliers[k].angle_deg)});
  }
}

std::string text_of_set(const MeasuredSet& summary) {
  const PictureSet& set = summary.pictures;
  const std::string remarks = heaps_text(set) + remarks_on(summary) + other_means(set);
  if (!set.heaps_deg) return "no mean: no picture could be measured" + remarks;
  return "mean " + mean_text(*set.heaps_deg) + remarks + scans_text(summary);
}

namespace {

nlohmann::ordered_json mean_json(const std::optional<Summary>& of) {
  nlohmann::ordered_json json{
      {"n", 0}, {"mean_deg", nullptr}, {"sd_deg", nullptr}, {"interval_deg", nullptr}};
  if (!of) return json;
  const auto& [n, mean, sd, uncertainty] = *of;
  json["n"] = n;
  json["mean_deg"] = rounded(mean);
  if (sd) json["sd_deg"] = rounded(*sd);
  if (uncertainty) {
    json["interval_deg"] = {rounded(mean - *uncertainty), rounded(mean + *uncertainty)};
  }
  return json;
}

nlohmann::ordered_json heap_json(const HeapOfSet& heap) {
  nlohmann::ordered_json json{{"name", heap.name},
                              {"pictures", heap.pictures},
                              {"angle_deg", rounded(heap.angle_deg)},
                              {"sd_deg", nullptr},
                              {"interval_deg", nullptr}};
  if (heap.sd_deg) json["sd_deg"] = rounded(*heap.sd_deg);
  if (const auto half = heap.within_deg) {
    json["interval_deg"] = {rounded(heap.angle_deg - *half), rounded(heap.angle_deg + *half)};
  }
  return json;
}

}  // namespace

std::string set_json(const MeasuredSet& summary, const vision::MeasureOptions& options) {
  const PictureSet& set = summary.pictures;
  nlohmann::ordered_json json = mean_json(set.heaps_deg);
  const std::string definition = options.named_definition();
  json["definition"] = nullptr;
  if (!definition.empty()) json["definition"] = definition;
  json["pictures"] = set.pictures;
  json["within_heaps_sd_deg"] = nullptr;
  if (set.within_sd_deg) json["within_heaps_sd_deg"] = rounded(*set.within_sd_deg);
  json["between_heaps_sd_deg"] = nullptr;
  if (set.between_sd_deg) json["between_heaps_sd_deg"] = rounded(*set.between_sd_deg);
  json["heaps"] = nlohmann::ordered_json::array();
  for (const HeapOfSet& heap : set.heaps) json["heaps"].push_back(heap_json(heap));
  json["camera_deg"] = nullptr;
  if (set.heaps_deg) json["camera_deg"] = rounded(set.camera_deg);
  json["ok"] = mean_json(set.ok_deg);
  json["all"] = mean_json(set.all_deg);
  json["scans"] = summary.scans;
  json["silhouettes"] = mean_json(summary.silhouettes.heaps_deg);
  json["outliers"] = nlohmann::ordered_json::array();
  for (const NamedOutlier& outlier : summary.outliers) {
    json["outliers"].push_back({{"file", outlier.file},
                                {"angle_deg", rounded(outlier.angle_deg)},
                                {"score", outlier.score},
                                {"counted", outlier.is_counted}});
  }
  json["flagged"] = set.flagged;
  json["refused"] = set.refused;
  json["not_read"] = summary.not_read;
  json["copies"] = summary.copies;
  // File names need not be UTF-8, but JSON must be.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace repose::calibrate
