#include "calibrate/measured/measured_columns.h"

#include <array>

namespace repose::calibrate {

std::span<const MeasuredColumn> measured_columns() {
  static constexpr auto kColumns = std::to_array<MeasuredColumn>({
      {"file", "", "the picture, film, scan or file of particles", true},
      {"status", "", "ok, flagged (look at it) or refused", true},
      {"angle_deg", "°", "angle of repose: the mean of both flanks"},
      {"uncertainty_deg", "°", "half-width of its 95 % interval"},
      {"left_status", "", "of the left flank: ok, or why it has no angle", true},
      {"left_deg", "°", "angle of the left flank"},
      {"left_uncertainty_deg", "°", "half-width of its 95 % interval"},
      {"left_r2", "", "part of the scatter of the left edge that its line explains"},
      {"left_points", "", "points of the left edge that were fitted"},
      {"right_status", "", "of the right flank: ok, or why it has no angle", true},
      {"right_deg", "°", "angle of the right flank"},
      {"right_uncertainty_deg", "°", "half-width of its 95 % interval"},
      {"right_r2", "", "part of the scatter of the right edge that its line explains"},
      {"right_points", "", "points of the right edge that were fitted"},
      {"ground_tilt_deg", "°", "how much the ground line is turned in the picture"},
      {"window_from", "of the height", "where the fitted part of a flank begins"},
      {"window_to", "of the height", "where it ends"},
      {"method", "", "auto, or paper: the published one", true},
      {"segmentation", "", "how the heap was told from its background", true},
      {"confidence", "0 to 1", "how well that fits"},
      {"strays", "", "grains that lie apart from the heap"},
      {"grain_px", "px", "size of a grain"},
      {"height_px", "px", "height of the heap"},
      {"base_px", "px", "width of its base"},
      {"hints", "", "what a person has said of the picture", true},
      {"warnings", "", "codes, with semicolons between them", true},
      {"reason", "", "why it was refused", true},
      {"time_s", "s", "of a single frame of a film"},
      {"film_from_s", "s", "where the rest that was measured begins in the film"},
      {"film_to_s", "s", "where it ends"},
      {"film_frames", "", "frames of it"},
      {"frames_per_s", "1/s", "of the film"},
      {"camera", "", "file of the lens that the picture was corrected by", true},
      {"scale", "", "what millimetres come from: board, given, positions", true},
      {"mm_per_px", "mm", "of a pixel at the heap"},
      {"mm_per_px_uncertainty", "mm", "half-width of its 95 % interval"},
      {"height_mm", "mm", "height of the heap"},
      {"height_mm_uncertainty", "mm", "half-width of its 95 % interval"},
      {"base_mm", "mm", "width of its base"},
      {"base_mm_uncertainty", "mm", "half-width of its 95 % interval"},
      {"cone_volume_ml", "ml", "of a cone of that height and base"},
      {"cone_volume_ml_uncertainty", "ml", "half-width of its 95 % interval"},
      {"left_run_out_mm", "mm", "from the axis to the left foot"},
      {"left_run_out_mm_uncertainty", "mm", "half-width of its 95 % interval"},
      {"right_run_out_mm", "mm", "from the axis to the right foot"},
      {"right_run_out_mm_uncertainty", "mm", "half-width of its 95 % interval"},
      {"size_reason", "", "why there are no sizes", true},
      {"volume_ml", "ml", "of the heap in a scan"},
      {"volume_ml_uncertainty", "ml", "half-width of its 95 % interval"},
      {"azimuths", "", "slices of a scan that have an angle"},
      {"azimuth_sd_deg", "°", "standard deviation between them"},
      {"definition", "", "by which definition of the angle it is; empty: a window of one's own",
       true},
  });
  return kColumns;
}

}  // namespace repose::calibrate
