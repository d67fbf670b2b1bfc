#include "vision/files/heap_file.h"

#include <utility>

#include "vision/film/film_angle.h"
#include "vision/scan/scan_file.h"

namespace repose::vision {

HeapInFile measure_heap_file(const std::filesystem::path& file, const PictureSettings& given) {
  if (has_scan_ending(file)) {
    HeapInFile measured;
    measured.scan = measure_scan(read_scan(file), {.unit_mm = {},
                                                   .ground = {},
                                                   .window_from = given.measuring.window_from,
                                                   .window_to = given.measuring.window_to,
                                                   .names = given.measuring.names});
    measured.heap.angle = measured.scan->angle;
    return measured;
  }
  HeapInFile measured;
  measured.told = with_saved_hints(given, file);
  const auto& [measuring, scale] = measured.told;
  measured.is_film = has_film_ending(file);
  if (measured.is_film) {
    FilmAngle film = measure_film({file, {}, {}, measuring.hints.turn_deg}, measuring, scale);
    measured.heap = std::move(film.heap);
    measured.picture = std::move(film.picture);
  } else {
    measured.picture = turned(read_picture(file), measuring.hints.turn_deg);
    measured.heap = measure_sized_heap(measured.picture, measuring, scale);
  }
  return measured;
}

}  // namespace repose::vision
