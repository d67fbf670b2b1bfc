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
  const auto [measuring, scale] = with_saved_hints(given, file);
  if (has_film_ending(file)) {
    FilmAngle film = measure_film(file, measuring, scale);
    return {.heap = std::move(film.heap), .picture = std::move(film.picture), .is_film = true};
  }
  HeapInFile measured{.heap = {}, .picture = read_picture(file)};
  measured.heap = measure_sized_heap(measured.picture, measuring, scale);
  return measured;
}

}  // namespace repose::vision
