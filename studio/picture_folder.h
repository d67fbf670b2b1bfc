#pragma once

#include <cstdint>
#include <filesystem>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/folder_lock.h"
#include "calibrate/measured/measured_file.h"
#include "studio/json_answer.h"
#include "vision/hints/hint_file.h"

namespace repose::studio {

/// The pictures, films, scans and particle files of one folder, measured on demand. Results are
/// cached until the file, or what is saved beside it, changes. Thread-safe.
///
/// Files are identified by their names in the folder: no other path is accepted. All members throw
/// base::InputError for an unknown name.
///
/// A FolderLock reserves the folder for one studio: another one started on it is refused.
class PictureFolder {
 public:
  using Bytes = std::vector<std::uint8_t>;

  /// @throws base::InputError  not a folder, or another studio has it.
  explicit PictureFolder(std::filesystem::path folder);

  /// `folder`, its `name`, `definitions` of the angle [{`name`, `description`}], the `command` that
  /// measures all, and `files` [{`file`, `kind`, `version`, `has_hints`}]; the version changes with
  /// the file and with what is saved beside it. Copies are not detected, subfolders not searched.
  Json list() const;

  const std::filesystem::path& folder() const { return folder_; }
  /// The file of that name in the folder; no other path is accepted.
  std::filesystem::path path_of(const std::string& file) const;
  /// Its version, as in list().
  std::string version_of(const std::string& file) const;

  /// `measured`, as in `repose measure --json`, with `version`, `told`, `marks` (told_json.h),
  /// `command` and, for a refused picture, `proposed`: `told` with the proposal applied. Cached as
  /// text: the outlines of a thousand pictures are large.
  std::string measured(const std::string& file);
  /// The same with the page's hints, which are not saved. Nothing is proposed.
  Json measured_as(const std::string& file, const Json& told);
  /// Saves the page's hints beside the file, and measures with them. Window and definition do not
  /// belong to one picture, and are not saved.
  /// @param version  on which the hints are based
  /// @throws ChangedMeanwhile  it has changed since.
  std::string save(const std::string& file, const Json& told, const std::string& version);
  /// Removes what is saved beside the file, and measures without it; throws like save().
  std::string forget(const std::string& file, const std::string& version);

  /// A JPEG of the picture as measured when turned by `turn_deg`, its longer side at most
  /// `side_px`.
  Bytes picture(const std::string& file, int side_px, int turn_deg);
  /// A JPEG with the result drawn in, as by `repose measure --overlay`.
  Bytes overlay(const std::string& file);
  /// A PNG of the mask saved for the picture: white is heap, black is not, grey is undecided.
  Bytes mask(const std::string& file);

  /// Puts a file into the folder, under another name if its own is taken; none is replaced.
  /// @returns the name
  /// @throws base::InputError  it cannot be written, or its name is not that of a picture, a film
  ///   or a scan.
  std::string add(const std::string& name, std::string_view content);

  /// All files as repeats, as in `repose measure --summary`.
  std::string set();
  std::string csv();
  std::string workbook();
  std::string report();

 private:
  struct Kept;
  using Opened = std::shared_ptr<const calibrate::OpenedPicture>;

  void require_unchanged(const std::filesystem::path& path, const std::string& version) const;
  std::shared_ptr<Kept> kept(const std::filesystem::path& path);
  Opened opened(const std::filesystem::path& path, const std::string& version,
                const vision::PictureSettings& told);
  /// The page's hints, with the painted strokes in the mask.
  vision::PictureSettings settings_of(const std::filesystem::path& path, const std::string& version,
                                      const Json& told);
  calibrate::MeasuredAgain again(const std::string& file);
  std::vector<calibrate::MeasuredPicture> all();

  const std::filesystem::path folder_;
  std::optional<base::FolderLock> lock_;
  std::mutex saving_;
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Kept>> kept_;
  /// The most recently used, latest first; only a few, since pictures are large.
  std::list<std::pair<std::string, Opened>> opened_;
};

}  // namespace repose::studio
