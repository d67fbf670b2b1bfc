#pragma once

#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "calibrate/statistics/summary.h"

/// Bench tests: from raw readings to the measured quantity with its scatter and interval.

namespace repose::calibrate {

/// From one reading of a bench test to the quantity it measures. SI units. "Paper" is the hazelnut
/// study whose chain of tests this program follows; THEORY.md lists the errors in its printed
/// equations. All are proved by BenchFormulas.* in tests/calibrate/bench_test.cpp.

/// e = sqrt(h / H), of a body that falls from H (m) and rises to h (m), both measured at the same
/// point of the body, from its height at impact. Paper, eqs. 3 to 5. Holds without drag and spin:
/// energy that a non-spherical body converts to spin counts as lost.
double restitution_of(double drop_m, double rebound_m);

/// mu = f / F_N = tan(theta), theta the incline (rad) at which a body that cannot roll begins to
/// slide. Paper, eqs. 7 to 9; its eq. 9 is printed upside down. 0 < theta < pi / 2.
double sliding_friction_of(double angle_rad);

/// mu_r = S sin(beta) / (S cos(beta) + L): released at rest S (m) up an incline of beta (rad), at
/// rest L (m) along the flat; rolling friction on both uses up the work of the weight. Paper, eq.
/// 11, whose text swaps S and L. Holds if nothing is lost at the foot and nothing slides.
double rolling_friction_of(double incline_rad, double released_m, double stopped_m);

/// The same for a ball of radius R (m), including its loss at the foot: the mu_r (up to that at
/// which it stays there) with L = rolled_distance_m(...). L must not be less than
/// foot_distance_m(...), nor S as small.
double rolling_friction_of(double incline_rad, double released_m, double stopped_m,
                           double radius_m);

/// R tan(beta / 2), from the foot to where a ball in the corner touches either plane: it meets the
/// flat before reaching the foot, and is then already past it.
double foot_distance_m(double incline_rad, double radius_m);

/// L = r^2 S' (sin(beta) - mu_r cos(beta)) / mu_r + R tan(beta / 2), S' = S - R tan(beta / 2):
/// distance along the flat (m) at which a ball comes to rest that is released S up the incline.
///
/// A torque mu_r F R against the spin slows rolling by 5/7 mu_r F / m, on both planes, so that the
/// ball meets the flat with v^2 = 10/7 g S' (sin(beta) - mu_r cos(beta)). There the flat removes
/// the component v sin(beta), by a total impulse m v sin(beta), however the ball bounces. About the
/// point of contact with the flat, the impulse has no moment but that of rolling friction, mu_r R m
/// v sin(beta); so the angular momentum goes from m v R (cos(beta) + 2/5) to 7/5 m r v R, r = (5
/// cos(beta) + 2) / 7 - 5/7 mu_r sin(beta), at least 0: r v is the speed along the flat (impulses:
/// E. J. Routh, The Elementary Part of a Treatise on the Dynamics of a System of Rigid Bodies, 7th
/// ed. 1905, chapter IV). Holds for balls that do not slide, on the incline, at the foot or on the
/// flat.
double rolled_distance_m(double mu_r, double incline_rad, double released_m, double radius_m);

/// e = 2 sin(alpha / 2) / sin(beta / 2) - 1: of two equal balls on strings, one is released at an
/// angle beta (rad), and the other, struck head-on, swings to alpha. It leaves with (1 + e) / 2 of
/// the speed (momentum, Newton's law of impact), and speeds go as the sines of half the angles.
double pendulum_restitution_of(double release_rad, double swing_rad);

/// rho = m / V, V the volume of liquid that the body displaces.
double density_of(double mass_kg, double displaced_m3);

/// E = (F / A) / (compression / height): stress over strain. Paper, eq. 1, which divides the stress
/// by the area once more. Exact for a bar; for a whole grain, with A the contact area and the
/// height of the grain, it is an apparent modulus.
double young_modulus_of(double force_n, double area_m2, double compression_m, double height_m);

/// nu = lateral strain / axial strain, widening and shortening both counted as positive. Paper, eq.
/// 2, whose symbols do not say which direction was pressed. Isotropic bodies: -1 < nu < 0.5.
double poisson_ratio_of(double widening, double width, double shortening, double height);

/// (L W T)^(1/3): the diameter of a sphere equivalent to the ellipsoid. Mohsenin, Physical
/// Properties of Plant and Animal Materials (1986), ch. 3.
double geometric_mean_diameter_of(double length, double width, double thickness);

/// (L W T)^(1/3) / L, 1 for a sphere. Mohsenin, ch. 3. L is the longest.
double sphericity_of(double length, double width, double thickness);

struct Method;
/// A bench test: one with a formula, or that of an experiment whose readings are simply averaged
/// (dem::MeanOfReadings).
using BenchTest = const Method*;

std::vector<std::string> bench_test_names();
/// @throws base::InputError  there is no such test.
BenchTest bench_test_named(std::string_view name);
std::string name_of(BenchTest test);

/// Something read in a test. A reading must lie between `above` and `below`.
struct ReadingColumn {
  std::string name;  ///< with its unit: "drop_mm"
  std::string what;
  double above = 0;
  double below = std::numeric_limits<double>::infinity();
};

/// Name of the optional column with the half-width of the 95 % interval of another column's cells,
/// as written by `repose track`: "drop_uncertainty_mm" for "drop_mm".
std::string uncertainty_column(std::string_view column);

/// The optional column of drops: 1 for heights read in air, 0 for those corrected to a fall without
/// it, as written by `repose track`.
inline constexpr std::string_view kInAirColumn = "in_air";

/// The readings of a test, in the order that evaluate_bench expects.
std::vector<ReadingColumn> columns_of(BenchTest test);

/// Optional values: of the grain, or of how it was measured.
std::vector<ReadingColumn> optional_columns_of(BenchTest test);

/// One repeat of a test.
struct BenchReading {
  std::string place;           ///< for messages: "drops.csv:4"
  std::vector<double> values;  ///< in the order and units of the columns
  std::string sample;          ///< repeats on one grain have the same name; empty: a separate grain
  std::map<std::string, double> optional = {};  ///< those of the optional columns that are given
};

/// A column's mean over the repeats on each sample, samples in the order of their first reading.
/// @throws base::InputError  the test has no such column.
std::vector<double> sample_means(BenchTest test, std::string_view column,
                                 std::span<const BenchReading> readings);

/// @throws base::InputError  every impossible reading, one per line: a rebound higher than the
/// drop, an incline of 90 degrees or more, Poisson's ratio outside (-1, 0.5), values that are not
/// finite, and so on; an optional column that only some readings have. Checked by
/// tests/calibrate/bench_test.cpp.
void check_readings(BenchTest test, std::span<const BenchReading> readings);

struct BenchQuantity {
  std::string name;  ///< "restitution"
  std::string unit;  ///< empty for a pure number
  std::string what;
  std::vector<double> values;  ///< of each grain
  calibrate::Summary repeats;  ///< of the values; a single one has no sd and no interval
};

struct BenchResult {
  std::vector<BenchQuantity> quantities;
  std::string source;              ///< the equation
  std::vector<std::string> notes;  ///< remarks on these readings, a sentence each
};

/// Evaluates each reading, averages repeats on the same sample, and summarises: mean, standard
/// deviation, Student's 95 % interval of the mean. Averages first, because repeats on one grain say
/// nothing about how much grains differ.
///
/// @throws base::InputError  as check_readings; or there are no readings.
BenchResult evaluate_bench(BenchTest test, std::span<const BenchReading> readings);

}  // namespace repose::calibrate
