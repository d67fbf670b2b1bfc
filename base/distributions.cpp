#include "base/distributions.h"

#include <limits>

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

double fisher_f_exceeded(double probability, double df1, double df2) {
  return quantile(complement(boost::math::fisher_f(df1, df2), probability));
}

double chi_square_above(double x, double df) {
  return cdf(complement(boost::math::chi_squared(df), x));
}

double chi_square_exceeded(double probability, double df) {
  return quantile(complement(boost::math::chi_squared(df), probability));
}

double df_of_sum(const EstimatedVariance& one, const EstimatedVariance& other) {
  const double sum = one.variance + other.variance;
  double spread = 0;
  for (const EstimatedVariance& part : {one, other}) {
    if (part.variance > 0) spread += part.variance * part.variance / part.df;
  }
  return spread > 0 ? sum * sum / spread : std::numeric_limits<double>::infinity();
}

}  // namespace repose::base
