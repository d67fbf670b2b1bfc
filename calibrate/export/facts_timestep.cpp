#include <cmath>
#include <numbers>

#include "base/units.h"
#include "calibrate/export/facts.h"
#include "dem/experiment/bonded.h"
#include "dem/experiment/hanging_pair.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/placing.h"

namespace repose::calibrate {
namespace {

/// Other programs do not average the first and last step of an impact as ours does.
constexpr double kTimestepFraction = .5;

/// That gives the speed of the fastest impact that an experiment may see.
double fall_m(const ExportFacts& facts, dem::Experiment experiment) {
  const dem::Study& study = facts.study();
  const double reach = facts.grain().reach_m();
  switch (experiment) {
    case dem::Experiment::drop:
      return study.protocol<dem::DropProtocol>().height_m;
    case dem::Experiment::tilt:
      return .01 * reach;
    case dem::Experiment::roll: {
      const dem::RollProtocol& roll = study.protocol<dem::RollProtocol>();
      return reach + roll.release_m * std::sin(roll.incline_deg * std::numbers::pi / 180);
    }
    case dem::Experiment::drop_on_grains:
      return study.protocol<dem::GrainDropProtocol>().height_m;
    case dem::Experiment::tilt_on_grains:
    case dem::Experiment::roll_on_grains:
      return dem::diameter_m(facts.grain());
    case dem::Experiment::fill: {
      const dem::FillProtocol& fill = study.protocol<dem::FillProtocol>();
      return fill.tube_height_m + fill.pour_m;
    }
    case dem::Experiment::pendulum:
      return dem::release_height_m(study.protocol<dem::PendulumProtocol>());
    case dem::Experiment::draw_down: {
      const dem::DrawDownProtocol& boxes = study.protocol<dem::DrawDownProtocol>();
      return boxes.fill_m + boxes.drop_m;
    }
    case dem::Experiment::heap:
      break;
  }
  return 8 * reach;  // grains that rain into a tube
}

}  // namespace

double ExportFacts::speed_m_s(dem::Experiment experiment) const {
  return std::sqrt(2 * kStandardGravity_m_s2 * fall_m(*this, experiment));
}

double ExportFacts::timestep_s(dem::Experiment experiment) const {
  dem::Model model = dem::model_for(study_, experiment);
  model.timestep_fraction = kTimestepFraction;
  model.timestep_s = {};
  dem::ClumpShape shape = grain();
  if (experiment == dem::Experiment::tilt) shape = tilt_body();
  if (experiment == dem::Experiment::tilt_on_grains) {
    shape = dem::bonded_shape(shape, study_.protocol<dem::GrainTiltProtocol>().bonded);
  }
  std::vector<dem::Wall> walls;
  if (experiment != dem::Experiment::pendulum) walls.push_back(dem::study_wall(dem::Plane{}));
  return dem::model_setup(model, shape, walls, speed_m_s(experiment)).timestep_s;
}

}  // namespace repose::calibrate
