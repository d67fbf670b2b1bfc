#pragma once

#include <filesystem>
#include <memory>

#include "vision/picture/picture.h"

namespace repose::vision {

/// Appends pictures of one size to a file of one kind.
class FilmEncoder {
 public:
  FilmEncoder() = default;
  virtual ~FilmEncoder() = default;
  FilmEncoder(const FilmEncoder&) = delete;
  FilmEncoder& operator=(const FilmEncoder&) = delete;
  FilmEncoder(FilmEncoder&&) = delete;
  FilmEncoder& operator=(FilmEncoder&&) = delete;

  /// Both return whether they succeeded.
  virtual bool add(const Picture& picture) = 0;
  virtual bool close() = 0;
};

/// H.264. If the size is odd, the last row or column is left out.
/// @throws base::InputError  "what. Fix: ...": FFmpeg was built without such an encoder.
std::unique_ptr<FilmEncoder> mp4_encoder(const std::filesystem::path& file, double frames_per_s,
                                         int width, int height);

/// 256 colours per picture; loops forever.
std::unique_ptr<FilmEncoder> gif_encoder(const std::filesystem::path& file, double frames_per_s,
                                         int width, int height);

}  // namespace repose::vision
