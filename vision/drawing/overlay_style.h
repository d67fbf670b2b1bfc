#pragma once

#include <optional>
#include <string>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "base/units.h"

/// Colours and words that marks and caption share.
namespace repose::vision {

/// Blue, green, red. Okabe and Ito's set, which colour-blind people tell apart.
inline const cv::Scalar kOrange{0, 159, 230};
inline const cv::Scalar kSkyBlue{233, 180, 86};
inline const cv::Scalar kYellow{66, 228, 240};
inline const cv::Scalar kGreen{115, 158, 0};
inline const cv::Scalar kVermilion{0, 94, 213};
inline const cv::Scalar kWhite{255, 255, 255};
inline const cv::Scalar kGrey{190, 190, 190};
inline const cv::Scalar kDark{28, 24, 22};

/// "23.4° ± 0.5°"; a second decimal when the first one of the interval would say nothing.
inline std::string angle_text(double angle_rad, std::optional<double> uncertainty_rad) {
  if (!uncertainty_rad) return fmt::format("{:.1f}°", to_degrees(angle_rad));
  const double uncertainty_deg = to_degrees(*uncertainty_rad);
  const int decimals = uncertainty_deg < 0.1 ? 2 : 1;
  return fmt::format("{:.{}f}° ± {:.{}f}°", to_degrees(angle_rad), decimals, uncertainty_deg,
                     decimals);
}

}  // namespace repose::vision
