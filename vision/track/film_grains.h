#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "vision/film/film_file.h"
#include "vision/film/film_survey.h"
#include "vision/film/frame_times.h"
#include "vision/picture/picture.h"
#include "vision/track/blobs.h"

namespace repose::vision {

/// Where one thing was seen, in order of time.
struct Sighting {
  int frame = 0;
  double time_s = 0;
  Blob blob;
};
using GrainPath = std::vector<Sighting>;

/// Joins blobs of successive frames that are the same thing: near where it was expected if it flew
/// on, came to rest or bounced, and of similar size and colour.
class PathFinder {
 public:
  /// @param interval_s  between frames
  explicit PathFinder(double interval_s) : interval_s_(interval_s) {}

  void add(int frame, double time_s, const std::vector<Blob>& blobs);

  /// Those that moved, longest distance first.
  std::vector<GrainPath> paths() &&;

 private:
  /// How badly a blob fits a path; infinite: not at all.
  double cost(const GrainPath& path, double time_s, const Blob& blob) const;
  void forget_lost(double time_s);

  /// Missing frames: nothing could be seen meanwhile, so that no path is lost because of them.
  struct Gap {
    double begins_s = 0;
    double lasts_s = 0;
  };
  void note_gap(double time_s);
  double unseen_s(double since_s) const;

  double interval_s_;
  std::optional<double> last_s_;
  std::vector<Gap> gaps_;
  std::vector<GrainPath> open_;
  std::vector<GrainPath> closed_;
};

/// Length of a path, without the jitter of a thing at rest [px].
double way_px(const GrainPath& path);

/// Everything that moved in a video.
struct FilmGrains {
  FilmSurvey survey;
  cv::Mat scene = {};
  std::vector<GrainPath> paths = {};     ///< longest distance first, corrected for the scene's
                                         ///< shifts
  std::vector<cv::Point2d> shifts = {};  ///< of the scene in each frame [px]
  RepeatedFrames repeated = {};          ///< these frames are in no path
  /// When frames may have been taken if not at their time stamps, each entry a list for all frames:
  /// in a pattern of repeats, or at even intervals if the stamps are uneven.
  std::vector<std::vector<double>> other_times_s = {};
};

/// The same video with different frame times.
FilmGrains retimed(const FilmGrains& film, const std::vector<double>& times_s);

double farthest_shift_px(const FilmGrains& film);

/// Reads the video twice: for the scene, and for what moves in front of it. Videos whose scene
/// changes as a whole, or with few frames, are read once: they have no paths.
/// @throws base::InputError  see FilmReader.
FilmGrains grains_in_film(const FilmFile& file, const FilmProgress& progress);

/// The scene with the grain at successive places of its path, about its width apart or more.
Picture strobe_picture(const FilmFile& file, const cv::Mat& scene, const GrainPath& path);

}  // namespace repose::vision
