#include "vision/track/plate_grain.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <opencv2/imgproc.hpp>

#include "base/units.h"
#include "vision/film/film_reader.h"
#include "vision/film/scene_shift.h"
#include "vision/track/background.h"
#include "vision/track/blobs.h"
#include "vision/track/grain_template.h"
#include "vision/track/standing_things.h"

namespace repose::vision {
namespace {

/// A thing with what it looked like.
struct FollowedGrain {
  OnPlateTrack track;
  GrainTemplate looks;
  TemplateMatch last = {};
  TemplateMatch before = {};
  double last_s = 0;
  bool is_over = false;
};

/// The strip as it is before anything can have slid: the median of frames up to a few degrees.
cv::Mat first_strip(const FilmFile& file, const PlateMotion& motion, const PlateStrip& strip) {
  constexpr double kBefore_rad = 4 * kDegree;
  constexpr std::size_t kMost = 25;
  std::vector<std::size_t> numbers;
  for (std::size_t k = 0; k < motion.seen.size(); ++k) {
    if (motion.turned_at(motion.seen[k]) > kBefore_rad) break;
    numbers.push_back(k);
  }
  const std::size_t stride = numbers.size() / kMost + 1;
  std::vector<cv::Mat> strips;
  FilmReader film(file);
  FilmFrame frame;
  int at = 0;
  for (std::size_t k = 0; k < numbers.size(); k += stride) {
    const PlateSighting& plate = motion.seen[numbers[k]];
    bool has_more = true;
    for (; at < plate.frame && has_more; ++at) has_more = film.skip(frame);
    if (!has_more || !film.next(frame)) break;
    ++at;
    strips.push_back(
        strip_picture(reduced_frame(frame.bgr, motion.reduction), motion, plate.line, strip));
  }
  return strips.empty() ? cv::Mat() : median_of(strips);
}

/// What is always above the plate and what stands on it, in the first frame's columns.
cv::Mat above_plate(const PlateMotion& motion, const PlateStrip& strip, const cv::Size& size) {
  cv::Mat above(size, CV_8U, cv::Scalar(0));
  for (int x = 0; x < size.width; ++x) {
    double highest = size.height;
    for (const PlateSighting& one : motion.seen) {
      highest = std::min(highest, one.line.row_at(x));
    }
    const int rows = std::clamp(cvFloor(highest) - strip.size.height / 2, 0, size.height);
    above.col(x).rowRange(0, rows).setTo(255);
  }
  return above;
}

cv::Mat around(const cv::Mat& mask) {
  constexpr int kMargin_px = 2;
  cv::Mat wide;
  cv::dilate(mask, wide, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}), {-1, -1}, kMargin_px);
  return wide;
}

/// With its turn: from where it lies unturned, and where it turns fast, from where it would be had
/// it turned on.
TemplateMatch turned_match(const FollowedGrain& followed, const cv::Mat& strip,
                           const TemplateMatch& unturned, int reach_px) {
  constexpr double kFast_rad = 2 * kDegree;
  TemplateMatch begin = unturned;
  begin.turned_rad = followed.last.turned_rad;
  const TemplateMatch near = followed.looks.find_turned(strip, begin);
  const double turns_on = 2 * followed.last.turned_rad - followed.before.turned_rad;
  if (std::abs(turns_on) < kFast_rad) return near;
  const TemplateMatch expected{.moved = 2 * followed.last.moved - followed.before.moved,
                               .turned_rad = turns_on};
  const TemplateMatch on =
      followed.looks.find_turned(strip, followed.looks.find(strip, expected, reach_px));
  return on.likeness > near.likeness ? on : near;
}

void follow(FollowedGrain& followed, const cv::Mat& strip, std::size_t plate, double time_s,
            double sense) {
  constexpr double kPatience_s = .3, kLeastLikeness = .25, kMostRise_px = 4;
  constexpr int kReach_px = 12;
  if (followed.is_over) return;
  const TemplateMatch expected{.moved = 2 * followed.last.moved - followed.before.moved};
  const TemplateMatch match = followed.looks.find(strip, expected, kReach_px);
  const TemplateMatch turned = turned_match(followed, strip, match, kReach_px);
  const TemplateMatch& best = turned.likeness > match.likeness ? turned : match;
  if (best.likeness < kLeastLikeness || std::abs(best.moved.y) > kMostRise_px) {
    followed.is_over = time_s - followed.last_s > kPatience_s;
    return;
  }
  const double unlike = 1 - match.likeness;
  // What turns in place of sliding is found by its turn alone after a while.
  const bool is_found = match.likeness >= kLeastLikeness;
  const cv::Point2d moved = is_found ? match.moved : turned.moved;
  followed.before = followed.last;
  followed.last = {.moved = moved, .turned_rad = turned.turned_rad};
  followed.last_s = time_s;
  OnPlateTrack& track = followed.track;
  track.seen.push_back({.plate = plate,
                        .time_s = time_s,
                        .slid_px = sense * moved.x,
                        .rise_px = -moved.y,
                        .turned_rad = turned.turned_rad,
                        .turn_gain = unlike > 0 ? (turned.likeness - match.likeness) / unlike : 0});
  followed.is_over = track.seen.back().slid_px > track.most_px();
}

}  // namespace

double OnPlateTrack::least_px() const { return std::max(4.0, .2 * thing.height_px); }

double OnPlateTrack::most_px() const { return std::max(40.0, 2.5 * thing.height_px); }

double OnPlateTrack::slid_px() const {
  double most = 0;
  for (const OnPlateSighting& one : seen) most = std::max(most, one.slid_px);
  return most;
}

PlateGrains grains_on_plate(const FilmFile& file, const FilmSurvey& survey,
                            const PlateMotion& motion, const FilmProgress& progress) {
  const cv::Size size = survey.size / motion.reduction;
  PlateGrains grains{.strip = strip_above(motion, size)};
  const cv::Mat first = first_strip(file, motion, grains.strip);
  if (first.empty()) return grains;
  std::vector<FollowedGrain> all;
  for (OnPlate& thing : standing_things(first)) {
    const GrainTemplate looks(first, around(thing.mask));
    all.push_back({.track = {.thing = std::move(thing)}, .looks = looks});
  }
  FilmReader film(file);
  FilmFrame frame;
  std::optional<SceneShift> scene;
  int number = 0;
  for (std::size_t k = 0; k < motion.seen.size(); ++number) {
    if (!film.next(frame)) break;
    const PlateSighting& plate = motion.seen[k];
    if (number < plate.frame) continue;
    const cv::Mat small = reduced_frame(frame.bgr, motion.reduction);
    if (!scene) scene.emplace(small, above_plate(motion, grains.strip, size));
    const cv::Point2d shift = motion.reduction * scene->of(small);
    grains.moved_px = std::max(grains.moved_px, std::hypot(shift.x, shift.y));
    const cv::Mat strip = strip_picture(small, motion, plate.line, grains.strip);
    for (FollowedGrain& one : all) follow(one, strip, k, plate.time_s, motion.sense);
    ++k;
    if (progress) progress(static_cast<double>(k) / static_cast<double>(motion.seen.size()));
  }
  for (FollowedGrain& one : all) grains.tracks.push_back(std::move(one.track));
  return grains;
}

}  // namespace repose::vision
