#pragma once

/// Student's t, Fisher's F and chi-square, for intervals and tests. They have their own source file
/// because the library behind them compiles slowly.
namespace repose::base {

/// A normal variable lies within this many standard deviations of its mean with probability .95.
inline constexpr double kNormal95 = 1.959963984540054;

/// Degrees of freedom of quantities treated as known: Student's t is then practically normal.
inline constexpr double kManyDf = 1e6;

/// The t below which a variable of `df` > 0 degrees of freedom lies with `probability` (0 ... 1).
double student_t_quantile(double probability, double df);

/// The probability of a variable of `df` > 0 degrees of freedom above t.
double student_t_above(double t, double df);

/// The probability of a variable of `df1` and `df2` > 0 degrees of freedom above f >= 0.
double fisher_f_above(double f, double df1, double df2);

/// The f that an F variable exceeds with `probability` (above 0, at most 1).
double fisher_f_exceeded(double probability, double df1, double df2);

/// The probability of a sum of `df` > 0 squared standard normal variables above x >= 0.
double chi_square_above(double x, double df);

/// The x that such a sum exceeds with `probability` (above 0, at most 1).
double chi_square_exceeded(double probability, double df);

/// A variance and its degrees of freedom, infinite if it is exact.
struct EstimatedVariance {
  double variance = 0;
  double df = 0;
};

/// Degrees of freedom of the sum of two variances, infinite if both are 0: Welch (1947), Biometrika
/// 34, 28; Satterthwaite (1946), Biometrics Bull. 2, 110; GUM, G.2b.
double df_of_sum(const EstimatedVariance& one, const EstimatedVariance& other);

}  // namespace repose::base
