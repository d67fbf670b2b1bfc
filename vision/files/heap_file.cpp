#include "vision/files/heap_file.h"

#include <utility>

#include "vision/film/film_angle.h"

namespace repose::vision {

HeapInFile measure_heap_file(const std::filesystem::path& file, const PictureSettings& given) {
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
