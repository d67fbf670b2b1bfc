#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/heap_random.h"
#include "vision/measure/line_fit.h"

namespace repose::vision {
namespace {

constexpr std::size_t kPoints = 600;
constexpr std::size_t kGrain = 12;  // points that share their noise
constexpr std::size_t kBlock = 2 * kGrain;

std::vector<double> positions() {
  std::vector<double> x;
  for (std::size_t i = 0; i < kPoints; ++i) x.push_back(static_cast<double>(i));
  return x;
}

/// Residuals of the least-squares line through level noise, and that line's slope. The noise is a
/// moving average over kGrain normal numbers, so neighbours are correlated.
struct Realisation {
  double slope = 0;
  std::vector<double> residual;
};

Realisation realisation(testing::Random& random) {
  std::vector<double> white;
  for (std::size_t i = 0; i < kPoints + kGrain; ++i) white.push_back(random.normal(0, 1));
  std::vector<double> y;
  for (std::size_t i = 0; i < kPoints; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < kGrain; ++k) sum += white[i + k];
    y.push_back(sum / kGrain);
  }
  const std::vector<double> x = positions();
  const LineFit line = least_squares_line(x, y);
  for (std::size_t i = 0; i < kPoints; ++i) y[i] -= line.y(x[i]);
  return {line.slope, y};
}

/// The textbook standard error of a slope, for residuals that are independent.
double plain_slope_error(const std::vector<double>& residual) {
  double squares = 0;
  for (const double r : residual) squares += r * r;
  const double n = kPoints;
  const double sxx = n * (n * n - 1) / 12;
  return std::sqrt(squares / (n - 2) / sxx);
}

TEST(BlockBootstrap, IsTheScatterOfTheSlopeWhereNeighboursBelongTogether) {
  constexpr int kRealisations = 400;  // determine the scatter to 1 / sqrt(800) = 3.5 %
  testing::Random random(7);
  double scatter = 0;
  double bootstrap = 0;
  double plain = 0;
  for (int i = 0; i < kRealisations; ++i) {
    const Realisation drawn = realisation(random);
    const double error = block_bootstrap_slope_error(positions(), drawn.residual, kBlock, 1);
    scatter += drawn.slope * drawn.slope / kRealisations;
    bootstrap += error * error / kRealisations;
    plain += std::pow(plain_slope_error(drawn.residual), 2) / kRealisations;
  }
  // Blocks of twice the correlation length lose some of it at their ends: a few per cent low.
  EXPECT_NEAR(std::sqrt(bootstrap / scatter), 1, 0.2);
  EXPECT_LT(std::sqrt(plain / scatter), 0.4) << "12 points count as one: sqrt(12) = 3.5 times";
}

TEST(BlockBootstrap, SameSeedGivesTheSameBits) {
  testing::Random random(3);
  const Realisation drawn = realisation(random);
  const auto error = [&](std::uint64_t seed) {
    return block_bootstrap_slope_error(positions(), drawn.residual, kBlock, seed);
  };
  EXPECT_EQ(error(5), error(5));
  EXPECT_NE(error(5), error(6));
  EXPECT_NEAR(error(6) / error(5), 1, 0.15);  // 300 resamples: 4 % each
}

TEST(BlockBootstrap, GrowsWithTheResiduals) {
  testing::Random random(4);
  Realisation drawn = realisation(random);
  const double once = block_bootstrap_slope_error(positions(), drawn.residual, kBlock, 1);
  for (double& r : drawn.residual) r *= 3;
  EXPECT_NEAR(block_bootstrap_slope_error(positions(), drawn.residual, kBlock, 1), 3 * once,
              1e-9 * once);
}

TEST(BlockBootstrap, NoScatterAndNoPointsHaveNoError) {
  const std::vector<double> zeros(kPoints, 0);
  EXPECT_EQ(block_bootstrap_slope_error(positions(), zeros, kBlock, 1), 0);
  EXPECT_EQ(block_bootstrap_slope_error({}, {}, kBlock, 1), 0);
}

TEST(BlockBootstrap, BlocksLongerThanTheEdgeAreShortened) {
  testing::Random random(5);
  const Realisation drawn = realisation(random);
  EXPECT_TRUE(
      std::isfinite(block_bootstrap_slope_error(positions(), drawn.residual, 10 * kPoints, 1)));
}

TEST(IndependentBlocks, AreAtLeastFour) {
  EXPECT_EQ(independent_blocks(600, 24), 25);
  EXPECT_EQ(independent_blocks(600, 0), 600);
  EXPECT_EQ(independent_blocks(30, 24), 4);
}

}  // namespace
}  // namespace repose::vision
