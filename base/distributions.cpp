#include "base/distributions.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/fisher_f.hpp>
#include <boost/math/distributions/students_t.hpp>

namespace repose::base {

double student_t_quantile(double probability, double df) {
  return quantile(boost::math::students_t(df), probability);
}

double student_t_above(double t, double df) {
  return cdf(complement(boost::math::students_t(df), t));
}

double fisher_f_above(double f, double df1, double df2) {
  return cdf(complement(boost::math::fisher_f(df1, df2), f));
}

double chi_square_above(double x, double df) {
  return cdf(complement(boost::math::chi_squared(df), x));
}

double chi_square_exceeded(double probability, double df) {
  return quantile(complement(boost::math::chi_squared(df), probability));
}

}  // namespace repose::base
