#include "calibrate/study/job_text.h"

#include <gtest/gtest.h>

namespace repose::calibrate {
namespace {

TEST(JobText, KeepsEveryBit) {
  const Job job{.experiment = "heap",
                .values = {.1, 1. / 3, 5e-324, -0.},
                .seed = ~0ULL,
                .inputs = {.stiffness = .1, .spheres = 1. / 3}};
  EXPECT_EQ(job_in(text_of(job)), job);
  SimulatedJob done{.job = job, .run = {}};
  done.run.value = 23.4000000000000021;
  done.run.readings = {{"height_mm", 1. / 3}, {"at_rest", 1}};
  done.run.timestep_s = 1e-5 / 3;
  done.run.views = {{.azimuth_rad = .1, .picture = {vision::MeasureStatus::flagged, 1. / 7}},
                    {.azimuth_rad = .2, .picture = {vision::MeasureStatus::refused, {}}}};
  done.run.wall_s = .25;
  const SimulatedJob back = simulated_job_in(text_of(done));
  EXPECT_EQ(back.job, job);
  EXPECT_EQ(run_of(back).readings, run_of(done).readings);
  EXPECT_EQ(run_of(back).readings.at("views_flagged"), 1);
  EXPECT_EQ(back.run.wall_s, .25);
}

TEST(JobText, AFailureKeepsItsReason) {
  SimulatedJob done{.job = {.experiment = "drop", .values = {}, .seed = 1}, .run = {}};
  done.run.failure = "the \"grains\"\nstay";
  EXPECT_EQ(simulated_job_in(text_of(done)).run.failure, done.run.failure);
}

}  // namespace
}  // namespace repose::calibrate
