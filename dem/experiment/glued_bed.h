#pragma once

#include <string_view>
#include <vector>

#include "base/input_error.h"
#include "dem/experiment/model_setup.h"
#include "dem/experiment/protocol_key.h"
#include "dem/shape/clump/clump_shape.h"
#include "dem/wall/wall.h"

namespace repose::dem {

/// Coverages for which grains can be glued without holes and without lying on each other.
inline constexpr double kMinCoverage = .65;
inline constexpr double kMaxCoverage = .85;

/// Adds an error if the coverage is outside these limits; `experiment` is named in it.
void find_coverage_error(std::string_view experiment, double coverage, base::Faults& errors);
ProtocolKey coverage_key(double& coverage);

/// A board (z = 0 of its frame) covered with one layer of grains glued on as they lie: on their
/// flattest side, at random angles about the vertical, at random places.
///
/// `coverage` is the fraction of the board hidden by the grains, seen from above: each hides an
/// ellipse of its own length and width. The tile has a hundred grains. They are spread out; places
/// are redrawn until no grain overlaps another by more than a tenth of its thickness and no grain
/// fits onto the board between them. Throws NoMeasurement after twenty failed beds. Proved by
/// GluedBed.* in tests/dem/glued_bed_test.cpp.
SphereBed glued_bed(const ClumpShape& grain, double coverage, Random& random);

/// The board and the grains on it, both of the grains' material, so that the exposed part of the
/// board does not matter. The board's upper face is `height_m` above its origin.
std::vector<Wall> grain_covered(const Wall& board, const SphereBed& bed, double height_m = 0);

/// Height of the highest glued grain above the board, m.
double top_m(const SphereBed& bed);

/// Whether a sphere lying on the board fits between the glued grains.
bool has_hole(const SphereBed& bed, double radius_m);

}  // namespace repose::dem
