#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "calibrate/statistics/factor.h"
#include "calibrate/statistics/regress/regression.h"

/// Experiment designs: which runs to make so that a response surface can be fitted to their
/// results. Runs are in standard order, levels coded: -1 and +1 are a factor's low and high. Each
/// function throws base::InputError with every error, one per line. THEORY.md has the definitions,
/// tests/calibrate/design_test.cpp the proofs.

namespace repose::calibrate {

enum class PointKind { cube, edge, axial, centre, spread, step };

struct DesignRun {
  std::vector<double> coded;  ///< one for each factor
  PointKind kind = PointKind::cube;
  int standard = 0;  ///< position in standard order, from 1
};

struct Design {
  std::vector<Factor> factors;
  std::vector<DesignRun> runs;
};

/// How far the axial points of a central composite design lie from the centre.
enum class AxialRule {
  rotatable,   ///< the same variance at the same distance from the centre: alpha = F^(1/4)
  orthogonal,  ///< squares are uncorrelated: alpha^2 = (sqrt(F N) - F) / 2
  face,        ///< on the cube's faces: alpha = 1, three levels
};

struct CompositeOptions {
  AxialRule rule = AxialRule::rotatable;
  std::optional<double> alpha;  ///< instead of the rule's
  int centre_runs = 6;
  /// The axial points are at low and high, with the cube inside: nothing lies beyond.
  bool is_inscribed = false;
};

/// Box and Wilson (1951): the 2^k corners of a cube (first factor fastest), two axial points for
/// each factor (-alpha, +alpha), centre runs. 2 to 6 factors; the cube is always whole.
Design central_composite(const std::vector<Factor>& factors, const CompositeOptions& options = {});

/// Box and Behnken (1960), Technometrics 2, 455: three levels, no corners. 3 to 7 factors. By
/// default as many `centre_runs` as in the paper: 3, 3, 6, 6, 6.
Design box_behnken(const std::vector<Factor>& factors, std::optional<int> centre_runs = {});

/// McKay, Beckman, Conover (1979): each factor has `runs` equally spaced levels, (i + 1/2) / runs
/// of its range, each used once. Pairs of levels are exchanged to spread the points (maximin, by
/// the criterion of Morris and Mitchell, 1995). The same seed gives the same design everywhere. 1
/// to 20 factors, 2 to 2000 runs.
Design latin_hypercube(const std::vector<Factor>& factors, int runs, std::uint64_t seed);

/// Varies one factor at a time over `levels` equally spaced levels from low to high, with the
/// others in the middle of their range.
Design sweep(const std::vector<Factor>& factors, int levels);

/// `runs` runs along a straight line, beginning at `start`, one `step` apart (both natural, one
/// value for each factor). Box and Wilson's steepest ascent with a known direction.
Design line_of_runs(const std::vector<std::string>& names, const std::vector<double>& start,
                    const std::vector<double>& step, int runs);

/// Puts the runs in random order, so that drift in time does not bias the effects. Deterministic.
void randomise_order(Design& design, std::uint64_t seed);

/// "cube", "axial", ...
std::string name_of(PointKind kind);

/// Runs up (or down) the slope of a fitted first-order surface, starting at the centre of its
/// factors: each step changes the coded factors in proportion to their coefficients, and the
/// steepest one by `stride`. Box and Wilson (1951); Montgomery, sec. 11.2. Proved by
/// SteepestAscent.* in tests/calibrate/design_test.cpp.
///
/// @throws base::InputError  every error: a model with other terms, a stride that is not above 0, a
/// flat surface, too few runs.
Design steepest_ascent(const Regression& regression, int runs, double stride, bool descends);

}  // namespace repose::calibrate
