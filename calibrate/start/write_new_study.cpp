#include <cerrno>
#include <cstdlib>
#include <system_error>

#include <fmt/format.h>

#include "base/csv.h"
#include "base/input_error.h"
#include "base/part_file.h"
#include "base/whole_file.h"
#include "calibrate/start/new_study.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;

/// A folder that goes away with the object, unless it got its name.
class FolderToBe {
 public:
  explicit FolderToBe(const fs::path& folder) : folder_(folder) {
    std::string name = (base::folder_of(folder) / ".repose-new-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      const std::error_code error(errno, std::generic_category());
      base::refuse(folder, fmt::format("cannot be created ({})", error.message()),
                   "choose a writable place.");
    }
    path_ = name;
    fs::permissions(path_,
                    fs::perms::group_read | fs::perms::group_exec | fs::perms::others_read |
                        fs::perms::others_exec,
                    fs::perm_options::add);
  }
  ~FolderToBe() {
    std::error_code ignored;
    if (!is_done_) fs::remove_all(path_, ignored);
  }
  FolderToBe(const FolderToBe&) = delete;
  FolderToBe& operator=(const FolderToBe&) = delete;
  FolderToBe(FolderToBe&&) = delete;
  FolderToBe& operator=(FolderToBe&&) = delete;

  const fs::path& path() const { return path_; }
  void put_in_place() {
    fs::rename(path_, folder_);
    path_ = folder_;
  }
  void keep() { is_done_ = true; }

 private:
  fs::path folder_;
  fs::path path_;
  bool is_done_ = false;
};

}  // namespace

fs::path sheet_folder_of(const fs::path& file) { return file.parent_path() / file.stem(); }

void check_new_places(const fs::path& file) {
  base::Faults errors;
  std::error_code ignored;
  for (const fs::path& place : {file, sheet_folder_of(file)}) {
    errors.require(!fs::exists(fs::symlink_status(place, ignored)),
                   {.where = place.string(),
                    .value = "already exists, and nothing is overwritten",
                    .fix = "choose another name for the study, or move it away."});
  }
  errors.require(fs::is_directory(base::folder_of(file), ignored),
                 {.where = file.string(),
                  .value = fmt::format("there is no folder {}", base::folder_of(file).string()),
                  .fix = "make it, or correct the name."});
  errors.throw_if_any();
}

void write_new_study(const NewStudy& study, const fs::path& file) {
  check_new_places(file);
  const fs::path folder = sheet_folder_of(file);
  FolderToBe sheets(folder);
  for (const NewSheet& sheet : sheets_of(study)) {
    base::write_whole_file(sheets.path() / sheet.name, base::csv_row(sheet.columns));
  }
  base::check_can_write(file);
  sheets.put_in_place();
  base::write_whole_file(file, study_text(study, folder.filename().string()));
  sheets.keep();
}

}  // namespace repose::calibrate
