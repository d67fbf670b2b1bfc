#include "base/distributions.h"

#include <limits>

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
  EXPECT_NEAR(fisher_f_exceeded(.05, 5, 10), 3.33, 5e-3);
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

TEST(Distributions, EqualVariancesAddTheirFreedom) {
  EXPECT_DOUBLE_EQ(df_of_sum({2, 5}, {2, 5}), 10);
  EXPECT_DOUBLE_EQ(df_of_sum({3, 7}, {0, 2}), 7);
  EXPECT_DOUBLE_EQ(df_of_sum({4, 3}, {1, 6}), 25 / (16. / 3 + 1. / 6));
}

TEST(Distributions, WhatIsExactTakesNoFreedomAway) {
  constexpr double kExact = std::numeric_limits<double>::infinity();
  EXPECT_DOUBLE_EQ(df_of_sum({1, 4}, {1, kExact}), 16);
  EXPECT_EQ(df_of_sum({0, 4}, {0, 4}), kExact);
  EXPECT_EQ(df_of_sum({0, 0}, {0, 0}), kExact);
}

}  // namespace
}  // namespace repose::base
