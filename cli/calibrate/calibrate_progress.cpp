#include "cli/calibrate/calibrate_progress.h"

#include <cstdio>

#include <fmt/format.h>

#include "cli/common/output.h"

namespace repose::cli {

void StudyProgressLine::report(const calibrate::StudyProgress& progress) {
  if (progress.stage != stage_) {
    stage_ = progress.stage;
    line_.begin_stage();
    if (!line_.is_shown()) {
      print_error_text(fmt::format("{}: {} simulations\n", progress.stage, progress.of));
    }
  }
  line_.report(fmt::format("{}: {} of {} simulations", progress.stage, progress.done, progress.of),
               progress.seconds_of > 0 ? progress.seconds_done / progress.seconds_of : 0);
}

}  // namespace repose::cli
