#include "vision/track/tilt_track.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/distributions.h"
#include "base/units.h"
#include "vision/film/film_reader.h"
#include "vision/picture/mat_of_picture.h"
#include "vision/track/film_grains.h"
#include "vision/track/film_verdict.h"
#include "vision/track/tilt_verdict.h"

namespace repose::vision {
namespace {

/// Neighbouring frames err alike: so many count as one.
constexpr double kFramesAlike = 3;
/// What drawn films show to be left: of edges in a textured scene, and of the law of the slide.
constexpr double kLeast_deg = .03;

/// The plate's angle as a straight line of the time, by least squares.
struct AngleLine {
  double angle_deg = 0;  ///< at the time that was asked for
  double angle_error_deg = 0;
  double rate_deg_s = 0;
  double rate_error_deg_s = 0;
};

/// None where the plate is seen in fewer than three frames in between.
std::optional<AngleLine> angle_between(const PlateMotion& motion, double from_s, double to_s,
                                       double at_s) {
  double count = 0, mean_t = 0, mean_a = 0, tt = 0, ta = 0, aa = 0;
  for (const PlateSighting& one : motion.seen) {
    if (one.time_s < from_s || one.time_s > to_s) continue;
    ++count;
    const double angle = motion.turned_at(one) / kDegree;
    const double t = one.time_s - mean_t, a = angle - mean_a;
    mean_t += t / count;
    mean_a += a / count;
    tt += t * (one.time_s - mean_t);
    ta += t * (angle - mean_a);
    aa += a * (angle - mean_a);
  }
  AngleLine line{.angle_deg = mean_a};
  if (count < 3 || tt <= 0) return std::nullopt;
  line.rate_deg_s = ta / tt;
  line.angle_deg += line.rate_deg_s * (at_s - mean_t);
  const double variance = kFramesAlike * std::max(0.0, aa - ta * ta / tt) / (count - 2);
  line.rate_error_deg_s = std::sqrt(variance / tt);
  line.angle_error_deg = std::sqrt(variance / count + variance * std::pow(at_s - mean_t, 2) / tt);
  return line;
}

/// In the film's own pixels, counted from the corner of its first one.
Point point_of(const cv::Point2d& at, const PlateMotion& motion) {
  return {motion.reduction * (at.x + .5), motion.reduction * (at.y + .5)};
}

Segment edge_at(const PlateMotion& motion, const EdgeLine& line) {
  const auto end = [&](int column) {
    return point_of(motion.origin(line) + along_plate(motion, column) * line.along(), motion);
  };
  return {end(motion.edge.from), end(motion.edge.to)};
}

const PlateSighting& sighting_at(const PlateMotion& motion, double time_s) {
  return *std::min_element(motion.seen.begin(), motion.seen.end(),
                           [&](const auto& a, const auto& b) {
                             return std::abs(a.time_s - time_s) < std::abs(b.time_s - time_s);
                           });
}

void read_places(const PlateMotion& motion, const PlateGrains& grains, const OnPlateTrack& grain,
                 TiltTrack& track) {
  for (const OnPlateSighting& one : grain.seen) {
    const cv::Point2d place =
        grain.thing.centre + cv::Point2d(motion.sense * one.slid_px, -one.rise_px);
    const EdgeLine& line = motion.seen[one.plate].line;
    track.places.push_back(
        {one.time_s, point_of(in_frame(place, motion, line, grains.strip), motion)});
  }
}

void read_plate(const PlateMotion& motion, TiltTrack& track) {
  track.begin_deg = motion.level_rad / kDegree;
  track.turned_deg = motion.turned_rad / kDegree;
  track.noise_deg = motion.noise_rad / kDegree;
  for (const PlateSighting& one : motion.seen) {
    track.plate.push_back({one.time_s, motion.turned_at(one) / kDegree});
  }
}

/// False where the plate is not seen about it.
bool read_onset(const PlateMotion& motion, const PlateGrains& grains, const OnPlateTrack& grain,
                const SlideOnset& onset, TiltTrack& track) {
  constexpr double kAround_s = .2, kFramesAround = 2.5;
  const double at_s = onset.time_s;
  const double around_s =
      std::max(kAround_s, kFramesAround / track.film.frames_per_s) + onset.unseen_s;
  const auto near = angle_between(motion, at_s - around_s, at_s + around_s, at_s);
  const double begins_s = motion.seen.front().time_s + motion.rest_s;
  const auto whole = angle_between(motion, begins_s, at_s, at_s);
  if (!near || !whole) return false;
  const double late_s = onset.latest_s - at_s, early_s = at_s - onset.earliest_s;
  const double level_error_deg =
      std::hypot(base::kNormal95 * motion.noise_rad, motion.level_error_rad) / kDegree;
  track.angle_deg = {
      near->angle_deg,
      std::hypot(kLeast_deg, base::kNormal95 * near->angle_error_deg,
                 std::hypot(level_error_deg, near->rate_deg_s * std::max(late_s, early_s)))};
  track.rate_deg_s = {whole->rate_deg_s, base::kNormal95 * whole->rate_error_deg_s};
  track.onset_s = at_s;
  track.noise_px = motion.reduction * onset.rest_noise_px;
  track.grain_px = motion.reduction * grain.thing.width_px;
  track.level_edge = edge_at(motion, motion.seen.front().line);
  const PlateSighting& plate = sighting_at(motion, at_s);
  track.onset_edge = edge_at(motion, plate.line);
  track.onset = point_of(in_frame(grain.thing.centre, motion, plate.line, grains.strip), motion);
  track.has_reading = true;
  return true;
}

std::vector<std::size_t> sliding_among(const PlateGrains& grains) {
  std::vector<std::size_t> sliding;
  for (std::size_t k = 0; k < grains.tracks.size(); ++k) {
    const OnPlateTrack& one = grains.tracks[k];
    if (one.slid_px() > one.least_px()) sliding.push_back(k);
  }
  return sliding;
}

/// Reads the slide, or says why it cannot.
std::string read_slide(const PlateMotion& motion, const PlateGrains& grains,
                       const FilmSurvey& survey, TiltTrack& track) {
  const std::vector<std::size_t> sliding = sliding_among(grains);
  std::string fault = fault_of_grains(grains, sliding, motion);
  if (!fault.empty()) return fault;
  const OnPlateTrack& grain = grains.tracks[sliding.front()];
  read_places(motion, grains, grain, track);
  fault = fault_of_slide(grain, motion);
  if (!fault.empty()) return fault;
  std::vector<SlidAt> places;
  for (const OnPlateSighting& one : grain.seen) {
    places.push_back({one.time_s, one.slid_px, motion.turned_at(motion.seen[one.plate])});
  }
  const auto onset = slide_onset(places, grain.least_px(), grain.most_px());
  if (!onset) {
    return "too few frames show how the grain sets off. Rule: 4 at rest and 3 in its slide. Fix: "
           "begin the film earlier, show more of the plate below the grain, and take more frames "
           "per second.";
  }
  if (!read_onset(motion, grains, grain, *onset, track)) {
    return "the plate is seen in fewer than three frames about the onset of the slide, or before "
           "it. Fix: give the film as the camera stored it, or take more frames per second.";
  }
  const bool is_doubtful_film = warn_of_film(survey, grains.moved_px, track.warnings);
  const bool is_doubtful =
      warn_of_tilt(motion, grain, *onset, survey.times_s, track) || is_doubtful_film;
  track.status = is_doubtful ? MeasureStatus::flagged : MeasureStatus::ok;
  return {};
}

/// The frame of the onset, or the last one before a slide that was not found.
Picture frame_at(const FilmFile& file, const FilmSurvey& survey, double time_s) {
  FilmReader film(file, survey.times_s);
  FilmFrame frame;
  if (!film.next(frame)) return {};
  cv::Mat shown = frame.bgr.clone();
  while (frame.time_s < time_s && film.next(frame)) frame.bgr.copyTo(shown);
  Picture picture = blank_picture(shown.cols, shown.rows);
  shown.copyTo(mat_of(picture));
  return picture;
}

std::string read(const FilmFile& file, FilmSurvey& survey, const FilmProgress& progress,
                 TiltTrack& track) {
  const auto part = [&](double from, double length) -> FilmProgress {
    return [=, &progress](double done) {
      if (progress) progress(from + length * done);
    };
  };
  constexpr double kSurveyed = .2, kPlate = .4;
  survey = survey_film(file, part(0, kSurveyed));
  track.film = facts_of(survey);
  std::string fault = fault_of_shot(survey, 0);
  if (fault.empty()) fault = fault_of_fields(survey);
  if (!fault.empty()) return fault;
  const auto motion = plate_in_film(file, survey, part(kSurveyed, kPlate));
  survey.samples.clear();
  if (motion) read_plate(*motion, track);
  fault = fault_of_plate(motion);
  if (!fault.empty()) return fault;
  const PlateGrains grains =
      grains_on_plate(file, survey, *motion, part(kSurveyed + kPlate, 1 - kSurveyed - kPlate));
  fault = fault_of_shot(survey, grains.moved_px);
  if (!fault.empty()) return fault;
  return read_slide(*motion, grains, survey, track);
}

}  // namespace

TiltTrack track_tilt(const FilmFile& file, const TrackOptions& options) {
  TiltTrack track;
  FilmSurvey survey;
  track.reason = read(file, survey, options.progress, track);
  if (options.draws_strobe)
    track.strobe = frame_at(file, survey, track.has_reading ? track.onset_s : 0);
  return track;
}

}  // namespace repose::vision
