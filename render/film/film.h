#pragma once

#include <filesystem>
#include <memory>

#include "vision/picture/picture.h"

namespace repose::base {
class PartFile;
}  // namespace repose::base

namespace repose::render {

/// Pictures one after the other in an MP4 (H.264) or GIF file, which is there whole or not at all:
/// until then the earlier one is.
///
/// The same pictures give the same bytes in a program's first film. In later ones an MP4 whose
/// width is no multiple of 128 depends on what was in memory before: so the encoder (x264) was seen
/// to do.
class Film {
 public:
  /// By the name's ending.
  /// @throws std::invalid_argument  another ending, or a place that cannot be written.
  Film(std::filesystem::path file, double frames_per_s);
  /// Without close(), nothing is left behind.
  ~Film();
  Film(const Film&) = delete;
  Film& operator=(const Film&) = delete;
  Film(Film&&) = delete;
  Film& operator=(Film&&) = delete;

  /// All pictures have the size of the first; an MP4 loses the last row or column of an odd one.
  /// @throws std::invalid_argument  the picture cannot be written.
  void add(const vision::Picture& picture);

  /// Puts the film in its place.
  /// @throws std::invalid_argument  no picture was added, or it cannot be written.
  void close();

 private:
  class Writer;
  class Mp4Writer;
  class GifWriter;
  void open_writer();

  std::filesystem::path file_;
  std::unique_ptr<base::PartFile> part_;  ///< from the first picture on
  double frames_per_s_;
  std::unique_ptr<Writer> writer_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace repose::render
