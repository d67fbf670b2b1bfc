#pragma once

/// Air drag on grains that fall and rise vertically in bench tests. Proved by AirDrag.* in
/// tests/base/air_drag_test.cpp.
namespace repose::base {

/// A grain in free fall.
struct FallingGrain {
  double diameter_m = 0;  ///< of the sphere of equal volume
  double density_kg_m3 = 0;
  double sphericity = 1;  ///< surface of that sphere / surface of the grain (Wadell)
};

/// C_d, referred to the cross-section of the sphere of equal volume. For spheres 24 / Re (1 + .15
/// Re^.687), and .44 from Re = 1000 on: Schiller, Naumann (1933), Z. Ver. Dtsch. Ing. 77, 318;
/// within 5 % of the standard curve up to Re = 1000, within 13 % up to 2e5 (Clift, Grace, Weber:
/// Bubbles, Drops, and Particles, 1978, chapter 5). For other grains it is larger by the factor
/// that Haider and Levenspiel (1989), Powder Technology 58, 63, eq. (12), give for their
/// sphericity. All orientations are equally likely.
double drag_coefficient(double reynolds, double sphericity);

/// Relative standard uncertainty of the drag: 7 % for spheres, 5 % each from the law and from the
/// air, whose density varies with weather and altitude; 20 % for others, the mean error of such
/// laws (Chhabra, Agarwal, Sinha 1999, Powder Technology 101, 288).
double drag_uncertainty(const FallingGrain& grain);

/// Speed of a grain that has fallen from rest, and the speed at which it must leave to rise that
/// high, m/s. Drag and buoyancy of air at 20 C and 1013 hPa; without the added mass, half of the
/// displaced air, which is below .1 % of a grain's mass.
double speed_after_fall_m_s(const FallingGrain& grain, double fall_m);
double speed_before_rise_m_s(const FallingGrain& grain, double rise_m);

/// How high a grain that falls from `fall_m` and rises to `rise_m` in air would rise without air:
/// (v' / v)^2 fall_m, with v and v' its speeds before and after the impact. Their ratio is assumed
/// not to depend on v.
double rise_without_air_m(const FallingGrain& grain, double fall_m, double rise_m);

}  // namespace repose::base
