#include "cli/common/picture_options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/input_error.h"
#include "cli/common/option_value.h"
#include "cli/common/output.h"
#include "vision/camera/lens_file.h"

namespace repose::cli {

std::optional<vision::ScaleBar> read_scale_bar(const OptionText& typed, std::string_view fix) {
  if (typed.text.empty()) return std::nullopt;
  const auto numbers = numbers_in<double, 5>(typed.text);
  if (!numbers || !((*numbers)[4] > 0) ||
      std::hypot((*numbers)[2] - (*numbers)[0], (*numbers)[3] - (*numbers)[1]) <
          vision::kShortestBar_px) {
    typed.refuse(fmt::format("two points in pixels, at least {:g} apart, and their distance in "
                             "mm: X1,Y1,X2,Y2,MM",
                             vision::kShortestBar_px),
                 fix);
    return std::nullopt;
  }
  const auto& [x1, y1, x2, y2, length_mm] = *numbers;
  const vision::ScaleBar bar{.line = {{x1, y1}, {x2, y2}}, .length_mm = length_mm};
  auto fault = problem_of(bar);
  if (!fault) return bar;
  fault->where = fmt::format("{} {}", typed.option, typed.text);
  fault->fix = "give the distance in mm.";
  typed.errors.push_back(fault->text());
  return std::nullopt;
}

vision::ScaleOptions read_scale(const ScaleArguments& arguments, std::string_view scale_fix,
                                std::string_view plane, std::vector<std::string>& errors) {
  vision::ScaleOptions scale;
  scale.finds_board = arguments.finds_board;
  scale.scale = read_scale_bar({"--scale", arguments.scale, errors}, scale_fix);
  scale.square_mm =
      read_number_within({"--square-mm", arguments.square_mm, errors}, vision::kSmallestSquare_mm,
                         vision::kLargestSquare_mm, "--square-mm 23.9, the side of a printed one")
          .value_or(scale.square_mm);
  constexpr double kFarthest_mm = 10000;
  scale.board_offset_mm = read_number_within({"--board-behind", arguments.board_behind_mm, errors},
                                             0, kFarthest_mm, "--board-behind 150")
                              .value_or(scale.board_offset_mm);
  scale.lens_file = arguments.camera_file;
  if (!arguments.camera_file.empty()) {
    try {
      scale.lens = vision::read_lens_file(arguments.camera_file);
    } catch (const base::InputError& error) {
      for (const base::Fault& fault : error.faults())
        errors.push_back("--camera-file " + fault.text());
    }
  }
  if (scale.finds_board && scale.scale) {
    errors.emplace_back(
        "--scale: there is --board, too. Rule: one scale. Fix: leave one of them out.");
  }
  for (const auto& [option, text] : {std::pair("--square-mm", &arguments.square_mm),
                                     {"--board-behind", &arguments.board_behind_mm}}) {
    if (text->empty() || scale.finds_board) continue;
    errors.push_back(fmt::format("{}: is for a board in the picture. Fix: add --board.", option));
  }
  if (scale.board_offset_mm > 0 && arguments.camera_file.empty()) {
    errors.push_back(fmt::format(
        "--board-behind: how much smaller a board looks from farther away follows from the focal "
        "length. Rule: it needs --camera-file. Fix: add it, or put the board in the plane of {}.",
        plane));
  }
  return scale;
}

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
  options.definition = typed.definition;
  std::ranges::replace(options.definition, '-', '_');
  options.camera_pitch_rad =
      read_angle({"--pitch-deg", typed.pitch_deg, errors},
                 "give the angle by which the camera looks down, or take a level picture");
  for (const std::string& text : typed.exclude) {
    const auto box = read_box({typed.exclude_option, text, errors});
    if (!box) continue;
    const auto [x, y, width, height] = *box;
    options.excluded.push_back({.x = x, .y = y, .width = width, .height = height});
  }
  const std::array<base::FieldName, 4> names{{{"window", "--window"},
                                              {"definition", "--definition"},
                                              {"excluded box", typed.exclude_option},
                                              {"camera pitch", "--pitch-deg"}}};
  for (const base::Fault& problem : options.problems()) errors.push_back(problem.text(names));
  options.names = typed.fields;
  return options;
}

}  // namespace repose::cli
