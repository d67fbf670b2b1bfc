#include <cstdint>
#include <iostream>

#include <repose/vision/repose_angle.h>

/// A white picture holds no heap: the library must say so and give no number.
int main() {
  constexpr int kWidth = 320;
  constexpr int kHeight = 240;
  const repose::vision::Picture blank{
      .width = kWidth,
      .height = kHeight,
      .bgr = std::vector<std::uint8_t>(std::size_t{kWidth} * kHeight * 3, 255)};

  const repose::vision::ReposeAngle result = repose::vision::measure_repose_angle(blank);
  std::cout << "blank picture: " << result.reason << '\n';
  const bool refused = result.status == repose::vision::MeasureStatus::refused;
  return refused && !result.angle_rad && !result.reason.empty() ? 0 : 1;
}
