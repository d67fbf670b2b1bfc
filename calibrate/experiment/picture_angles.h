#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "calibrate/statistics/summary.h"
#include "vision/measure/repose_angle.h"

/// The angle of several pictures: of one simulated heap from several sides, or of the heaps of a
/// bench. One rule for both, since they are compared with each other.
namespace repose::calibrate {

/// What one picture gave.
struct PictureAngle {
  vision::MeasureStatus status = vision::MeasureStatus::refused;
  std::optional<double> angle_rad;
  /// By the other definitions of base/angle_definition.h, by name; those that it allows.
  std::map<std::string, double> other_rad = {};
};

PictureAngle picture_angle_of(const vision::ReposeAngle& measured);

/// By a definition; empty: by the usual one. None of a picture that is refused.
std::optional<double> angle_by(const PictureAngle& picture, const std::string& definition);

/// Whether a picture's angle counts towards a mean: every one that could be measured does, flagged
/// ones too. A flag says that a heap looks low or hollow from there, or that its interval is wide;
/// it does not make the number wrong, and to leave out just those moves the mean: of six simulated
/// heaps seen from many sides, the views without a flag read 1.3 degrees less than all. Their
/// number is said wherever there is a mean, and each keeps its own, wider interval.
bool counts_in_mean(vision::MeasureStatus status);
/// The same, of a status by its name in JSON: "flagged".
bool counts_in_mean(std::string_view status);

struct PictureMean {
  std::optional<Summary> angle_deg;  ///< none when no picture counts
  int flagged = 0;                   ///< of those that count
  int refused = 0;                   ///< or without an angle by the definition
};

PictureMean mean_of_pictures(std::span<const PictureAngle> pictures,
                             const std::string& definition = {});

}  // namespace repose::calibrate
