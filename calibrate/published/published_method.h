#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibrate/fit/problem.h"
#include "calibrate/statistics/regress/surface_report.h"
#include "calibrate/study/job_runner.h"

/// The calibration of a published study of hazelnuts, step by step, for comparison: one coefficient
/// after the other, from single runs, minimising the absolute error of one heap. THEORY.md explains
/// what is wrong with it; the joint fit (fit/joint_fit.h) is what we recommend.
namespace repose::calibrate {

/// One wall coefficient, swept; a parabola through the runs is solved for the measured value.
struct PublishedSweep {
  std::string parameter;
  std::string observable;
  double measured = 0;
  std::vector<double> levels;
  std::vector<double> results;  ///< of one run each; levels whose run gave no reading are omitted
  double value = 0;             ///< at which a parabola through them equals the measured value
  bool is_reached = true;       ///< false: it does not, and `value` is where it is closest
  double r2 = 0;                ///< of the parabola
};

/// A heap with one set of particle–particle coefficients.
struct PublishedHeap {
  std::vector<double> coefficients;  ///< restitution, sliding, rolling
  std::optional<double> angle_deg;
  std::optional<double> error_percent;  ///< |angle - measured| / measured
};

struct PublishedOutcome {
  std::vector<PublishedSweep> sweeps;    ///< restitution, sliding, rolling, against the wall
  std::vector<PublishedHeap> ascent;     ///< steps along a straight line
  std::size_t best_step = 0;             ///< of them
  std::vector<PublishedHeap> composite;  ///< of the central composite design around the best
  SurfaceReport surface;       ///< of the error; its minimum within the design's box is the answer
  std::vector<double> values;  ///< all six, as in Problem::parameters
  std::vector<PublishedHeap> verification;
  std::vector<Run> checks;      ///< the runs of these
  NamedAngles heap_angles_deg;  ///< of these (job_runner.h)
  double measured_angle_deg = 0;
};

/// Runs it. All six coefficients must be free and all four experiments measured. std::nullopt if it
/// was interrupted.
/// @throws base::InputError  the study is incomplete, or too few runs gave a reading.
std::optional<PublishedOutcome> calibrate_as_published(const Problem& problem,
                                                       const StudyContext& context);

}  // namespace repose::calibrate
