#include <array>
#include <charconv>
#include <cstdlib>
#include <string_view>

#include "calibrate/study/rank_executor.h"

namespace repose::calibrate {

bool is_launched_as_rank() {
  // Open MPI; MPICH and Intel MPI; Slurm, whose srun sets the last for every step.
  constexpr std::array kSizes = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"};
  for (const char* name : kSizes) {
    const char* text = std::getenv(name);
    if (text == nullptr) continue;
    const std::string_view size = text;
    int ranks = 0;
    std::from_chars(size.data(), size.data() + size.size(), ranks);
    if (ranks > 1) return true;
  }
  return false;
}

}  // namespace repose::calibrate
