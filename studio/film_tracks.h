#pragma once

#include <list>
#include <memory>
#include <mutex>
#include <string>

#include "studio/json_answer.h"
#include "studio/picture_folder.h"

namespace repose::studio {

/// Films of drops, rolls and tilts: looked at frame by frame, and tracked as `repose track` tracks
/// them. Some of what was found is kept, for its pictures and its readings. Several threads may ask
/// at once.
/// All of it throws base::InputError for a name or a number that is not there.
class FilmTracks {
 public:
  using Bytes = PictureFolder::Bytes;

  explicit FilmTracks(const PictureFolder& pictures) : pictures_(pictures) {}

  /// `width`, `height`, and `times_s` of the frames that can be looked at.
  Json film(const std::string& file);
  /// A JPEG of one of them, reduced.
  Bytes frame(const std::string& file, int number);

  /// @param asked  `experiment` (drop, roll or tilt), `scale` and `board` as told_json.h has them,
  ///   `released_mm` of a roll
  /// @returns  `number` of what was found, `tracked` as `repose track --json` has it, `command`
  Json track(const std::string& file, const Json& asked);
  /// A JPEG of the strobe picture with what was tracked, as `repose track --overlay` draws it.
  Bytes overlay(int number);

  /// What a study's sheet is given of a film.
  struct Readings {
    std::string experiment;
    std::string csv;  ///< as `repose track --csv` has it
  };
  /// @param asked  of a drop, the numbers of the `bounces` that count
  Readings readings(int number, const Json& asked);

 private:
  struct Frames;
  struct Tracked;

  std::shared_ptr<const Frames> frames_of(const std::string& file);
  std::shared_ptr<const Tracked> tracked(int number);

  const PictureFolder& pictures_;
  std::mutex decoding_;
  std::mutex mutex_;
  std::list<std::shared_ptr<const Frames>> frames_;    ///< looked at last, the latest first
  std::list<std::shared_ptr<const Tracked>> tracked_;  ///< likewise
  int last_number_ = 0;
};

}  // namespace repose::studio
