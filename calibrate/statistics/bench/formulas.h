#pragma once

/// From one reading of a bench test to the quantity that it measures. SI units. "Paper" is the
/// hazelnut study whose chain of tests this program follows; THEORY.md lists what its printed
/// equations get wrong. All are proved by BenchFormulas.* in tests/calibrate/bench_test.cpp.
namespace repose::calibrate {

/// e = sqrt(h / H), of a body that falls from H (m) and rises to h (m), both from the same point of
/// the body to where that point is on impact. Paper, eqs. 3 to 5. Holds without drag and spin: what
/// a body that is no sphere loses to spin counts as lost.
double restitution_of(double drop_m, double rebound_m);

/// mu = f / F_N = tan(theta), theta the incline (rad) at which a body that cannot roll begins to
/// slide. Paper, eqs. 7 to 9; its eq. 9 is printed upside down. 0 < theta < pi / 2.
double sliding_friction_of(double angle_rad);

/// mu_r = S sin(beta) / (S cos(beta) + L): released at rest S (m) up an incline of beta (rad), at
/// rest L (m) along the flat; the weight's work is used up by rolling friction on both. Paper,
/// eq. 11, whose text swaps S and L. Holds where nothing is lost at the foot and nothing slides.
double rolling_friction_of(double incline_rad, double released_m, double stopped_m);

/// The same of a ball of radius R (m), with what it loses at the foot: the mu_r (up to that at
/// which it stays there) with L = rolled_distance_m(...). L may not be less than
/// foot_distance_m(...), nor S as small.
double rolling_friction_of(double incline_rad, double released_m, double stopped_m,
                           double radius_m);

/// R tan(beta / 2), from the foot to where a ball in the corner touches either plane: it meets the
/// flat before it is at the foot, and is past it then.
double foot_distance_m(double incline_rad, double radius_m);

/// L = r^2 S' (sin(beta) - mu_r cos(beta)) / mu_r + R tan(beta / 2), S' = S - R tan(beta / 2): how
/// far along the flat (m) a ball comes to rest that is released at rest S up the incline.
///
/// A torque mu_r F R against the spin slows rolling by 5/7 mu_r F / m, on both planes, so that the
/// ball meets the flat with v^2 = 10/7 g S' (sin(beta) - mu_r cos(beta)). There the flat takes the
/// part v sin(beta) of it, by an impulse m v sin(beta) in all, however the ball bounces. About the
/// point that it touches the flat at, the impulse has no moment but that of rolling friction,
/// mu_r R m v sin(beta); so the angular momentum goes from m v R (cos(beta) + 2/5) to
/// 7/5 m r v R, r = (5 cos(beta) + 2) / 7 - 5/7 mu_r sin(beta), 0 at least: r v is the speed along
/// the flat (impulses: E. J. Routh, The Elementary Part of a Treatise on the Dynamics of a System
/// of Rigid Bodies, 7th ed. 1905, chapter IV). Holds for balls that do not slide, on the incline,
/// at the foot or on the flat.
double rolled_distance_m(double mu_r, double incline_rad, double released_m, double radius_m);

/// e = 2 sin(alpha / 2) / sin(beta / 2) - 1: of two equal balls on strings one is let go at an
/// angle beta (rad), and the other, struck head-on, swings to alpha. It leaves with (1 + e) / 2 of
/// the speed (momentum, Newton's law of impact), and speeds go as the sines of half the angles.
double pendulum_restitution_of(double release_rad, double swing_rad);

/// rho = m / V, V the volume of liquid that the body displaces.
double density_of(double mass_kg, double displaced_m3);

/// E = (F / A) / (compression / height): stress over strain. Paper, eq. 1, which divides the stress
/// by the area once more. Exact for a bar; of a whole grain, A the contact's area and the height
/// the grain's, it is an apparent modulus.
double young_modulus_of(double force_n, double area_m2, double compression_m, double height_m);

/// nu = lateral strain / axial strain, widening and shortening both counted as positive. Paper,
/// eq. 2, whose letters do not say which direction was pressed. Isotropic bodies: -1 < nu < 0.5.
double poisson_ratio_of(double widening, double width, double shortening, double height);

/// (L W T)^(1/3): the diameter of a sphere in the ellipsoid's place. Mohsenin, Physical Properties
/// of Plant and Animal Materials (1986), ch. 3.
double geometric_mean_diameter_of(double length, double width, double thickness);

/// (L W T)^(1/3) / L, 1 for a sphere. Mohsenin, ch. 3. L is the longest.
double sphericity_of(double length, double width, double thickness);

}  // namespace repose::calibrate
