#include "tests/bench/other_subjects.h"

#include "tests/support/other_pictures.h"

namespace repose::bench {

std::vector<Subject> other_subjects(int seeds, std::uint64_t first_seed) {
  std::vector<Subject> subjects;
  for (const testing::OtherKind& kind : testing::other_kinds()) {
    for (int i = 0; i < seeds; ++i) {
      const std::uint64_t seed = first_seed + static_cast<unsigned>(i);
      subjects.push_back({.section = "other",
                          .condition = kind.name,
                          .group = testing::Group::not_measurable,
                          .seed = seed,
                          .take = [&kind, seed] {
                            return KnownPicture{.picture = draw_other(kind, seed), .heap = {}};
                          }});
    }
  }
  return subjects;
}

}  // namespace repose::bench
