#include "calibrate/fit/plausible.h"

#include <algorithm>
#include <cmath>

#include "calibrate/fit/fit_watch.h"
#include "calibrate/fit/points.h"

namespace repose::calibrate {
namespace {

constexpr std::size_t kParticles = 300;
constexpr double kWide = .25;
constexpr int kMoves = 3;       // after each step
constexpr int kLastMoves = 12;  // after the steps whose result is returned

struct Particle {
  Point point;
  double chi2 = 0;
};

/// Effective fraction of the particles if the misfit's weight grew by `step`.
double effective_fraction(const std::vector<Particle>& particles, double least, double step) {
  double sum = 0;
  double sum2 = 0;
  for (const Particle& particle : particles) {
    const double weight = std::exp(-step * (particle.chi2 - least) / 2);
    sum += weight;
    sum2 += weight * weight;
  }
  return sum * sum / sum2 / static_cast<double>(particles.size());
}

double least_chi2(const std::vector<Particle>& particles) {
  const auto least =
      std::min_element(particles.begin(), particles.end(),
                       [](const Particle& a, const Particle& b) { return a.chi2 < b.chi2; });
  return least->chi2;
}

/// The largest step up to `most` that keeps half of the particles effective.
double next_step(const std::vector<Particle>& particles, double most) {
  const double least = least_chi2(particles);
  if (effective_fraction(particles, least, most) >= .5) return most;
  double low = 0;
  double high = most;
  for (int i = 0; i < 40; ++i) {
    const double middle = (low + high) / 2;
    (effective_fraction(particles, least, middle) >= .5 ? low : high) = middle;
  }
  return low > 0 ? low : high;
}

/// Systematic resampling: Kitagawa (1996), J. Comput. Graph. Stat. 5, 1, appendix.
void resample(std::vector<Particle>& particles, double step, Random& random) {
  const double least = least_chi2(particles);
  std::vector<double> weights;
  double sum = 0;
  for (const Particle& particle : particles) {
    weights.push_back(std::exp(-step * (particle.chi2 - least) / 2));
    sum += weights.back();
  }
  const double stride = sum / static_cast<double>(particles.size());
  double mark = stride * random.uniform();
  double passed = 0;
  std::vector<Particle> chosen;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    passed += weights[i];
    for (; mark < passed && chosen.size() < particles.size(); mark += stride) {
      chosen.push_back(particles[i]);
    }
  }
  while (chosen.size() < particles.size()) chosen.push_back(particles.back());
  particles = std::move(chosen);
}

/// One proposal for each particle, at the misfit's weight `power`.
void move(const Misfit& misfit, double power, double reach, std::vector<Particle>& particles,
          Random& random) {
  stop_if_interrupted();
  const std::vector<Particle> others = particles;
  const double stride = reach * 2.38 / std::sqrt(2 * static_cast<double>(misfit.dimensions()));
  for (Particle& particle : particles) {
    const Point& a = others[random.below(others.size())].point;
    const Point& b = others[random.below(others.size())].point;
    Point point = particle.point;
    bool inside = true;
    for (std::size_t j = 0; j < point.size(); ++j) {
      point[j] += stride * (a[j] - b[j]) + 1e-3 * random.normal();
      inside = inside && point[j] >= 0 && point[j] <= 1;
    }
    const double luck = random.uniform();
    if (!inside) continue;
    const double chi2 = misfit.chi2(point);
    if (std::log(luck) < -power * (chi2 - particle.chi2) / 2) particle = {point, chi2};
  }
}

void move_often(const Misfit& misfit, double power, int times, std::vector<Particle>& particles,
                Random& random) {
  for (int i = 0; i < times; ++i) {
    move(misfit, power, i % 2 == 0 ? 1 : .3, particles, random);
  }
}

/// Raises the weight of the misfit from `power` to `until`.
void temper(const Misfit& misfit, double& power, double until, std::vector<Particle>& particles,
            Random& random) {
  while (power < until) {
    const double step = next_step(particles, until - power);
    resample(particles, step, random);
    power = until - power - step < 1e-12 ? until : power + step;
    move_often(misfit, power, power < until ? kMoves : kLastMoves, particles, random);
  }
}

std::vector<Point> points_of(const std::vector<Particle>& particles) {
  std::vector<Point> points;
  for (const Particle& particle : particles) points.push_back(particle.point);
  return points;
}

}  // namespace

PosteriorSamples posterior_samples(const Misfit& misfit, std::uint64_t seed) {
  Random random(seed);
  std::vector<Particle> particles;
  for (std::size_t i = 0; i < kParticles; ++i) {
    const Point point = sequence_point(i, misfit.dimensions());
    particles.push_back({point, misfit.chi2(point)});
  }
  PosteriorSamples sets;
  double power = 0;
  temper(misfit, power, kWide, particles, random);
  sets.wide = points_of(particles);
  temper(misfit, power, 1, particles, random);
  sets.points = points_of(particles);
  return sets;
}

Point mean_of(const std::vector<Point>& points) {
  Point mean(points.front().size(), 0);
  for (const Point& point : points) {
    for (std::size_t j = 0; j < mean.size(); ++j) mean[j] += point[j];
  }
  for (double& x : mean) x /= static_cast<double>(points.size());
  return mean;
}

Point sd_of(const std::vector<Point>& points) {
  const Point mean = mean_of(points);
  Point sd(mean.size(), 0);
  for (const Point& point : points) {
    for (std::size_t j = 0; j < mean.size(); ++j) {
      sd[j] += (point[j] - mean[j]) * (point[j] - mean[j]);
    }
  }
  for (double& x : sd) x = std::sqrt(x / static_cast<double>(points.size()));
  return sd;
}

}  // namespace repose::calibrate
