#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <string>

#include "studio/json_answer.h"
#include "studio/picture_folder.h"

namespace repose::studio {

/// Films of drops, rolls and tilts: shown frame by frame, and tracked like `repose track`. Some
/// results are kept for their pictures and readings. Thread-safe. All members throw
/// base::InputError for an unknown name or number.
class FilmTracks {
 public:
  using Bytes = PictureFolder::Bytes;

  explicit FilmTracks(const PictureFolder& pictures) : pictures_(pictures) {}

  /// `width`, `height`, and `times_s` of the available frames.
  Json film(const std::string& file);
  /// A JPEG of one of them, reduced.
  Bytes frame(const std::string& file, int number);

  /// @param asked  `experiment` (drop, roll or tilt), `scale` and `board` as in told_json.h,
  ///   `released_mm` for a roll
  /// @returns  `number` of the result, `tracked` as in `repose track --json`, `command`
  Json track(const std::string& file, const Json& asked);
  /// A JPEG of the strobe picture with the track, as drawn by `repose track --overlay`.
  Bytes overlay(int number);

  /// A film's readings for a study's sheet.
  struct Readings {
    std::string experiment;
    std::string csv;  ///< as written by `repose track --csv`
  };
  /// @param asked  for a drop, the numbers of the `bounces` to use
  Readings readings(int number, const Json& asked);

 private:
  struct Frames;
  struct Tracked;

  std::shared_ptr<const Frames> frames_of(const std::string& file);
  std::shared_ptr<const Tracked> tracked(int number);

  const PictureFolder& pictures_;
  std::mutex decoding_;
  std::mutex mutex_;
  std::list<std::shared_ptr<const Frames>> frames_;    ///< most recently used first
  std::list<std::shared_ptr<const Tracked>> tracked_;  ///< likewise
  int last_number_ = 0;
};

}  // namespace repose::studio
