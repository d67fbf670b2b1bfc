#include "calibrate/study/bench_pictures.h"

#include <fmt/format.h>

#include "base/distributions.h"

namespace repose::calibrate {
PictureSet set_of(const std::vector<PictureReading>& pictures) {
  std::vector<SetPicture> all;
  for (const PictureReading& picture : pictures) {
    all.push_back({.status = picture_status_named(picture.status),
                   .angle_deg = picture.angle_deg,
                   .own_deg = picture.own_deg,
                   .camera_deg = picture.camera_deg,
                   .heap = picture.heap});
  }
  return set_of_pictures(all);
}

dem::Study with_pictures(dem::Study study, const std::vector<PictureReading>& pictures) {
  const auto heap = study.experiments.find(dem::Experiment::heap);
  if (heap == study.experiments.end()) return study;
  const PictureSet set = set_of(pictures);
  if (!set.heaps_deg) return study;
  dem::Measured& measured = heap->second.measured;
  measured.values = set.heap_deg;
  if (set.own_deg > 0) measured.value_uncertainty = set.own_deg / base::kNormal95;
  if (set.within_sd_deg) measured.within_heaps = {set.pictures, *set.within_sd_deg};
  if (!(set.camera_deg > 0)) return study;
  const double sd = set.camera_deg / base::kNormal95;
  measured.systematic.push_back(
      {.name = "camera",
       .sd = sd,
       .note = fmt::format(
           "its pictures share ± {:.2g} deg by their camera's pitch and distance (standard "
           "uncertainty), which more pictures do not lower. Fix: save the pitch beside them "
           "(repose measure --pitch-deg 0 --save-hints), or put a board into them",
           sd)});
  return study;
}

}  // namespace repose::calibrate
