#include "cli/common/picture_options.h"

#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "cli/common/number.h"

namespace repose::cli {
namespace {

constexpr double kLargestPitchDeg = 30;  // from higher up the side view is lost

}  // namespace

void read_method(const std::string& text, vision::MeasureOptions& options, ErrorList& errors) {
  if (text.empty() || text == "auto") return;
  if (text == "paper") {
    options.method = vision::Method::paper;
    return;
  }
  errors.push_back(fmt::format("--method {}: there is no such method. Fix: auto or paper.", text));
}

void read_window(const std::string& text, vision::MeasureOptions& options, ErrorList& errors) {
  if (text.empty()) return;
  const auto window = numbers_in<double, 2>(text);
  if (!window) {
    errors.push_back(fmt::format(
        "--window {}: must be two numbers with a comma between them. Fix: --window 0.2,0.8.",
        text));
    return;
  }
  options.window_from = window->front();
  options.window_to = window->back();
  for (std::string& problem : options.problems()) errors.push_back(std::move(problem));
}

void read_pitch(const std::string& text, vision::MeasureOptions& options, ErrorList& errors) {
  if (text.empty()) return;
  const auto pitch_deg = number_in<double>(text);
  if (!pitch_deg || std::abs(*pitch_deg) > kLargestPitchDeg) {
    errors.push_back(
        fmt::format("--pitch-deg {}: must be a number of degrees between -{} and {}. Fix: give "
                    "the angle by which the camera looks down, or take a level picture.",
                    text, kLargestPitchDeg, kLargestPitchDeg));
    return;
  }
  options.camera_pitch_rad = *pitch_deg * std::numbers::pi / 180;
}

void read_boxes(const std::string& option, const std::vector<std::string>& texts,
                vision::MeasureOptions& options, ErrorList& errors) {
  for (const std::string& text : texts) {
    const auto box = numbers_in<int, 4>(text);
    if (!box) {
      errors.push_back(
          fmt::format("{0} {1}: must be four whole numbers X,Y,W,H in pixels. Fix: {0} 0,0,200,80 "
                      "leaves out 200 x 80 pixels in the top left corner.",
                      option, text));
      continue;
    }
    const auto [x, y, width, height] = *box;
    if (x < 0 || y < 0 || width < 1 || height < 1) {
      errors.push_back(
          fmt::format("{} {}: X and Y must be at least 0, W and H at least 1. Fix: count from the "
                      "picture's top left corner.",
                      option, text));
      continue;
    }
    options.excluded.push_back({.x = x, .y = y, .width = width, .height = height});
  }
}

}  // namespace repose::cli
