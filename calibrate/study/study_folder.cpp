#include "calibrate/study/study_folder.h"

#include <system_error>

#include "base/input_error.h"
#include "base/whole_file.h"
#include "calibrate/experiment/run_folder.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;

bool has_notes(const fs::path& folder) {
  try {
    return read_study_notes(folder).has_value();
  } catch (const base::InputError&) {
    return false;
  }
}

bool is_copy(const fs::path& file, const fs::path& study) {
  return file.filename() == kStudyCopy &&
         base::read_file_if_there(file) == base::read_file_if_there(study);
}

}  // namespace

std::vector<std::string> foreign_files(const fs::path& folder, const fs::path& study) {
  if (is_run_folder(folder) || has_notes(folder)) return {};
  std::vector<std::string> foreign;
  for (const char* name : {kStudyCopy, kClumpCopy, kNotesFile, kResultFile, kHeapFile}) {
    std::error_code ignored;
    const fs::path file = folder / name;
    if (fs::exists(fs::symlink_status(file, ignored)) && !is_copy(file, study)) {
      foreign.emplace_back(name);
    }
  }
  return foreign;
}

}  // namespace repose::calibrate
