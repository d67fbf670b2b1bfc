#pragma once

#include <map>

#include "dem/experiment/experiment.h"

namespace repose::dem {

/// How long the steps of a bulk may be: by how fast its grains are now, not by the fastest that
/// they ever become.
///
/// An impact lasts as speed^(-1/5) (Johnson 1985, eq. 11.24): grains at a tenth of the speed are as
/// accurate in steps 1.6 times as long, and none is longer. Nor is it made longer than the contacts
/// there are allow: where grains press on each other they have speed in store, in the middle of an
/// impact or by the weight of what they carry. A time step that the model asks for stays. Proved by
/// Pace.* in tests/dem/pace_test.cpp.
class Pace {
 public:
  /// @param usual_speed_m_s  of the impacts that bulk_setup()'s time step is for
  Pace(const Model& model, double usual_speed_m_s);

  /// The step, s, of the next `ahead_s`, in which grains may fall. It is the step there is, unless
  /// another one is a good deal longer or must be shorter.
  double timestep_s(const Simulation& simulation, double ahead_s);

 private:
  double step_of(int rung);

  bool is_fixed_;
  double fraction_;  ///< of what is stable
  double usual_speed_m_s_;
  SimulationSetup setup_;         ///< without walls
  double usual_step_s_;           ///< the longest accurate one at that speed
  std::map<int, double> step_s_;  ///< of the rungs that were needed so far
};

}  // namespace repose::dem
