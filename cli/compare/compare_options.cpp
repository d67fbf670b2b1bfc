#include "cli/compare/compare_options.h"

#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "cli/common/number.h"
#include "cli/common/output_places.h"
#include "cli/common/picture_options.h"

namespace repose::cli {
namespace {

using vision::PictureScale;

/// "A,B", or "A" for both.
std::array<std::string, 2> for_each_picture(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) return {text, text};
  return {text.substr(0, comma), text.substr(comma + 1)};
}

std::optional<double> positive_mm(const std::string& text) {
  const auto number = number_in<double>(text);
  return number && *number > 0 ? number : std::nullopt;
}

void read_scale(const char* option, const std::string& text, PictureScale::From from,
                ComparePlan& plan) {
  if (text.empty()) return;
  const std::array<std::string, 2> texts = for_each_picture(text);
  for (const std::size_t i : {0, 1}) {
    const auto mm = positive_mm(texts[i]);
    if (!mm) {
      plan.errors.push_back(fmt::format(
          "{0} {1}: must be one number of mm, more than 0, or one for each picture with a comma "
          "between them. Fix: {0} 0.25 or {0} 0.25,0.4.",
          option, text));
      return;
    }
    plan.comparing.scale[i] = PictureScale{.from = from, .length_m = *mm / 1000};
  }
}

void read_scales(const CompareArguments& arguments, ComparePlan& plan) {
  if (!arguments.mm_per_px.empty() && !arguments.base_mm.empty()) {
    plan.errors.emplace_back(
        "--mm-per-px and --base-mm both give the scale. Fix: give the one you know better.");
  }
  read_scale("--mm-per-px", arguments.mm_per_px, PictureScale::From::pixel, plan);
  read_scale("--base-mm", arguments.base_mm, PictureScale::From::base, plan);
}

void read_grain(const CompareArguments& arguments, ComparePlan& plan) {
  if (arguments.grain_mm.empty()) return;
  const auto mm = positive_mm(arguments.grain_mm);
  if (!mm) {
    plan.errors.push_back(
        fmt::format("--grain-mm {}: must be a number of mm, more than 0. Fix: give the grains' "
                    "mean diameter.",
                    arguments.grain_mm));
    return;
  }
  if (arguments.mm_per_px.empty() && arguments.base_mm.empty()) {
    plan.errors.push_back(
        fmt::format("--grain-mm {}: lengths in grains need a scale. Fix: add --mm-per-px or "
                    "--base-mm.",
                    arguments.grain_mm));
  }
  plan.grain_m = *mm / 1000;
}

void read_margin(const std::string& text, ComparePlan& plan) {
  if (text.empty()) return;
  const auto margin_deg = number_in<double>(text);
  if (!margin_deg) {
    plan.errors.push_back(
        fmt::format("--margin-deg {}: must be a number of degrees. Fix: --margin-deg 2.", text));
    return;
  }
  plan.comparing.margin_rad = *margin_deg * std::numbers::pi / 180;
}

void read_measuring(const CompareArguments& arguments, ComparePlan& plan) {
  vision::MeasureOptions both;
  read_method(arguments.method, both, plan.errors);
  read_window(arguments.window, both, plan.errors);
  plan.measuring = {both, both};
  const std::array<std::string, 2> pitches = for_each_picture(arguments.pitch_deg);
  read_pitch(pitches[0], plan.measuring[0], plan.errors);
  if (pitches[1] == pitches[0]) {  // one error is enough
    plan.measuring[1].camera_pitch_rad = plan.measuring[0].camera_pitch_rad;
  } else {
    read_pitch(pitches[1], plan.measuring[1], plan.errors);
  }
  read_boxes("--exclude-first", arguments.exclude_first, plan.measuring[0], plan.errors);
  read_boxes("--exclude-second", arguments.exclude_second, plan.measuring[1], plan.errors);
}

void read_overlay(const std::string& file, ComparePlan& plan) {
  plan.overlay_file = file;
  if (file.empty()) return;
  const std::string ending = std::filesystem::path(file).extension().string();
  for (const char* known : {".png", ".PNG", ".jpg", ".JPG", ".jpeg", ".JPEG"}) {
    if (ending == known) return;
  }
  plan.errors.push_back(
      fmt::format("--overlay {}: its ending must say what it is. Fix: .png or .jpg.", file));
}

}  // namespace

ComparePlan plan_compare(const CompareArguments& arguments) {
  ComparePlan plan;
  plan.pictures.assign(arguments.pictures.begin(), arguments.pictures.end());
  read_scales(arguments, plan);
  read_grain(arguments, plan);
  read_margin(arguments.margin_deg, plan);
  for (std::string& problem : plan.comparing.problems()) plan.errors.push_back(std::move(problem));
  read_measuring(arguments, plan);
  read_overlay(arguments.overlay_file, plan);
  plan.json_file = arguments.json_file;
  check_output_places({{"--overlay", plan.overlay_file}, {"--json", plan.json_file}}, plan.pictures,
                      plan.errors);
  return plan;
}

}  // namespace repose::cli
