#include "calibrate/study/run_cost.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dem/experiment/model_setup.h"

namespace repose::calibrate {
namespace {

// Of a core of 2020 or so; only their ratios matter much.
constexpr double kHeapStep_s = 2.4e-8;  // per grain, per sphere of it
constexpr double kAloneStep_s = 1.5e-6;

/// Time step of grains on a plane, s. Coefficients still open do not matter much to it.
double timestep_s(const dem::Study& study, const dem::ClumpShape& grain, dem::Experiment experiment,
                  double speed_m_s) {
  dem::Model model = dem::model_for(study, experiment);
  for (dem::PairCoefficients* pair : {&model.grain_wall, &model.grain_grain}) {
    for (double* value : {&pair->restitution, &pair->sliding_friction, &pair->rolling_friction}) {
      if (std::isnan(*value)) *value = .3;
    }
  }
  return dem::model_setup(model, grain, {dem::study_wall(dem::Plane{})}, speed_m_s).timestep_s;
}

double grains_in(const dem::HeapProtocol& heap, const dem::ClumpShape& grain) {
  constexpr double kPacked = .6;
  const double radius = heap.tube_diameter_m / 2;
  const double tube_m3 = std::numbers::pi * radius * radius * heap.tube_height_m;
  const double full = kPacked * tube_m3 / grain.volume_m3;
  return heap.grains ? std::min<double>(*heap.grains, full) : full;
}

}  // namespace

double run_cost_s(const dem::Study& study, const dem::ClumpShape& grain,
                  dem::Experiment experiment) {
  constexpr double kDropSpeed_m_s = 3, kSlowSpeed_m_s = 1, kRoll_s = 3, kTilt_s = 2,
                   kBounce_s = .01;
  switch (experiment) {
    case dem::Experiment::drop:
      return kAloneStep_s * study.drop->grains * kBounce_s /
             timestep_s(study, grain, experiment, kDropSpeed_m_s);
    case dem::Experiment::tilt:
      return kAloneStep_s * kTilt_s / timestep_s(study, grain, experiment, kSlowSpeed_m_s);
    case dem::Experiment::roll:
      return kAloneStep_s * kRoll_s / timestep_s(study, grain, experiment, kSlowSpeed_m_s);
    case dem::Experiment::heap:
      break;
  }
  const dem::HeapProtocol& heap = *study.heap;
  // Once the tube is a diameter up, what is left in it falls out.
  constexpr double kFillAndSettle_s = 1.5, kFallSpeed_m_s = 2;
  const double simulated_s = heap.tube_diameter_m / heap.lift_speed_m_s + kFillAndSettle_s;
  return kHeapStep_s * static_cast<double>(grain.spheres.size()) * grains_in(heap, grain) *
         simulated_s / timestep_s(study, grain, experiment, kFallSpeed_m_s);
}

}  // namespace repose::calibrate
