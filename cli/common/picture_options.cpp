#include "cli/common/picture_options.h"

#include <utility>

#include "cli/common/option_value.h"

namespace repose::cli {

vision::MeasureOptions read_measuring(const TypedMeasuring& typed,
                                      std::vector<std::string>& errors) {
  vision::MeasureOptions options;
  options.method = read_choice<vision::Method>(
                       {"--method", typed.method, errors},
                       {{"auto", vision::Method::automatic}, {"paper", vision::Method::paper}})
                       .value_or(options.method);
  if (const auto window = read_range({"--window", typed.window, errors}, "--window 0.2,0.8")) {
    options.window_from = window->front();
    options.window_to = window->back();
  }
  options.camera_pitch_rad =
      read_angle({"--pitch-deg", typed.pitch_deg, errors},
                 "give the angle by which the camera looks down, or take a level picture");
  for (const std::string& text : typed.exclude) {
    const auto box = read_box({typed.exclude_option, text, errors});
    if (!box) continue;
    const auto [x, y, width, height] = *box;
    options.excluded.push_back({.x = x, .y = y, .width = width, .height = height});
  }
  constexpr OptionName kWindow{.value = "window", .option = "--window"};
  const auto [box, pitch] = measuring_names(typed.exclude_option);
  for (std::string& problem : options.problems()) {
    errors.push_back(naming_options(std::move(problem), std::array{kWindow, box, pitch}));
  }
  return options;
}

std::array<OptionName, 2> measuring_names(const char* exclude_option) {
  return {OptionName{.value = "excluded box", .option = exclude_option},
          OptionName{.value = "camera pitch", .option = "--pitch-deg"}};
}

void name_options(vision::ReposeAngle& angle, std::span<const OptionName> names) {
  angle.reason = naming_options(std::move(angle.reason), names);
  for (vision::Warning& warning : angle.warnings) {
    warning.message = naming_options(std::move(warning.message), names);
  }
  for (vision::Flank* flank : {&angle.left, &angle.right}) {
    flank->reason = naming_options(std::move(flank->reason), names);
  }
}

}  // namespace repose::cli
