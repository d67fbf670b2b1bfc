#include "cli/output_places.h"

#include <stdexcept>

#include <fmt/format.h>

#include "cli/output.h"
#include "cli/picture_list.h"
#include "io/whole_file.h"

namespace repose::cli {
namespace {

namespace fs = std::filesystem;

bool same_file(const fs::path& a, const fs::path& b) { return identity(a) == identity(b); }

}  // namespace

void check_output_places(const std::vector<OutputPlace>& places,
                         const std::vector<fs::path>& inputs, std::vector<std::string>& faults) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [option, file] = places[i];
    if (file.empty()) continue;
    for (std::size_t j = 0; j < i; ++j) {
      if (places[j].file.empty() || !same_file(places[j].file, file)) continue;
      faults.push_back(fmt::format("{} and {} both write to {}. Fix: give each its own file.",
                                   places[j].option, option, file));
    }
    if (file == kStandardOutput) continue;
    for (const fs::path& input : inputs) {
      if (input.empty() || !same_file(input, file)) continue;
      faults.push_back(fmt::format(
          "{} {}: would overwrite a file that is read. Fix: choose another name.", option, file));
    }
    try {
      io::check_can_write(file);
    } catch (const std::invalid_argument& fault) {
      faults.push_back(fmt::format("{} {}", option, fault.what()));
    }
  }
}

}  // namespace repose::cli
