#include "vision/film/frame_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "base/input_error.h"

namespace repose::vision {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 7> kEndings{".jpg",  ".jpeg", ".png", ".tif",
                                                   ".tiff", ".bmp",  ".webp"};

[[noreturn]] void refuse_frames(const fs::path& folder, const std::string& what,
                                const std::string& fix) {
  throw base::InputError({.where = folder.string(),
                          .value = what,
                          .rule = "a folder that is a film holds its frames as pictures whose "
                                  "names differ in their numbers alone, such as frame_0001.png",
                          .fix = fix});
}

std::string small_ending(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return ending;
}

/// A name split at the last number in it.
struct NumberedName {
  std::string others;  ///< what is before and behind the number
  std::int64_t number = 0;
};

std::optional<NumberedName> numbered(const fs::path& file) {
  constexpr const char* kDigits = "0123456789";
  const std::string name = file.stem().string();
  const std::size_t last = name.find_last_of(kDigits);
  if (last == std::string::npos) return std::nullopt;
  const std::size_t before = name.find_last_not_of(kDigits, last);
  const std::size_t first = before == std::string::npos ? 0 : before + 1;
  NumberedName found{.others =
                         name.substr(0, first) + '*' + name.substr(last + 1) + small_ending(file)};
  const char* end = name.data() + last + 1;
  const auto read = std::from_chars(name.data() + first, end, found.number);
  if (read.ec != std::errc() || read.ptr != end) return std::nullopt;
  return found;
}

std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> pictures;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const bool is_hidden = entry->path().filename().string().starts_with('.');
    const std::string ending = small_ending(entry->path());
    if (!is_hidden && std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end()) {
      pictures.push_back(entry->path());
    }
  }
  if (error)
    refuse_frames(folder, "cannot be read: " + error.message(), "get permission to read it.");
  std::sort(pictures.begin(), pictures.end());
  return pictures;
}

}  // namespace

std::vector<FrameFile> frame_files(const fs::path& folder) {
  std::vector<FrameFile> frames;
  std::string others;
  for (const fs::path& picture : pictures_in(folder)) {
    const auto name = numbered(picture);
    if (!name) {
      refuse_frames(folder,
                    fmt::format("{} has no number in its name", picture.filename().string()),
                    "move it elsewhere, or name the pictures by themselves.");
    }
    if (frames.empty()) others = name->others;
    if (name->others != others) {
      refuse_frames(
          folder,
          fmt::format("{} and {} differ in more than a number",
                      frames.front().file.filename().string(), picture.filename().string()),
          "a folder for each film.");
    }
    frames.push_back({.file = picture, .place = name->number});
  }
  if (frames.empty()) {
    refuse_frames(folder, "has no pictures", "name the folder of the frames, or the films in it.");
  }
  std::sort(frames.begin(), frames.end(),
            [](const FrameFile& a, const FrameFile& b) { return a.place < b.place; });
  std::int64_t step = 0;
  const std::int64_t first = frames.front().place;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    const std::int64_t gap = frames[k].place - frames[k - 1].place;
    if (gap == 0) {
      refuse_frames(
          folder,
          fmt::format("{} and {} have the same number", frames[k - 1].file.filename().string(),
                      frames[k].file.filename().string()),
          "remove one of them.");
    }
    step = std::gcd(step, gap);
  }
  for (FrameFile& frame : frames) {
    frame.place = step > 0 ? (frame.place - first) / step : 0;
  }
  return frames;
}

}  // namespace repose::vision
