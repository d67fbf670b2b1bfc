#include "cli/calibrate/calibrate_progress.h"

#include <cstdio>

#include <fmt/format.h>

#include "cli/common/output.h"

namespace repose::cli {

void StudyProgressLine::report(const calibrate::StudyProgress& progress) {
  const bool is_new = progress.stage != stage_;
  if (is_new) earlier_s_ += stage_s_;
  stage_ = progress.stage;
  stage_s_ = progress.seconds_done;
  const double all_s = earlier_s_ + progress.seconds_of + progress.seconds_later.value_or(0);
  const bool is_known = progress.seconds_later && all_s > 0;
  const double fraction = is_known ? (earlier_s_ + stage_s_) / all_s : 0;
  if (is_new) {
    line_.show_next();
    if (!line_.is_shown()) {
      print_error_text(fmt::format("{}: {} simulations{}\n", progress.stage, progress.of,
                                   line_.left_text(fraction)));
    }
  }
  line_.report(fmt::format("{}: {} of {} simulations", progress.stage, progress.done, progress.of),
               fraction);
}

}  // namespace repose::cli
