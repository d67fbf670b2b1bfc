#include "calibrate/study/job_text.h"

#include <gtest/gtest.h>

namespace repose::calibrate {
namespace {

TEST(JobText, KeepsEveryBit) {
  const Job job{.experiment = "heap", .values = {.1, 1. / 3, 5e-324, -0.}, .seed = ~0ULL};
  EXPECT_EQ(job_in(text_of(job)), job);
  const SimulatedJob done{.run = {.job = job,
                                  .readings = {{"value", 23.4000000000000021}, {"at_rest", 1}},
                                  .failure = {}},
                          .wall_s = .25};
  const SimulatedJob back = simulated_job_in(text_of(done));
  EXPECT_EQ(back.run.job, job);
  EXPECT_EQ(back.run.readings, done.run.readings);
  EXPECT_EQ(back.wall_s, .25);
}

TEST(JobText, AFailureKeepsItsReason) {
  const SimulatedJob done{.run = {.job = {.experiment = "drop", .values = {}, .seed = 1},
                                  .readings = {},
                                  .failure = "the \"grains\"\nstay"},
                          .wall_s = 0};
  EXPECT_EQ(simulated_job_in(text_of(done)).run.failure, done.run.failure);
}

}  // namespace
}  // namespace repose::calibrate
