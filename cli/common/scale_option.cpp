#include "cli/common/scale_option.h"

#include <cmath>

#include <fmt/format.h>

#include "cli/common/number.h"

namespace repose::cli {

std::optional<vision::ScaleBar> read_scale_bar(const Typed& typed, std::string_view fix) {
  if (typed.text.empty()) return std::nullopt;
  const auto numbers = numbers_in<double, 5>(typed.text);
  constexpr double kLeast_px = 10;
  if (!numbers || !((*numbers)[4] > 0) ||
      std::hypot((*numbers)[2] - (*numbers)[0], (*numbers)[3] - (*numbers)[1]) < kLeast_px) {
    typed.refuse(fmt::format("two points in pixels, at least {:g} apart, and their distance in "
                             "mm: X1,Y1,X2,Y2,MM",
                             kLeast_px),
                 fix);
    return std::nullopt;
  }
  const auto& [x1, y1, x2, y2, length_mm] = *numbers;
  return vision::ScaleBar{.line = {{x1, y1}, {x2, y2}}, .length_mm = length_mm};
}

}  // namespace repose::cli
