#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "calibrate/experiment/scan_angle.h"
#include "calibrate/particles/positions_angle.h"
#include "calibrate/report/measure_report.h"
#include "vision/camera/sized_heap.h"
#include "vision/drawing/overlay.h"
#include "vision/film/film_angle.h"
#include "vision/hints/hint_file.h"
#include "vision/hints/proposal.h"
#include "vision/measure/repose_angle.h"
#include "vision/scan/scanned_heap.h"

/// Measures a file of any kind that shows a heap, for the command line and the studio.
namespace repose::calibrate {

enum class Outcome {
  measured,        ///< or refused: see `angle`
  bad_input,       ///< could not be read, or a box lies outside it: see `error`
  internal_error,  ///< our own error
};

/// Origin of a picture that was extracted from a film.
struct FilmedPicture {
  vision::FilmFacts film;
  std::optional<vision::FilmStretch> stretch;  ///< std::nullopt: the heap is never at rest in it
  std::optional<double> time_s;  ///< of a single frame; std::nullopt: the heap at rest
};

struct MeasuredPicture {
  std::string file;
  std::optional<FilmedPicture> filmed;  ///< std::nullopt: the file is a picture, or of particles
  /// std::nullopt: the file is a picture or a film. Without the first view's picture and edges.
  std::optional<MeasuredPositions> positions;
  Outcome outcome = Outcome::measured;
  std::string error;
  vision::ReposeAngle angle;     ///< without the outline and edge points, which are large
  vision::PictureSettings told;  ///< including the picture's saved hints, without the mask's pixels
  std::optional<vision::Lens> lens;        ///< with which the picture was corrected
  std::optional<vision::SeenBoard> board;  ///< in its picture
  bool has_scale = false;                  ///< from a detected board or a given scale
  vision::HeapSizes sizes;
  std::optional<vision::ScannedHeap> scan;   ///< without its map; std::nullopt: not a scan
  std::optional<ScanViews> silhouettes;      ///< of a scan; without its views
  std::optional<vision::Proposal> proposal;  ///< what would help, if it is refused
  std::string pixels;   ///< fingerprint of the picture's pixels; empty: not read, or a film
  std::string heap;     ///< pictures with the same name are of one heap; empty: a heap of its own
  std::string copy_of;  ///< an earlier file with the same content; empty: not a duplicate
  std::string overlay_error;  ///< why there is no overlay
  report::PageJpeg overlay;   ///< if the plan keeps them
};

/// A frame of a film's time series, which is not a repeat.
inline bool is_of_series(const MeasuredPicture& picture) {
  return picture.filmed && picture.filmed->time_s;
}

/// Files to measure, and the settings for all of them.
struct FileMeasuring {
  std::vector<std::filesystem::path> pictures = {};  ///< also films, scans, particle files
  std::vector<std::filesystem::path> overlays = {};  ///< one per picture, or empty
  bool keeps_overlays = false;                       ///< in memory, for a report
  vision::MeasureOptions options = {};
  std::optional<double> frames_per_s = {};  ///< of folders that each hold a film's frames
  vision::ScaleOptions scale = {};
  vision::ScanOptions scan = {};
  PositionsOptions positions = {};     ///< of particle files
  std::optional<double> every_s = {};  ///< also measure frames of each film at this interval
  bool saves_hints = false;
  int threads = 1;
  base::FieldNames fields = {};  ///< names of inputs in error messages
};

/// Whether it is a particle file, and not a picture, film, scan or folder.
bool is_positions_file(const std::filesystem::path& file);

/// Measures one of the files, from reading it to its overlay. Errors of the file are in the result.
/// @param progress  called with the completed fraction; an exception from it ends the work, unless
///   it is one that reports a bad file
/// @returns one, followed by a film's frames if requested
std::vector<MeasuredPicture> measure_file(const FileMeasuring& plan, std::size_t index,
                                          const std::function<void(double)>& progress);

/// A photograph, or a film's heap at rest, that is read once and measured again whenever the user
/// changes its settings.
struct OpenedPicture {
  std::string file;
  vision::Picture picture;  ///< not rotated by a hint
  std::optional<FilmedPicture> filmed;
};

/// @param told  for a film, tells what does not count as movement
/// @throws base::InputError  it cannot be read; for a film as vision::measure_film().
OpenedPicture open_picture(const std::filesystem::path& file, const vision::PictureSettings& told);

struct MeasuredAgain {
  MeasuredPicture measured;    ///< with outline and edge points
  vision::Picture picture;     ///< that was measured: rotated, and corrected if its lens is known
  vision::OverlayNotes notes;  ///< for its overlay
};

/// Measures it as measure_file() does, using only `told` and ignoring hints saved beside the file.
/// Errors are in the result.
/// @param proposes  whether to search (for seconds) for settings that would help a refused picture
/// @param fields  names of inputs in error messages
MeasuredAgain measure_opened(const OpenedPicture& opened, const vision::PictureSettings& told,
                             bool proposes, base::FieldNames fields);

}  // namespace repose::calibrate
