#include "vision/files/file_list.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <set>
#include <span>
#include <string_view>
#include <system_error>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/file_set.h"
#include "base/fingerprint.h"
#include "vision/film/film_angle.h"
#include "vision/scan/scan_file.h"

namespace repose::vision {

std::string heap_by_name(const std::filesystem::path& picture) {
  std::string name = (picture.parent_path() / picture.stem()).string();
  const std::size_t last = name.find_last_not_of("0123456789");
  const bool has_number = last != std::string::npos && last + 1 < name.size();
  if (has_number && last > 0 && (name[last] == '_' || name[last] == '-') && name[last - 1] != '/') {
    name.resize(last);
  }
  return name;
}

namespace {

namespace fs = std::filesystem;

bool have_same_bytes(const fs::path& a, const fs::path& b) {
  constexpr std::size_t kBlock = 1 << 16;
  std::ifstream first(a, std::ios::binary), second(b, std::ios::binary);
  std::vector<char> one(kBlock), other(kBlock);
  while (first && second) {
    first.read(one.data(), kBlock);
    second.read(other.data(), kBlock);
    if (first.gcount() != second.gcount() ||
        !std::equal(one.begin(), one.begin() + first.gcount(), other.begin())) {
      return false;
    }
  }
  return first.eof() && second.eof();
}

/// std::nullopt unless it is a regular, non-empty file.
std::optional<std::uintmax_t> size_of(const fs::path& file) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return std::nullopt;
  const std::uintmax_t size = fs::file_size(file, error);
  return error || size == 0 ? std::nullopt : std::optional(size);
}

}  // namespace

std::string pixels_of(const Picture& picture) {
  return base::fingerprint({fmt::format("{} {}", picture.width, picture.height),
                            std::string(picture.bgr.begin(), picture.bgr.end())});
}

std::vector<std::optional<std::size_t>> copies_among(const std::vector<fs::path>& files,
                                                     const std::vector<std::string>& pixels) {
  std::vector<std::optional<std::size_t>> first_of(files.size());
  std::vector<std::optional<std::uintmax_t>> sizes;
  sizes.reserve(files.size());
  for (const fs::path& file : files) sizes.push_back(size_of(file));
  for (std::size_t i = 1; i < files.size(); ++i) {
    for (std::size_t k = 0; k < i && !first_of[i]; ++k) {
      if (first_of[k]) continue;
      const bool same_pixels = !pixels[i].empty() && pixels[i] == pixels[k];
      const bool same_size = sizes[i] && sizes[i] == sizes[k];
      if (same_pixels || (same_size && have_same_bytes(files[i], files[k]))) first_of[i] = k;
    }
  }
  return first_of;
}

std::string text_of_copy(const fs::path& copy, const fs::path& first) {
  return fmt::format("{}: the same {} as {}, counted once", copy.string(),
                     has_film_ending(copy) ? "film" : "picture", first.string());
}

namespace {

namespace fs = std::filesystem;

/// Pictures, or films, or both.
struct FileKind {
  std::string_view name;                         ///< "pictures"
  std::string_view done;                         ///< past participle: "measured"
  std::string_view usual;                        ///< ".jpg, .heic, .png, .tif, .bmp or .webp"
  std::span<const std::string_view> endings;     ///< all, in lower case
  std::span<const std::string_view> more = {};   ///< likewise
  std::span<const std::string_view> scans = {};  ///< likewise
};

constexpr std::array<std::string_view, 10> kPictureEndings{
    ".jpg", ".jpeg", ".png", ".tif", ".tiff", ".bmp", ".webp", ".heic", ".heif", ".avif"};
constexpr FileKind kPictures{.name = "pictures",
                             .done = "measured",
                             .usual = ".jpg, .heic, .png, .tif, .bmp or .webp",
                             .endings = kPictureEndings};
constexpr FileKind kFilms{.name = "films",
                          .done = "tracked",
                          .usual = ".mp4, .mov, .avi, .mkv, .webm or .gif",
                          .endings = kFilmEndings};

constexpr FileKind kBoth{.name = "pictures or films",
                         .done = "measured",
                         .usual = ".jpg, .heic, .png, .tif, .bmp, .webp, .mp4, .mov or .avi",
                         .endings = kPictureEndings,
                         .more = kFilmEndings};

constexpr FileKind kScans{.name = "scans",
                          .done = "measured",
                          .usual = ".ply, .obj, .stl or .glb",
                          .endings = kScanEndings};

constexpr FileKind kHeaps{
    .name = "pictures, films or scans",
    .done = "measured",
    .usual = ".jpg, .heic, .png, .tif, .bmp, .webp, .mp4, .mov, .avi, .ply or .obj",
    .endings = kPictureEndings,
    .more = kFilmEndings,
    .scans = kScanEndings};

bool has_ending(const fs::path& file, const FileKind& kind) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  const auto has = [&](const auto& endings) {
    return std::find(endings.begin(), endings.end(), ending) != endings.end();
  };
  return has(kind.endings) || has(kind.more) || has(kind.scans);
}

/// Adds the wanted files of a folder, sorted.
/// @param named  what the user named: the folder, or a pattern in it
/// @param none   the error if there is none
template <typename Wanted>
void add_files(const fs::path& named, const fs::path& folder, const Wanted& is_wanted,
               const base::Fault& none, FileList& list) {
  std::error_code error;
  std::vector<fs::path> found;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (is_wanted(entry->path())) found.push_back(entry->path());
  }
  if (error) {
    list.faults.push_back({.where = named.string(),
                           .value = fmt::format("the folder {} cannot be read ({})",
                                                folder.string(), error.message()),
                           .fix = "correct its name, or get permission to read it."});
  } else if (found.empty()) {
    list.faults.push_back({.where = named.string(), .value = none.value, .fix = none.fix});
  }
  std::sort(found.begin(), found.end());
  list.files.insert(list.files.end(), found.begin(), found.end());
}

/// Of what a folder has given, from `first` on.
void drop_films_of_pictures(std::size_t first, FileList& list) {
  const auto begin = list.files.begin() + static_cast<std::ptrdiff_t>(first);
  std::set<fs::path> pictures;
  for (auto file = begin; file != list.files.end(); ++file) {
    if (has_ending(*file, kPictures)) pictures.insert(file->stem());
  }
  const auto is_taken_along = [&](const fs::path& file) {
    if (!has_film_ending(file) || !pictures.contains(file.stem())) return false;
    list.notes.push_back(
        fmt::format("{}: left out, since a picture has its name, as where a phone takes both "
                    "at once; name it to have it measured too",
                    file.string()));
    return true;
  };
  list.files.erase(std::remove_if(begin, list.files.end(), is_taken_along), list.files.end());
}

/// Of what a folder has given, from `first` on.
void drop_pictures_of_scans(std::size_t first, FileList& list) {
  const auto begin = list.files.begin() + static_cast<std::ptrdiff_t>(first);
  std::set<fs::path> scans;
  for (auto file = begin; file != list.files.end(); ++file) {
    if (has_scan_ending(*file)) scans.insert(file->stem());
  }
  const auto belongs_to_scan = [&](const fs::path& file) {
    if (has_scan_ending(file) || !scans.contains(file.stem())) return false;
    list.notes.push_back(
        fmt::format("{}: left out, since a scan has its name: its texture, or the same heap; name "
                    "it to have it measured too",
                    file.string()));
    return true;
  };
  list.files.erase(std::remove_if(begin, list.files.end(), belongs_to_scan), list.files.end());
}

void add_folder(const fs::path& folder, const FileKind& kind, FileList& list) {
  const std::size_t first = list.files.size();
  const auto is_wanted = [&](const fs::path& file) {
    return !file.filename().string().starts_with('.') && has_ending(file, kind) &&
           !is_overlay_of_state(file);
  };
  add_files(folder, folder, is_wanted,
            {.value = fmt::format("no {} in this folder (subfolders are not searched)", kind.name),
             .fix = fmt::format("name a folder with {} files in it.", kind.usual)},
            list);
  if (!kind.more.empty()) drop_films_of_pictures(first, list);
  if (!kind.scans.empty()) drop_pictures_of_scans(first, list);
}

void add_matching(const fs::path& pattern, FileList& list) {
  const auto is_wanted = [&](const fs::path& file) {
    std::error_code ignored;
    return base::matches(file.filename().string(), pattern) && !fs::is_directory(file, ignored);
  };
  const fs::path folder = base::folder_of(pattern);
  add_files(
      pattern, folder, is_wanted,
      {.value = "no file has such a name",
       .fix = "correct the pattern; * stands for any letters and ? for one, in names of files "
              "and not of folders."},
      list);
}

void drop_repeated(const FileKind& kind, FileList& list) {
  std::set<fs::path> seen;
  std::erase_if(list.files, [&](const fs::path& file) {
    if (seen.insert(identity(file)).second) return false;
    list.notes.push_back(fmt::format("{}: named twice, {} once", file.string(), kind.done));
    return true;
  });
}

FileList list_files(const std::vector<std::string>& names, const FileKind& kind) {
  FileList list;
  for (const std::string& name : names) {
    std::error_code ignored;
    if (fs::is_directory(name, ignored)) {
      add_folder(name, kind, list);
    } else if (base::is_pattern(name)) {
      add_matching(name, list);
    } else {
      list.files.emplace_back(name);
    }
  }
  drop_repeated(kind, list);
  return list;
}

}  // namespace

bool has_picture_ending(const fs::path& file) { return has_ending(file, kPictures); }

bool is_overlay_of_state(const fs::path& file) {
  constexpr std::string_view kEnding = ".overlay.png";
  std::string name = file.string();
  if (!name.ends_with(kEnding)) return false;
  name.resize(name.size() - kEnding.size());
  return fs::exists(name + ".vtp");
}

FileList list_pictures(const std::vector<std::string>& names) {
  return list_files(names, kPictures);
}

FileList list_films(const std::vector<std::string>& names) { return list_files(names, kFilms); }

FileList list_scans(const std::vector<std::string>& names) { return list_files(names, kScans); }

FileList list_pictures_and_films(const std::vector<std::string>& names) {
  return list_files(names, kBoth);
}

FileList list_heap_files(const std::vector<std::string>& names) {
  return list_files(names, kHeaps);
}

FileList list_with_frame_folders(const std::vector<std::string>& names) {
  FileList list;
  for (const std::string& name : names) {
    std::error_code ignored;
    if (fs::is_directory(name, ignored)) {
      list.files.push_back(without_slash(name));
      continue;
    }
    FileList one = list_files({name}, kHeaps);
    std::move(one.files.begin(), one.files.end(), std::back_inserter(list.files));
    std::move(one.faults.begin(), one.faults.end(), std::back_inserter(list.faults));
  }
  drop_repeated(kBoth, list);
  return list;
}

fs::path without_slash(const std::string& name) {
  const std::size_t last = name.find_last_not_of('/');
  return last == std::string::npos ? name : name.substr(0, last + 1);
}

fs::path identity(const fs::path& file) {
  std::error_code error;
  // Made absolute first: a relative name that does not exist would not be resolved.
  const fs::path canonical = fs::weakly_canonical(fs::absolute(file), error);
  return error ? file : canonical;
}

}  // namespace repose::vision
