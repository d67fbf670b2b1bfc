#pragma once

/// Student's t and Fisher's F, for intervals and tests. They are in one source of their own: the
/// library that computes them takes long to compile.
namespace repose::base {

/// The t below which a variable of `df` > 0 degrees of freedom lies with `probability` (0 ... 1).
double student_t_quantile(double probability, double df);

/// The probability of a variable of `df` > 0 degrees of freedom above t.
double student_t_above(double t, double df);

/// The probability of a variable of `df1` and `df2` > 0 degrees of freedom above f >= 0.
double fisher_f_above(double f, double df1, double df2);

}  // namespace repose::base
