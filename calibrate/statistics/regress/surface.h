#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "calibrate/statistics/regress/regression.h"

/// Results of a fitted surface: its shape, its extremes within the runs' box, and where it takes a
/// target value.

namespace repose::calibrate {

struct SurfacePoint {
  std::vector<double> coded;
  std::vector<double> natural;
  double value = 0;
  double uncertainty = 0;  ///< half-width of the surface's 95 % interval there
};

/// One of the principal directions of a quadratic surface.
struct CanonicalAxis {
  double curvature = 0;    ///< eigenvalue of B: the surface rises by it times the distance squared
  double uncertainty = 0;  ///< half-width of its 95 % interval
  std::vector<double> direction;  ///< coded, length 1

  bool is_certain() const { return curvature > uncertainty || curvature < -uncertainty; }
};

enum class SurfaceShape { minimum, maximum, saddle };

/// Where in the box that the runs span the surface may be stationary.
struct StationaryRegion {
  bool is_in_box = false;  ///< false: at no point of the box
  /// Natural levels of each factor in the region, from a grid, rounded outwards to its next lines.
  /// An end is empty if the box ends first: runs beyond would be needed to find it. Empty without a
  /// region.
  std::vector<std::array<std::optional<double>, 2>> ranges;
};

/// The 95 % confidence region of the stationary point: all x with d' V^-1 d <= k F(.95; k, df), d
/// the slopes at x with respect to the k factors, V their covariance, df that of the residual. Box
/// and Hunter (1954), Biometrika 41, 190. Quadratic models of at most four factors; std::nullopt
/// for others and for an exact fit. Proved by StationaryRegion.* in
/// tests/calibrate/regress_surface_test.cpp.
std::optional<StationaryRegion> stationary_region(const Regression& regression);

/// A quadratic surface in its own axes: y = y_s + sum of curvature_i w_i^2.
struct CanonicalForm {
  std::vector<CanonicalAxis> axes;              ///< by increasing curvature
  std::optional<SurfacePoint> stationary;       ///< std::nullopt if the surface has no unique one
  bool is_inside = false;                       ///< of the box
  std::optional<StationaryRegion> region = {};  ///< see stationary_region()
  SurfaceShape shape = SurfaceShape::saddle;    ///< from the signs alone
};

/// Canonical analysis: Montgomery, sec. 11.3.2. The uncertainty of a curvature v'Bv takes its
/// direction v as given: Bisgaard and Ankenman (1996), Technometrics 38, 238. Quadratic models
/// only.
std::optional<CanonicalForm> canonical_form(const Regression& regression);

struct BoxExtremes {
  SurfacePoint least;
  SurfacePoint greatest;
};

/// The lowest and the highest point of the surface within the box of the runs. Exact: each face of
/// the box (interior, faces, edges, corners) is solved separately.
BoxExtremes extremes_in_box(const Regression& regression);

/// Where the surface takes the target value on a straight line along a factor.
struct Crossing {
  std::size_t factor = 0;
  SurfacePoint point;
  /// Natural levels around the point at which the surface does not differ significantly from the
  /// target value: a 95 % interval after Fieller (1954), J. R. Stat. Soc. B 16, 175, on a line for
  /// any polynomial. An end is empty if the box ends first: runs beyond would be needed to find it.
  std::array<std::optional<double>, 2> interval;
};

/// A target response, with the half-width of its 95 % interval; 0: exact.
struct WantedValue {
  double value = 0;
  double uncertainty = 0;
};

/// All points of the box at which the surface takes a target value.
struct TargetSet {
  WantedValue target;
  bool is_reached = false;
  /// Coded levels of each factor in the set, as intervals.
  std::vector<std::vector<std::array<double, 2>>> ranges;
  std::vector<Crossing> through_centre;  ///< on the lines through the box's centre
  std::vector<Crossing> grid;            ///< on a grid of lines
};

TargetSet solve_target(const Regression& regression, const WantedValue& target);

struct SurfaceDiagnostic {
  std::string code;  ///< a fixed keyword
  std::string message;
};

/// Objections a careful reader would raise; a sentence each.
/// @param names  how the user gives "target value"
std::vector<SurfaceDiagnostic> diagnostics_of(const Regression& regression,
                                              const std::optional<CanonicalForm>& form,
                                              const BoxExtremes& extremes,
                                              const std::optional<TargetSet>& target,
                                              base::FieldNames names = {});

}  // namespace repose::calibrate
