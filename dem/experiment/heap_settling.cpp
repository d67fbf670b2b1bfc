#include "dem/experiment/heap_settling.h"

#include "dem/experiment/rest_test.h"

namespace repose::dem {
void begin_settling(ExperimentRun& run, HeapStage stage) {
  HeapProgress& progress = run.progress();
  progress.stage = stage;
  progress.rest = {};
  progress.until_s = run.simulation().time_s() + kLongestSettling_s;
}

bool settle(ExperimentRun& run, double fraction) {
  HeapProgress& progress = run.progress();
  RestTest rest(run.simulation().setup(), progress.rest);
  while (!rest.is_at_rest(run.simulation())) {
    if (run.simulation().time_s() > progress.until_s) return false;
    progress.rest = rest.memory();
    run.advance_for(rest.interval_s());
    run.report_progress(fraction);
  }
  return true;
}

}  // namespace repose::dem
