#pragma once

#include <filesystem>
#include <memory>

#include "vision/picture/picture.h"

namespace repose::base {
class TemporaryFile;
}  // namespace repose::base

namespace repose::vision {

class FilmEncoder;

/// Writes pictures to an MP4 (H.264) or GIF file, atomically: an earlier file is kept until
/// close().
///
/// The same pictures give the same bytes with the same version of the encoder, on processors with
/// AVX2; older ones round some sums differently.
class FilmWriter {
 public:
  /// The format is chosen by the name's ending.
  /// @throws base::InputError  another ending, or the file cannot be written.
  FilmWriter(std::filesystem::path file, double frames_per_s);
  /// Without close(), no file is left behind.
  ~FilmWriter();
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;
  FilmWriter(FilmWriter&&) = delete;
  FilmWriter& operator=(FilmWriter&&) = delete;

  /// All pictures have the size of the first; an MP4 loses the last row or column of an odd one.
  /// @throws base::InputError  the picture cannot be written.
  void add(const Picture& picture);

  /// Moves the film to its final place.
  /// @throws base::InputError  no picture was added, or it cannot be written.
  void close();

 private:
  void open_encoder();

  std::filesystem::path file_;
  std::unique_ptr<base::TemporaryFile> part_;  ///< from the first picture on
  double frames_per_s_;
  std::unique_ptr<FilmEncoder> encoder_;
  int width_ = 0;
  int height_ = 0;
};

}  // namespace repose::vision
