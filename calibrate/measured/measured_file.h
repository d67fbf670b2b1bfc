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

/// A file of any kind with a heap in it, measured: what the command line prints and the studio
/// shows.
namespace repose::calibrate {

enum class Outcome {
  measured,        ///< or refused: `angle` says
  bad_input,       ///< not read, or a box outside it: `error` says
  internal_error,  ///< our own error
};

/// Where a picture comes from that was taken out of a film.
struct FilmedPicture {
  vision::FilmFacts film;
  std::optional<vision::FilmStretch> stretch;  ///< none: the film has no rest
  std::optional<double> time_s;                ///< of a single frame; none: the heap at rest
};

struct MeasuredPicture {
  std::string file;
  std::optional<FilmedPicture> filmed;  ///< none: the file is a picture, or of particles
  /// None: the file is a picture or a film. Without the first view's picture and edges.
  std::optional<MeasuredPositions> positions;
  Outcome outcome = Outcome::measured;
  std::string error;
  vision::ReposeAngle angle;         ///< without the outline and edge points, which are large
  vision::PictureSettings told;      ///< with the picture's own hints, without the mask's pixels
  std::optional<vision::Lens> lens;  ///< that the picture was corrected by
  std::optional<vision::SeenBoard> board;  ///< in its picture
  bool has_scale = false;                  ///< a board that was seen, or a given scale
  vision::HeapSizes sizes;
  std::optional<vision::ScannedHeap> scan;   ///< without its map; none: no scan
  std::optional<ScanViews> silhouettes;      ///< of a scan; without its views
  std::optional<vision::Proposal> proposal;  ///< what would help, when it is refused
  std::string pixels;         ///< a fingerprint of the picture's; empty: not read, or a film
  std::string heap;           ///< pictures of one name are of one heap; empty: of its own
  std::string copy_of;        ///< an earlier file that shows the same; empty: it is no copy
  std::string overlay_error;  ///< why there is no overlay
  report::PageJpeg overlay;   ///< where the plan keeps them
};

/// A frame of a film's series, which is no repeat of anything.
inline bool is_of_series(const MeasuredPicture& picture) {
  return picture.filmed && picture.filmed->time_s;
}

/// Files to measure, and what is said of all of them.
struct FileMeasuring {
  std::vector<std::filesystem::path> pictures = {};  ///< and films, scans, files of particles
  std::vector<std::filesystem::path> overlays = {};  ///< one a picture, or none
  bool keeps_overlays = false;                       ///< in memory, for a report
  vision::MeasureOptions options = {};
  std::optional<double> frames_per_s = {};  ///< of folders, each a film's frames
  vision::ScaleOptions scale = {};
  vision::ScanOptions scan = {};
  PositionsOptions positions = {};     ///< of files of particles
  std::optional<double> every_s = {};  ///< also frames of each film, so far apart
  bool saves_hints = false;
  int threads = 1;
  base::FieldNames fields = {};  ///< what faults call what was said
};

/// A file of particles, and neither a picture nor a film nor a scan nor a folder.
bool is_positions_file(const std::filesystem::path& file);

/// Measures one of the files, from reading it to its overlay. What is wrong with it is in the
/// result.
/// @param progress  told which fraction is done; what it throws, other than what says that a file
///   is wrong, ends the work
/// @returns one, and behind it a film's frames where they are asked for
std::vector<MeasuredPicture> measure_file(const FileMeasuring& plan, std::size_t index,
                                          const std::function<void(double)>& progress);

/// A photograph, or a film's heap at rest, that is read once and measured as often as a person
/// changes what is said of it.
struct OpenedPicture {
  std::string file;
  vision::Picture picture;  ///< not turned by a hint
  std::optional<FilmedPicture> filmed;
};

/// @param told  says of a film what is no movement in it
/// @throws base::InputError  it cannot be read; of a film as vision::measure_film().
OpenedPicture open_picture(const std::filesystem::path& file, const vision::PictureSettings& told);

struct MeasuredAgain {
  MeasuredPicture measured;    ///< with outline and edge points
  vision::Picture picture;     ///< that was measured: turned, and corrected where its lens is known
  vision::OverlayNotes notes;  ///< for its overlay
};

/// Measures it as measure_file() does, by just what is told, whatever is saved beside the file.
/// What is wrong with that is in the result.
/// @param proposes  whether to look, for seconds, for what would help a picture that is refused
/// @param fields    what faults call what was told
MeasuredAgain measure_opened(const OpenedPicture& opened, const vision::PictureSettings& told,
                             bool proposes, base::FieldNames fields);

}  // namespace repose::calibrate
