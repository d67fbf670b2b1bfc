#pragma once

#include <string>

#include "calibrate/study/job_runner.h"

namespace repose::calibrate {

/// Completed fraction of a study's work, from its successive reports.
class StudyWork {
 public:
  void add(const StudyProgress& progress) {
    is_new_stage_ = progress.stage != stage_;
    if (is_new_stage_) earlier_s_ += stage_s_;
    stage_ = progress.stage;
    stage_s_ = progress.seconds_done;
    const double all_s = earlier_s_ + progress.seconds_of + progress.seconds_later.value_or(0);
    const bool is_known = progress.seconds_later && all_s > 0;
    fraction_ = is_known ? (earlier_s_ + stage_s_) / all_s : 0;
  }

  /// Whether the last report began a stage.
  bool is_new_stage() const { return is_new_stage_; }
  /// 0 if it is not known.
  double fraction() const { return fraction_; }

 private:
  std::string stage_;
  bool is_new_stage_ = false;
  double earlier_s_ = 0;  ///< work of the stages before this one
  double stage_s_ = 0;    ///< work done in this one
  double fraction_ = 0;
};

}  // namespace repose::calibrate
