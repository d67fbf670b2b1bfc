#pragma once

/// Drag of the air on grains that fall and rise upright in bench tests. Proved by AirDrag.* in
/// tests/base/air_drag_test.cpp.
namespace repose::base {

/// A grain in free fall.
struct FallingGrain {
  double diameter_m = 0;  ///< of the sphere of its volume
  double density_kg_m3 = 0;
  double sphericity = 1;  ///< surface of that sphere by its own (Wadell)
};

/// C_d, by the area of the sphere of the grain's volume. Of spheres 24 / Re (1 + .15 Re^.687), from
/// Re = 1000 on .44: Schiller, Naumann (1933), Z. Ver. Dtsch. Ing. 77, 318; within 5 % of the
/// standard curve up to Re = 1000, within 13 % up to 2e5 (Clift, Grace, Weber: Bubbles, Drops, and
/// Particles, 1978, chapter 5). Of other grains as much larger as Haider and Levenspiel (1989),
/// Powder Technology 58, 63, eq. (12), have it for their sphericity. Any pose is as likely.
double drag_coefficient(double reynolds, double sphericity);

/// Standard uncertainty of the drag as a fraction of it: of spheres 7 %, 5 % each of the law and of
/// the air, whose density weather and height above the sea change; of others 20 %, which such laws
/// miss by in the mean (Chhabra, Agarwal, Sinha 1999, Powder Technology 101, 288).
double drag_uncertainty(const FallingGrain& grain);

/// Speed of a grain that has fallen from rest, and with which one must leave to rise, m/s. Drag and
/// buoyancy of air of 20 C and 1013 hPa; not the air that it takes along, which is 1/2 of the mass
/// displaced, below .1 % of a grain's.
double speed_after_fall_m_s(const FallingGrain& grain, double fall_m);
double speed_before_rise_m_s(const FallingGrain& grain, double rise_m);

/// How high a grain would rise without air, that falls from `fall_m` and rises to `rise_m` with it:
/// (v' / v)^2 fall_m, v and v' its speeds before and after the impact, whose ratio is taken not to
/// depend on v.
double rise_without_air_m(const FallingGrain& grain, double fall_m, double rise_m);

}  // namespace repose::base
