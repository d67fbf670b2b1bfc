#include "cli/common/picture_list.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "vision/picture/made_here.h"

namespace repose::cli {
namespace {

namespace fs = std::filesystem;

void add_folder(const fs::path& folder, PictureList& list) {
  std::error_code error;
  std::vector<fs::path> found;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const bool is_hidden = entry->path().filename().string().starts_with('.');
    if (!is_hidden && has_picture_ending(entry->path())) found.push_back(entry->path());
  }
  if (error) {
    list.errors.push_back(
        fmt::format("{}: the folder cannot be read ({}). Fix: get permission to read it.",
                    folder.string(), error.message()));
    return;
  }
  if (found.empty()) {
    list.errors.push_back(
        fmt::format("{}: no pictures in this folder (subfolders are not searched). Fix: name a "
                    "folder with .jpg, .png, .tif, .bmp or .webp files in it.",
                    folder.string()));
  }
  std::sort(found.begin(), found.end());
  list.files.insert(list.files.end(), found.begin(), found.end());
}

void drop_repeated(PictureList& list) {
  std::set<fs::path> seen;
  std::erase_if(list.files, [&](const fs::path& file) {
    if (seen.insert(identity(file)).second) return false;
    list.notes.push_back(fmt::format("{}: named twice, measured once", file.string()));
    return true;
  });
}

}  // namespace

bool has_picture_ending(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  constexpr std::array<std::string_view, 8> kEndings{".jpg",  ".jpeg", ".png",  ".tif",
                                                     ".tiff", ".bmp",  ".webp", ".heic"};
  return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

std::string naming_file(const std::string& file, const std::string& error) {
  return error.starts_with(file + ": ") ? error : file + ": " + error;
}

fs::path identity(const fs::path& file) {
  std::error_code error;
  // Made absolute first: of a relative name that does not exist nothing would be resolved.
  const fs::path canonical = fs::weakly_canonical(fs::absolute(file), error);
  return error ? file : canonical;
}

PictureList list_pictures(const std::vector<std::string>& names) {
  PictureList list;
  for (const std::string& name : names) {
    std::error_code ignored;
    if (fs::is_directory(name, ignored)) {
      add_folder(name, list);
    } else {
      list.files.emplace_back(name);
    }
  }
  drop_repeated(list);
  return list;
}

OverlayFiles name_overlays(const std::vector<fs::path>& pictures, const fs::path& folder) {
  std::set<fs::path> taken;
  for (const fs::path& picture : pictures) taken.insert(identity(picture));
  OverlayFiles overlays;
  for (const fs::path& picture : pictures) {
    const std::string name = picture.stem().string();
    fs::path file = folder / (name + ".png");
    for (int number = 2; !vision::is_made_here(file) || !taken.insert(identity(file)).second;
         ++number) {
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
