#include "vision/measure/paper_method.h"

#include <cmath>

#include <opencv2/imgproc.hpp>

#include "vision/measure/score.h"

namespace repose::vision {

Choice read_by_paper(const WorkingPicture& work, const MeasureOptions& options) {
  Choice choice;
  Reading& reading = choice.best;
  reading.segmentation = grey_otsu(work);
  reading.body = largest_region(reading.segmentation, work);
  if (reading.body.mask.empty()) return choice;
  reading.profile = upper_profile(reading.body, reading.segmentation, work);
  if (reading.profile.size() < 10) return choice;
  FlankOptions flank{options.window_from, options.window_to, false, std::nullopt, options.seed};
  reading.left = fit_flank(reading.profile, Side::left, flank);
  reading.right = fit_flank(reading.profile, Side::right, flank);
  for (FlankFit* side : {&reading.left, &reading.right}) {
    side->shown = side->least_squares;
    side->angle_rad = std::atan(-side->least_squares.slope);
  }
  score(reading, work);
  return choice;
}

}  // namespace repose::vision
