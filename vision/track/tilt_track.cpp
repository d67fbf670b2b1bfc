#include "vision/track/tilt_track.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/distributions.h"
#include "base/units.h"
#include "vision/film/film_reader.h"
#include "vision/film/frame_times.h"
#include "vision/picture/opencv.h"
#include "vision/track/film_grains.h"
#include "vision/track/film_scale.h"
#include "vision/track/plate_grain.h"
#include "vision/track/slide_onset.h"

/// What prevents a reading from a video of a tilt, and what to warn about.

namespace repose::vision {

namespace {

constexpr double kMinTurn_deg = 3;

/// Elongation above which the outline shows whether the grain turns.
constexpr double kRound = 1.25;

/// A body that has turned by this much relative to the plate tips or rolls, as in the simulation.
constexpr double kTipped_rad = 5 * kDegree;

/// A round grain shows it only by its surface pattern.
constexpr double kRolled_rad = 12 * kDegree;

constexpr double kShown = .3;

double most_apart_px(const OnPlateTrack& a, const OnPlateTrack& b) {
  double most = 0;
  auto other = b.seen.begin();
  for (const OnPlateSighting& one : a.seen) {
    while (other != b.seen.end() && other->plate < one.plate) ++other;
    if (other == b.seen.end()) break;
    if (other->plate == one.plate) most = std::max(most, std::abs(one.slid_px - other->slid_px));
  }
  return most;
}

/// The largest change of the tilting rate within a tenth of a second, during the last second before
/// the onset.
double jerk_deg_s(const PlateMotion& motion, double onset_s, double interval_s) {
  constexpr double kWithin_s = .1, kBefore_s = 1, kGap = 1.5;
  const auto lag = static_cast<std::size_t>(std::max(1L, std::lround(kWithin_s / interval_s)));
  const auto turned = [&](std::size_t k) { return motion.turned_at(motion.seen[k]) / kDegree; };
  double most = 0;
  for (std::size_t k = lag; k + lag < motion.seen.size(); ++k) {
    const double time_s = motion.seen[k].time_s;
    // The start of the motion also changes the rate, long before a grain slides.
    if (time_s < onset_s - kBefore_s || time_s > onset_s || turned(k - lag) < 1) continue;
    // Where frames are missing, the plate turns farther in the same number of frames.
    const double took_s =
        std::max(motion.seen[k + lag].time_s - time_s, time_s - motion.seen[k - lag].time_s);
    if (took_s > kGap * static_cast<double>(lag) * interval_s) continue;
    const double change = turned(k + lag) - 2 * turned(k) + turned(k - lag);
    most = std::max(most, std::abs(change) / kWithin_s);
  }
  return most;
}

/// Mean rate between two times.
double rate_deg_s(const PlateMotion& motion, double from_s, double to_s) {
  const PlateSighting* first = nullptr;
  const PlateSighting* last = nullptr;
  for (const PlateSighting& one : motion.seen) {
    if (one.time_s < from_s || one.time_s > to_s) continue;
    if (first == nullptr) first = &one;
    last = &one;
  }
  if (first == nullptr || last->time_s <= first->time_s) return 0;
  return (motion.turned_at(*last) - motion.turned_at(*first)) / kDegree /
         (last->time_s - first->time_s);
}

class TiltWarnings {
 public:
  explicit TiltWarnings(TiltTrack& track) : track_(track) {}

  /// Something the user must check first.
  void flag(const char* code, std::string message) {
    is_doubtful_ = true;
    warn(code, std::move(message));
  }
  void warn(const char* code, std::string message) {
    track_.warnings.push_back({.code = code, .message = std::move(message)});
  }
  bool is_doubtful() const { return is_doubtful_; }

 private:
  TiltTrack& track_;
  bool is_doubtful_ = false;
};

void warn_of_level(const PlateMotion& motion, TiltWarnings& warnings) {
  constexpr double kRest_s = .15, kLean_deg = 2;
  if (motion.rest_s < kRest_s) {
    warnings.flag("no_rest",
                  fmt::format("the plate lies still for {:.2f} s at the beginning only: the angle "
                              "counts from there, and is too small if the plate was tilted before. "
                              "Begin the film with the plate at rest and level",
                              motion.rest_s));
  }
  const double lean_deg = motion.level_rad / kDegree;
  if (std::abs(lean_deg) > kLean_deg) {
    warnings.flag("leaning",
                  fmt::format("the plate leans by {:.1f}° in the picture when the film begins: the "
                              "angle counts from there. Level the plate, and the camera so that it "
                              "shows",
                              std::abs(lean_deg)));
  }
  constexpr double kUnsure_deg = .3;
  const double unsure_deg = motion.level_error_rad / kDegree;
  if (unsure_deg > kUnsure_deg) {
    warnings.flag("level_hidden",
                  fmt::format("something else with an edge lies behind the level plate's, such as "
                              "a table: how the plate lay at first is uncertain by {:.1f}°. Raise "
                              "the camera or the plate, so that only the backdrop is behind it",
                              unsure_deg));
  }
}

void warn_of_rate(const PlateMotion& motion, const TiltTrack& track, TiltWarnings& warnings) {
  constexpr double kUneven = .25, kJerk = .5, kSigmas = 6, kLast_s = 1;
  const double interval_s = track.film.frames_per_s > 0 ? 1 / track.film.frames_per_s : 0;
  const double mean = track.rate_deg_s.value;
  const double from_s = motion.seen.front().time_s + motion.rest_s;
  const double last = rate_deg_s(motion, std::max(from_s, track.onset_s - kLast_s), track.onset_s);
  if (std::abs(last - mean) > kUneven * mean) {
    warnings.warn("uneven_rate",
                  fmt::format("the plate turns by {:.2f}°/s in the last second before the slide, "
                              "and by {:.2f}°/s on average: tilt it steadily",
                              last, mean));
  }
  const double jerk = interval_s > 0 ? jerk_deg_s(motion, track.onset_s, interval_s) : 0;
  const double noise = kSigmas * std::sqrt(6) * track.noise_deg / .1;
  if (jerk > std::max(kJerk * mean, noise)) {
    warnings.flag("jerks",
                  fmt::format("the plate jerks shortly before the slide: its rate changes by "
                              "{:.2f}°/s within 0.1 s, which can set the grain off. Tilt it "
                              "steadily, by a screw or a motor",
                              jerk));
  }
  constexpr double kWobble_px = 1.5;
  if (motion.wobble_px > kWobble_px) {
    warnings.flag("hinge_moves",
                  fmt::format("the plate does not turn about one place (its edge is off by {:.1f} "
                              "pixels): it slips or bends, or the camera looks askew",
                              motion.reduction * motion.wobble_px));
  }
}

/// Whether the plate turns evenly by frame number, but not by time stamp, where the frame rate
/// changes: if so, the time stamps were stretched. False if it does not turn on both sides.
bool is_retimed_at(const RateChange& change, const PlateMotion& motion,
                   const std::vector<double>& times_s) {
  constexpr double kSide_s = .5, kSigmas = 10;
  const double at_s = times_s[change.frame];
  const double least_deg = kSigmas * motion.noise_rad / kDegree;
  constexpr double kFrames = 6;
  const double before_s = std::max(kSide_s, kFrames * change.before_s);
  const double after_s = std::max(kSide_s, kFrames * change.after_s);
  const double before = rate_deg_s(motion, at_s - before_s, at_s);
  const double after = rate_deg_s(motion, at_s, at_s + after_s);
  if (before * before_s < least_deg || after * after_s < least_deg) return false;
  const double by_stamps = std::abs(std::log(after / before));
  const double by_frames = std::abs(std::log(after * change.after_s / (before * change.before_s)));
  return by_frames < by_stamps;
}

void warn_of_times(const PlateMotion& motion, const OnPlateTrack& grain, const SlideOnset& onset,
                   const std::vector<double>& times_s, TiltWarnings& warnings) {
  if (onset.unseen_s > 0) {
    warnings.flag("onset_unseen",
                  fmt::format("for {:.2f} s about the onset nothing is seen, since frames are "
                              "missing: it may be at any time in them, as the interval says. Give "
                              "the film as the camera stored it",
                              onset.unseen_s));
  }
  for (const RateChange& change : rate_changes(times_s)) {
    const double at_s = times_s[change.frame];
    if (at_s > grain.seen.back().time_s || !is_retimed_at(change, motion, times_s)) continue;
    warnings.flag("speed_changes",
                  fmt::format("the film changes its speed: from {:.2f} s on its frames follow "
                              "every {:.3g} ms and not every {:.3g}, while the plate turns on as "
                              "far from frame to frame. The rate is wrong, and the angle where "
                              "that is near the onset. Give the film as the camera stored it",
                              at_s, 1e3 * change.after_s, 1e3 * change.before_s));
    return;
  }
}

/// Why the plate's angle cannot be read; empty if it can.
std::string fault_of_plate(const std::optional<PlateMotion>& motion) {
  if (!motion) {
    return "no plate is seen to turn: no long straight edge, level when the film begins, that "
           "moves. Fix: film from the side, level with the plate, before a backdrop that is "
           "brighter or darker than the plate's upper edge, from when it lies level.";
  }
  const double turned_deg = motion->turned_rad / kDegree;
  if (turned_deg < kMinTurn_deg) {
    return fmt::format(
        "the plate turns by {:.1f} degrees only. Rule: {:g} or more. Fix: tilt it until the grain "
        "slides.",
        turned_deg, kMinTurn_deg);
  }
  return {};
}

/// Why no slide can be read from the objects on the plate; empty if one can.
/// @param sliding  the tracks that move, by index
std::string fault_of_grains(const PlateGrains& grains, const std::vector<std::size_t>& sliding,
                            const PlateMotion& motion) {
  const auto& tracks = grains.tracks;
  const auto is_cut_off = [](const OnPlateTrack& one) { return one.thing.touches_edge; };
  const bool is_at_edge =
      sliding.empty() ? !tracks.empty() && std::all_of(tracks.begin(), tracks.end(), is_cut_off)
                      : is_cut_off(tracks[sliding.front()]);
  if (is_at_edge) {
    return "the grain lies at the end of what is seen of the plate. Rule: all of it is seen from "
           "the "
           "beginning. Fix: show the plate a few grains' widths farther on both sides of the "
           "grain.";
  }
  if (sliding.empty()) {
    if (tracks.empty()) {
      return "no grain is seen on the plate. Rule: it stands out from the backdrop by 22 grey "
             "levels and is 4 pixels large at least. Fix: a backdrop of another colour than the "
             "grain, and the camera nearer or zoomed in.";
    }
    return fmt::format(
        "no grain slides before the film ends: nothing on the plate moves along it while it turns "
        "by {:.1f} degrees. Fix: tilt the plate and film on until the grain slides.",
        motion.turned_rad / kDegree);
  }
  for (const std::size_t k : sliding) {
    constexpr double kApart_px = 3;
    const OnPlateTrack& first = tracks[sliding.front()];
    const double apart_px = most_apart_px(first, tracks[k]);
    if (apart_px <= kApart_px) continue;
    return fmt::format(
        "several things slide, and not together: {:.0f} pixels apart. Rule: one grain, or some "
        "that are bonded, in a film. Fix: film each slide by itself.",
        motion.reduction * apart_px);
  }
  return {};
}

/// Why the moving object does not slide; empty if it does.
std::string fault_of_slide(const OnPlateTrack& grain, const PlateMotion& motion) {
  const bool is_round = grain.thing.elongation < kRound;
  for (const OnPlateSighting& one : grain.seen) {
    // Down the plate: the lighting of a shaded grain seems to turn it the other way.
    const double turned_rad = motion.sense * one.turned_rad;
    if (one.slid_px > .6 * grain.thing.height_px) break;
    if (turned_rad < (is_round ? kRolled_rad : kTipped_rad)) continue;
    if (one.turn_gain < kShown) continue;
    return fmt::format(
        "the grain rolls or tips at {:.1f} degrees: it turns by {:.0f} degrees against the plate "
        "while it moves by {:.0f} pixels. Rule: less than {:.0f}. Fix: bond three grains side by "
        "side, so that they can only slide.",
        motion.turned_at(motion.seen[one.plate]) / kDegree, turned_rad / kDegree,
        motion.reduction * one.slid_px, (is_round ? kRolled_rad : kTipped_rad) / kDegree);
  }
  return {};
}

/// Adds the warnings.
/// @param times_s  of all frames
/// @returns whether the user must check something first
bool warn_of_tilt(const PlateMotion& motion, const OnPlateTrack& grain, const SlideOnset& onset,
                  const std::vector<double>& times_s, TiltTrack& track) {
  TiltWarnings warnings(track);
  warn_of_level(motion, warnings);
  warn_of_rate(motion, track, warnings);
  warn_of_times(motion, grain, onset, times_s, warnings);
  constexpr double kCrept_px = .4, kSigmas = 5, kUnlike_px = .6;
  if (onset.crept_px > std::max(kCrept_px, kSigmas * onset.rest_noise_px)) {
    warnings.flag("creeps", fmt::format("the grain has moved by {:.1f} pixels or more along the "
                                        "plate before it slides off: the angle is that of the "
                                        "slide",
                                        motion.reduction * onset.crept_px));
  }
  if (onset.rms_px > std::max(kUnlike_px, kSigmas * onset.rest_noise_px)) {
    warnings.flag("unsteady", fmt::format("the grain does not set off like one that slides (off by "
                                          "{:.1f} pixels): it sticks and slips, or is pushed",
                                          motion.reduction * onset.rms_px));
  }
  if (grain.thing.elongation < kRound) {
    warnings.flag("may_roll",
                  "a round grain: whether it slides or rolls cannot be seen. Bond three grains "
                  "side by side, so that they can only slide");
  }
  return warnings.is_doubtful();
}

/// Errors of neighbouring frames are correlated: this many count as one.
constexpr double kFramesAlike = 3;
/// Remaining error found in rendered videos: from edges in a textured scene, and from the law of
/// the slide.
constexpr double kMin_deg = .03;

/// The plate's angle as a linear function of time, by least squares.
struct AngleLine {
  double angle_deg = 0;  ///< at the requested time
  double angle_error_deg = 0;
  double rate_deg_s = 0;
  double rate_error_deg_s = 0;
};

/// std::nullopt if the plate is seen in fewer than three frames in between.
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

/// In the video's own pixels, counted from the corner of the first one.
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

/// False if the plate is not seen around that time.
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
      std::hypot(kMin_deg, base::kNormal95 * near->angle_error_deg,
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

/// Evaluates the slide, or returns why it cannot.
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
