#include "dem/experiment/glued_bed.h"

#include <gtest/gtest.h>

#include "tests/dem/experiment_model.h"

namespace repose::dem {
namespace {

TEST(GluedBed, HidesAsMuchOfTheBoardAsItIsTold) {
  Random random(1);
  const SphereBed bed = glued_bed(sphere_shape(.003), .75, random);
  const double hidden = static_cast<double>(bed.spheres.size()) * std::numbers::pi * 9e-6;
  EXPECT_NEAR(hidden / (bed.tile * bed.tile), .75, 1e-9);
  EXPECT_NEAR(top_m(bed), .006, 1e-12) << "one layer, on the board";
}

TEST(GluedBed, HasNoHolesAndNoGrainsOnEachOther) {
  for (const ClumpShape& grain : {sphere_shape(.003), test::spheroid_clump(5)}) {
    for (const double coverage : {kMinCoverage, kMaxCoverage}) {
      Random random(7);
      const SphereBed bed = glued_bed(grain, coverage, random);
      EXPECT_FALSE(has_hole(bed, .5 * top_m(bed))) << coverage;
    }
  }
}

TEST(GluedBed, AHoleIsWhereAGrainFits) {
  Random random(1);
  SphereBed bed = glued_bed(sphere_shape(.003), .75, random);
  bed.spheres.erase(bed.spheres.begin(), bed.spheres.begin() + 1);
  EXPECT_TRUE(has_hole(bed, .003)) << "where the first grain was";
}

TEST(GluedBed, IsAnotherForAnotherSeed) {
  Random one(1), same(1), other(2);
  const SphereBed bed = glued_bed(sphere_shape(.003), .75, one);
  EXPECT_EQ(bed.spheres[9].centre, glued_bed(sphere_shape(.003), .75, same).spheres[9].centre);
  EXPECT_NE(bed.spheres[9].centre, glued_bed(sphere_shape(.003), .75, other).spheres[9].centre);
}

}  // namespace
}  // namespace repose::dem
