#pragma once

#include <string_view>
#include <vector>

#include "base/input_error.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/protocol_key.h"
#include "dem/shape/clump/clump_shape.h"
#include "dem/wall/wall.h"

namespace repose::dem {

/// Coverage of a board that can be glued without holes, and without grains on each other.
inline constexpr double kMinCoverage = .65;
inline constexpr double kMaxCoverage = .85;

/// Notes a coverage that is not between them, by the name of the experiment.
void find_coverage_error(std::string_view experiment, double coverage, base::Faults& errors);
ProtocolKey coverage_key(double& coverage);

/// A board (z = 0 of its frame) covered with one layer of grains that are glued on as they lie:
/// on their flattest side, turned anyhow about the vertical, at random places.
///
/// `coverage` is the part of the board that the grains hide, seen from above: each hides an ellipse
/// as long and as wide as itself. The tile has a hundred grains. They are spread until none
/// overlaps another by more than a tenth of its thickness, and no grain fits onto the board between
/// them; their places are drawn anew until that is so. Throws NoMeasurement when twenty beds
/// failed. Proved by GluedBed.* in tests/dem/glued_bed_test.cpp.
SphereBed glued_bed(const ClumpShape& grain, double coverage, Random& random);

/// The board and the grains on it, both of the grains' material: what shows of the board between
/// them must not matter. `shape` is the board's, whose upper face is `height_m` above its origin.
std::vector<Wall> grain_covered(const Wall& board, const SphereBed& bed, double height_m = 0);

/// Height of the highest glued grain over the board, m.
double top_m(const SphereBed& bed);

/// Whether a sphere that lies on the board fits between the glued grains.
bool has_hole(const SphereBed& bed, double radius_m);

}  // namespace repose::dem
