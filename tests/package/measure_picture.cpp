#include <iostream>

#include <repose/measure.h>

int main(int, char* arguments[]) {
  const repose::HeapInFile seen = repose::measure_heap_file(arguments[1]);
  const repose::ReposeAngle& angle = seen.heap.angle;
  if (angle.status == repose::MeasureStatus::refused) {
    std::cerr << angle.reason << '\n';
    return 1;
  }
  std::cout << repose::to_degrees(*angle.angle_rad) << " degrees\n";
  repose::write_picture("overlay.png", repose::draw_overlay(seen.picture, angle, {}));
}
