#include "tests/peers/liggghts.h"

#include <algorithm>
#include <stdexcept>

namespace repose::testing {

bool has_liggghts() {
  // It has no option that only prints its version; an empty deck ends at once.
  return run_program("liggghts", {}, {"-in", "/dev/null", "-log", "none"}).exit_code == 0;
}

Finished run_liggghts(const TemporaryFolder& folder, const std::string& deck) {
  folder.write("deck.txt", deck);
  Finished finished = run_program("liggghts", folder, {"-in", "deck.txt", "-log", "none"});
  if (finished.exit_code != 0) {
    constexpr std::size_t kShown = 600;
    const std::size_t size = finished.out.size();
    throw std::runtime_error(
        "LIGGGHTS failed: " + finished.out.substr(size - std::min(size, kShown)) + finished.err);
  }
  return finished;
}

}  // namespace repose::testing
