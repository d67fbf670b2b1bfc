#include "vision/camera/lens_verdict.h"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/units.h"

namespace repose::vision {
namespace {

constexpr double kLeastTurn_rad = 15 * kDegree;  // between two of the boards
constexpr double kLeastCoverage = 0.3;           // of the picture's area
constexpr double kGoodCoverage = 0.5;
constexpr double kLargestError = 0.0006;  // of the picture's longest side ...
constexpr double kLargestError_px = 1;    // ... but of small ones no less than this
constexpr double kUncertainFocal = 0.03;  // half-width / value
constexpr int kGoodNumber = 8;            // of pictures

std::string worst_of(const std::vector<BoardPicture>& pictures,
                     const std::vector<FittedPicture>& fitted_pictures) {
  std::size_t worst = 0;
  for (std::size_t i = 0; i < fitted_pictures.size(); ++i) {
    if (fitted_pictures[i].error_px.value_or(0) > fitted_pictures[worst].error_px.value_or(0)) {
      worst = i;
    }
  }
  return fmt::format("{} ({:.2f} px)", pictures[worst].file,
                     fitted_pictures[worst].error_px.value_or(0));
}

double largest_error_px(const Lens& lens) {
  return std::max(kLargestError_px, kLargestError * std::max(lens.width, lens.height));
}

}  // namespace

std::string sizes_differ(const std::vector<BoardPicture>& pictures,
                         const std::vector<std::size_t>& used) {
  std::map<std::pair<int, int>, std::vector<std::string>> files;
  for (const std::size_t place : used) {
    files[{pictures[place].width, pictures[place].height}].push_back(pictures[place].file);
  }
  if (files.size() < 2) return {};
  std::vector<std::string> parts;
  for (const auto& [size, names] : files) {
    parts.push_back(fmt::format("{} x {}: {}", size.first, size.second, fmt::join(names, ", ")));
  }
  return fmt::format(
      "the pictures have different sizes ({}). Rule: one camera, one zoom, all upright or all on "
      "their side. Fix: leave out those of another size.",
      fmt::join(parts, "; "));
}

std::vector<std::string> reasons_against(const LensFit& fit,
                                         const std::vector<BoardPicture>& pictures) {
  std::vector<std::string> reasons;
  if (*fit.turned_rad < kLeastTurn_rad) {
    reasons.push_back(fmt::format(
        "all boards face the same way, within {:.0f} degrees, which does not tell how far away "
        "they are. Rule: at least {:.0f} degrees between two of them. Fix: tilt the board, or walk "
        "around it, by 20 to 40 degrees to each side, up and down.",
        *fit.turned_rad / kDegree, kLeastTurn_rad / kDegree));
  }
  if (*fit.coverage < kLeastCoverage) {
    reasons.push_back(fmt::format(
        "the boards cover only {:.0f} % of the picture. Rule: at least {:.0f} %. Fix: go closer, "
        "and take the board in every corner of the picture.",
        100 * *fit.coverage, 100 * kLeastCoverage));
  }
  if (*fit.error_px > largest_error_px(fit.lens)) {
    reasons.push_back(fmt::format(
        "the corners lie {:.2f} px from where any lens would have them, most in {}. Rule: at most "
        "{:.2f} px. Fix: keep the board flat and still, the zoom and focus as they are, and leave "
        "out blurred pictures.",
        *fit.error_px, worst_of(pictures, fit.pictures), largest_error_px(fit.lens)));
  }
  const LensNumber& focal = fit.lens.focal_px;
  // Written so that NaN fails.
  if (reasons.empty() && !(focal.uncertainty <= kUncertainFocal * focal.value)) {
    reasons.push_back(fmt::format(
        "the focal length remains uncertain: {:.0f} ± {:.0f} px. Rule: ± {:.0f} % at most. Fix: "
        "take more pictures, with the board tilted by 20 to 40 degrees and filling the picture.",
        focal.value, focal.uncertainty, 100 * kUncertainFocal));
  }
  return reasons;
}

void warn_of_lens(LensFit& fit, const std::vector<BoardPicture>& pictures) {
  const auto add = [&](const char* code, std::string message) {
    fit.warnings.push_back({code, std::move(message)});
    fit.status = MeasureStatus::flagged;
  };
  if (*fit.coverage < kGoodCoverage) {
    add("little_covered",
        fmt::format("The boards cover {:.0f} % of the picture: distortion elsewhere is a guess. "
                    "Take the board in every corner too.",
                    100 * *fit.coverage));
  }
  const auto used = std::count_if(fit.pictures.begin(), fit.pictures.end(),
                                  [](const FittedPicture& picture) { return picture.is_used; });
  if (used < kGoodNumber) {
    add("few_pictures",
        fmt::format("Only {} pictures: uncertainties are themselves uncertain. Ten are better.",
                    used));
  }
  if (*fit.error_px > largest_error_px(fit.lens) / 2) {
    add("large_error",
        fmt::format("The corners lie {:.2f} px from the fit, most in {}: is the board flat?",
                    *fit.error_px, worst_of(pictures, fit.pictures)));
  }
}

}  // namespace repose::vision
