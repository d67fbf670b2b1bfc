#include "base/distributions.h"

#include <gmock/gmock.h>

namespace repose::base {
namespace {

// Montgomery, Design and Analysis of Experiments, appendix: tables of t, F and chi-square.
TEST(Distributions, GiveWhatTheTablesGive) {
  EXPECT_NEAR(student_t_quantile(.975, 1), 12.706, 1e-3);
  EXPECT_NEAR(student_t_quantile(.975, 10), 2.228, 1e-3);
  EXPECT_NEAR(student_t_above(2.228, 10), .025, 1e-4);
  EXPECT_NEAR(fisher_f_above(4.96, 1, 10), .05, 1e-4);
  EXPECT_NEAR(fisher_f_above(3.33, 5, 10), .05, 1e-3);
  EXPECT_NEAR(chi_square_above(9.488, 4), .05, 1e-4);
  EXPECT_NEAR(chi_square_exceeded(.05, 4), 9.488, 1e-3);
}

TEST(Distributions, ASquareOfTIsAnF) {
  for (const double t : {.3, 1., 2.5}) {
    EXPECT_NEAR(2 * student_t_above(t, 7), fisher_f_above(t * t, 1, 7), 1e-12);
  }
}

TEST(Distributions, MuchFreedomIsTheNormalDistribution) {
  EXPECT_NEAR(student_t_quantile(.975, 1e7), 1.959964, 1e-6);
}

}  // namespace
}  // namespace repose::base
