#include <gtest/gtest.h>

#include "calibrate/study/executor.h"

namespace repose::calibrate {
namespace {

TEST(JobText, KeepsEveryBit) {
  const Job job{.experiment = "heap",
                .values = {.1, 1. / 3, 5e-324, -0.},
                .seed = ~0ULL,
                .inputs = {.stiffness = .1, .spheres = 1. / 3}};
  EXPECT_EQ(job_in(text_of(job)), job);
}

}  // namespace
}  // namespace repose::calibrate
