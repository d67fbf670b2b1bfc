#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/experiment/scan_angle.h"
#include "calibrate/particles/positions_angle.h"
#include "calibrate/report/measure_report.h"
#include "cli/common/output.h"
#include "cli/measure/measure_options.h"
#include "vision/film/film_angle.h"
#include "vision/hints/hint_file.h"
#include "vision/hints/proposal.h"
#include "vision/measure/repose_angle.h"
#include "vision/scan/scanned_heap.h"

namespace repose::cli {

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
  std::optional<calibrate::MeasuredPositions> positions;
  Outcome outcome = Outcome::measured;
  std::string error;
  vision::ReposeAngle angle;         ///< without the outline and edge points, which are large
  vision::PictureSettings told;      ///< with the picture's own hints, without the mask's pixels
  std::optional<vision::Lens> lens;  ///< that the picture was corrected by
  std::optional<vision::SeenBoard> board;  ///< in its picture
  bool has_scale = false;                  ///< a board that was seen, or a given scale
  vision::HeapSizes sizes;
  std::optional<vision::ScannedHeap> scan;          ///< without its map; none: no scan
  std::optional<calibrate::ScanViews> silhouettes;  ///< of a scan; without its views
  std::optional<vision::Proposal> proposal;         ///< what would help, when it is refused
  std::string pixels;         ///< a fingerprint of the picture's; empty: not read, or a film
  std::string heap;           ///< pictures of one name are of one heap; empty: of its own
  std::string copy_of;        ///< an earlier file that shows the same; empty: it is no copy
  std::string overlay_error;  ///< why there is no overlay
  calibrate::report::PageJpeg overlay;  ///< where the plan keeps them
};

/// A frame of a film's series, which is no repeat of anything.
inline bool is_of_series(const MeasuredPicture& picture) {
  return picture.filmed && picture.filmed->time_s;
}

/// Measures the plan's pictures and films, several at a time, each from reading to overlay before
/// the next, so that no more than plan.threads pictures are in memory. In the plan's order, a
/// film's frames behind its heap at rest, and the same at any number of threads.
///
/// Stops between pictures, and in the middle of a film, when `is_interrupted`; the result is then
/// worth nothing.
std::vector<MeasuredPicture> measure_batch(const MeasurePlan& plan,
                                           const std::atomic<bool>& is_interrupted);

/// Carries out `repose measure`.
ExitCode run_measure(const MeasureArguments& arguments);

}  // namespace repose::cli
