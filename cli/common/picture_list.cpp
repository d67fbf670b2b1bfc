#include "cli/common/picture_list.h"

#include <algorithm>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "cli/common/option_value.h"
#include "vision/picture/made_here.h"

namespace repose::cli {

namespace fs = std::filesystem;

std::vector<fs::path> files_in(vision::FileList list, std::vector<std::string>& errors,
                               std::vector<std::string>& notes) {
  for (const base::Fault& fault : list.faults) errors.push_back(fault.text());
  notes.insert(notes.end(), list.notes.begin(), list.notes.end());
  return std::move(list.files);
}

std::optional<double> read_frame_rate(const std::string& text,
                                      const std::vector<std::string>& names,
                                      std::vector<std::string>& errors) {
  constexpr double kSlowest = 1e-3, kFastest = 1e6;
  const auto rate = read_number_within({"--fps", text, errors}, kSlowest, kFastest, "--fps 60");
  if (!rate) return rate;
  const bool any = std::any_of(names.begin(), names.end(), [](const std::string& name) {
    std::error_code ignored;
    return fs::is_directory(name, ignored);
  });
  if (!any) {
    errors.push_back(fmt::format(
        "--fps {}: is for folders of numbered frames, and no folder is named; films say it "
        "themselves. Fix: leave it out, or name the folder.",
        text));
  }
  return rate;
}

OverlayFiles name_overlays(const std::vector<fs::path>& pictures, const fs::path& folder) {
  std::set<fs::path> taken;
  for (const fs::path& picture : pictures) taken.insert(vision::identity(picture));
  OverlayFiles overlays;
  for (const fs::path& picture : pictures) {
    const std::string name = picture.stem().string();
    fs::path file = folder / (name + ".png");
    for (int number = 2;
         !vision::is_made_here(file) || !taken.insert(vision::identity(file)).second; ++number) {
      file = folder / fmt::format("{}-{}.png", name, number);
    }
    if (file.stem() != picture.stem()) {
      overlays.notes.push_back(fmt::format("{}: its overlay is {}, because {}.png is taken",
                                           picture.string(), file.string(), name));
    }
    overlays.files.push_back(file);
  }
  return overlays;
}

}  // namespace repose::cli
