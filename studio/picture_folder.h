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

/// The pictures, films, scans and files of particles of one folder, measured when somebody looks at
/// them. What was measured is kept until its file, or what is saved beside it, changes. Several
/// threads may ask at once.
///
/// Files are known by their names in the folder: no other name leads anywhere.
/// All of it throws base::InputError for a name that is not there.
///
/// The folder is one studio's: another that is started on it is refused, which FolderLock does.
class PictureFolder {
 public:
  using Bytes = std::vector<std::uint8_t>;

  /// @throws base::InputError  it is no folder, or another studio has it.
  explicit PictureFolder(std::filesystem::path folder);

  /// `folder`, its `name`, `definitions` of the angle [{`name`, `description`}], the `command` that
  /// measures all, and `files` [{`file`, `kind`, `version`, `has_hints`}]; the version changes with
  /// the file and with what is saved beside it. Copies and subfolders are not looked for.
  Json list() const;

  const std::filesystem::path& folder() const { return folder_; }
  /// The file of that name in the folder; no other name leads anywhere.
  std::filesystem::path path_of(const std::string& file) const;
  /// Its version, as list() has it.
  std::string version_of(const std::string& file) const;

  /// As `repose measure --json` has it, in `measured`; with `version`, `told`, `marks`
  /// (told_json.h), `command` and, of a refused picture, `proposed`, what the proposal would make
  /// of `told`. As text, which is kept: of a thousand pictures the outlines are long.
  std::string measured(const std::string& file);
  /// The same by what the page tells, which is not saved. Nothing is proposed.
  Json measured_as(const std::string& file, const Json& told);
  /// Saves what the page tells beside the file, and measures by it. Window and definition are not
  /// of one picture, and are not saved.
  /// @param version  that was corrected
  /// @throws ChangedMeanwhile  it is not that any more.
  std::string save(const std::string& file, const Json& told, const std::string& version);
  /// Removes what is saved beside the file, and measures without it. Likewise.
  std::string forget(const std::string& file, const std::string& version);

  /// A JPEG of the picture as it is measured when turned so, its longer side at most so long.
  Bytes picture(const std::string& file, int side_px, int turn_deg);
  /// A JPEG with what was measured drawn in, as `repose measure --overlay` draws it.
  Bytes overlay(const std::string& file);
  /// A PNG of what is saved as painted over the picture: white is heap, black is not, grey is open.
  Bytes mask(const std::string& file);

  /// Puts a file into the folder, under another name where its own is taken; none is replaced.
  /// @returns the name
  /// @throws base::InputError  it cannot be written, or its name is not one of a picture, a film or
  ///   a scan.
  std::string add(const std::string& name, std::string_view content);

  /// All files as repeats, as `repose measure --summary` has it.
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
  /// What is told, with what is painted in its mask.
  vision::PictureSettings settings_of(const std::filesystem::path& path, const std::string& version,
                                      const Json& told);
  calibrate::MeasuredAgain again(const std::string& file);
  std::vector<calibrate::MeasuredPicture> all();

  const std::filesystem::path folder_;
  std::optional<base::FolderLock> lock_;
  std::mutex saving_;
  std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Kept>> kept_;
  /// Those that were looked at last, the latest first; some, for pictures are large.
  std::list<std::pair<std::string, Opened>> opened_;
};

}  // namespace repose::studio
