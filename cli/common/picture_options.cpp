#include "cli/common/picture_options.h"

#include <array>

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
  const std::array<base::FieldName, 3> names{{{"window", "--window"},
                                              {"excluded box", typed.exclude_option},
                                              {"camera pitch", "--pitch-deg"}}};
  for (const base::Fault& problem : options.problems()) errors.push_back(problem.text(names));
  options.names = typed.fields;
  return options;
}

}  // namespace repose::cli
