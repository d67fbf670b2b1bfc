#include "vision/measure/reading.h"

#include <algorithm>

#include "vision/measure/grain.h"
#include "vision/measure/score.h"

namespace repose::vision {

double Reading::angle_rad() const {
  const bool l = left.status == FlankStatus::ok;
  const bool r = right.status == FlankStatus::ok;
  if (l && r) return (left.angle_rad + right.angle_rad) / 2;
  return l ? left.angle_rad : r ? right.angle_rad : 0;
}

namespace {

Reading read_body(const Segmentation& segmentation, Body body, const WorkingPicture& work,
                  const MeasureOptions& options) {
  Reading reading;
  reading.segmentation = segmentation;
  reading.body = std::move(body);
  reading.profile = upper_profile(reading.body, segmentation, work);
  if (reading.profile.size() < 10) return reading;
  reading.grain = grain_size(work, reading.body.mask);
  FlankOptions flank{options.window_from, options.window_to, true, reading.grain, options.seed};
  reading.left = fit_flank(reading.profile, Side::left, flank);
  ++flank.seed;
  reading.right = fit_flank(reading.profile, Side::right, flank);
  score(reading, work);
  return reading;
}

}  // namespace

Reading read_heap(const Segmentation& segmentation, const WorkingPicture& work,
                  const MeasureOptions& options) {
  Reading best;
  best.segmentation = segmentation;
  for (Body& body : find_bodies(segmentation, work)) {
    Reading reading = read_body(segmentation, std::move(body), work, options);
    if (best.profile.size() == 0 || reading.score > best.score) best = std::move(reading);
  }
  return best;
}

Reading read_again(const Reading& earlier, const Segmentation& segmentation,
                   const WorkingPicture& work, const MeasureOptions& options) {
  Body body = body_on(earlier.body, segmentation, work);
  if (body.mask.empty()) return {};
  return read_body(segmentation, std::move(body), work, options);
}

}  // namespace repose::vision
