#include "calibrate/fit/propose.h"

#include "calibrate/fit/rounds.h"

namespace repose::calibrate {

std::vector<Job> propose(const Problem& problem, const std::vector<Run>& completed) {
  require_sound(problem);
  return reconstruct_rounds(problem, completed).missing;
}

}  // namespace repose::calibrate
