#include <cmath>

#include <gmock/gmock.h>

#include "base/input_error.h"
#include "dem/shape/scan/calliper.h"
#include "dem/shape/scan/mesh.h"
#include "dem/shape/scan/repair.h"
#include "tests/dem/shapes.h"

namespace repose::testing {
namespace {

using dem::CalliperSizes;
using dem::Mesh;
using dem::Vector;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

CalliperSizes nut_sizes(double tip_fraction) {
  return {.length_m = 22.48e-3,
          .width_m = 18.23e-3,
          .thickness_m = 17.46e-3,
          .tip_fraction = tip_fraction};
}

/// Half width near the end at +x, as a fraction of the full half width.
double width_near_tip(const Mesh& mesh, const CalliperSizes& sizes) {
  double width = 0;
  for (const Vector& vertex : mesh.vertices) {
    if (vertex.x() > 0.9 * sizes.length_m / 2) width = std::max(width, vertex.y());
  }
  return width / (sizes.width_m / 2);
}

TEST(CalliperSurface, MeetsTheSizesToTheLastDigit) {
  for (const double tip_fraction : {0.0, 0.3, 1.0}) {
    Eigen::AlignedBox3d bounds;
    for (const Vector& vertex : dem::calliper_surface(nut_sizes(tip_fraction)).vertices) {
      bounds.extend(vertex);
    }
    EXPECT_EQ(bounds.max(), Vector(22.48e-3 / 2, 18.23e-3 / 2, 17.46e-3 / 2));
    EXPECT_EQ(bounds.min(), -bounds.max());
  }
}

TEST(CalliperSurface, IsClosedFacesOutwardsAndDoesNotCrossItself) {
  for (const double tip_fraction : {0.0, 0.5, 1.0}) {
    const Mesh mesh = dem::calliper_surface(nut_sizes(tip_fraction));
    EXPECT_TRUE(dem::is_watertight(mesh));
    EXPECT_GT(dem::mass_properties(mesh).volume_m3, 0);
    EXPECT_EQ(dem::find_self_crossing(mesh).triangles, 0U);
  }
}

TEST(CalliperSurface, GetsMorePointedWithTheTip) {
  const CalliperSizes round = nut_sizes(0), nut = nut_sizes(0.5), point = nut_sizes(1);
  EXPECT_GT(width_near_tip(dem::calliper_surface(round), round),
            1.3 * width_near_tip(dem::calliper_surface(nut), nut));
  EXPECT_GT(width_near_tip(dem::calliper_surface(nut), nut),
            1.3 * width_near_tip(dem::calliper_surface(point), point));
}

TEST(CalliperSurface, NamesEverySizeThatIsWrong) {
  const CalliperSizes wrong{
      .length_m = -1, .width_m = 22, .thickness_m = std::nan(""), .tip_fraction = 1.5};
  EXPECT_THAT([&] { dem::calliper_surface(wrong); },
              ThrowsMessage<base::InputError>(
                  AllOf(HasSubstr("the length is -1000 mm"), HasSubstr("the width is 22000 mm"),
                        HasSubstr("the thickness is nan"), HasSubstr("tip: is 1.5"))));
}

}  // namespace
}  // namespace repose::testing
