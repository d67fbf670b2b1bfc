#include "tests/support/other_pictures.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include <gtest/gtest.h>

namespace repose::testing {
namespace {

const OtherKind& kind_named(std::string_view name) {
  for (const OtherKind& kind : other_kinds()) {
    if (kind.name == name) return kind;
  }
  throw std::invalid_argument("no such kind");
}

TEST(OtherPictures, SameSeedGivesTheSameBytesAndAnotherSeedAnotherPicture) {
  const OtherKind& tent = kind_named("tent");
  EXPECT_EQ(draw_other(tent, 3).bgr, draw_other(tent, 3).bgr);
  EXPECT_NE(draw_other(tent, 3).bgr, draw_other(tent, 4).bgr);
}

/// A picture of one colour would be refused as empty.
TEST(OtherPictures, EveryKindShowsSomething) {
  for (const OtherKind& kind : other_kinds()) {
    const vision::Picture picture = draw_other(kind, 1);
    EXPECT_EQ(picture.bgr.size(), 3U * static_cast<unsigned>(picture.width * picture.height));
    const auto [darkest, lightest] = std::minmax_element(picture.bgr.begin(), picture.bgr.end());
    EXPECT_GT(*lightest - *darkest, 40) << kind.name;
  }
}

}  // namespace
}  // namespace repose::testing
