#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include <opencv2/core.hpp>

#include "vision/camera/lens_correction.h"
#include "vision/film/film_file.h"

/// Films, decoded frame by frame in order, never by seeking.

namespace repose::vision {

/// A frame of a film stored as a picture file.
struct FrameFile {
  std::filesystem::path file;
  std::int64_t place = 0;  ///< in the film, from 0; missing frames leave a gap
};

/// The frames in a folder, by the numbers in their names: frame_9.png comes before frame_10.png.
/// Hidden files and those without a picture's ending are ignored. If all numbers are a multiple of
/// a step apart, such as every tenth frame, one step is one place.
/// @throws base::InputError  "FOLDER: what. Rule: ... Fix: ...": no pictures, names without a
///   number or that differ in more than the number, or the same number twice.
std::vector<FrameFile> frame_files(const std::filesystem::path& folder);

struct FilmFrame {
  cv::Mat bgr;        ///< upright; its memory is reused for the next frame
  double time_s = 0;  ///< by the film's own time stamps, from the first frame
};

/// Reads MP4, MOV, AVI, MKV, WebM and GIF, and folders of numbered pictures.
class FilmReader {
 public:
  /// @throws base::InputError  "FILE: what. Fix: ...": missing, empty, not a film, damaged, or with
  /// too many pixels; for a folder, also as frame_files(), and without a frame rate.
  /// @param times_s  of its frames, as found by a survey; empty: its own time stamps
  explicit FilmReader(const FilmFile& file, std::vector<double> times_s = {});
  ~FilmReader();
  FilmReader(const FilmReader&) = delete;
  FilmReader& operator=(const FilmReader&) = delete;
  FilmReader(FilmReader&&) = delete;
  FilmReader& operator=(FilmReader&&) = delete;

  /// False at the end, or when nothing more can be decoded.
  /// @throws base::InputError  a frame has a different size than the first, or the camera's lens is
  ///   for pictures with a different aspect ratio.
  bool next(FilmFrame& frame);
  /// As next(), without the picture, which takes most of the time.
  bool skip(FilmFrame& frame);

  /// The number of frames that the file claims, which need not be true; 0 if it claims none.
  int claimed_frames() const;
  /// Unit to which its time stamps are rounded; 0 if they are not.
  double time_unit_s() const;

 private:
  class Source;
  class VideoSource;
  class FolderSource;

  bool advance(FilmFrame& frame, bool is_skipped);

  std::filesystem::path file_;
  std::vector<double> times_s_;
  std::size_t number_ = 0;  ///< of the next frame
  std::unique_ptr<Source> source_;
  cv::Size size_;
  int turn_deg_ = 0;
  std::optional<Lens> lens_;
  std::optional<LensCorrection> correction_;  ///< from the first frame on
  cv::Mat seen_;                              ///< a frame before turning or correction
};

}  // namespace repose::vision
