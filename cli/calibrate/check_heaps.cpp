#include "cli/calibrate/check_heaps.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "calibrate/study/study_folder.h"
#include "dem/state/state_file.h"

namespace repose::cli {
namespace {

namespace fs = std::filesystem;

/// Only what repose wrote.
void remove_heap(const fs::path& file) {
  std::error_code ignored;
  if (dem::is_as_written(file)) fs::remove(file, ignored);
}

void remove_earlier_heaps(const fs::path& folder) {
  remove_heap(folder / calibrate::kHeapFile);
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(folder / calibrate::kHeapsFolder, error), end;
       !error && entry != end; entry.increment(error)) {
    files.push_back(entry->path());
  }
  for (const fs::path& file : files) remove_heap(file);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return;
  throw std::invalid_argument(fmt::format(
      "{}: cannot be created ({}). Fix: get permission to write there, or move away what "
      "has that name.",
      folder.string(), error.message()));
}

}  // namespace

void save_check_heaps(const CalibratePlan& plan, const calibrate::StudyContext& context,
                      const std::vector<calibrate::Run>& checks) {
  remove_earlier_heaps(plan.out_folder);
  bool is_first = true;
  for (const calibrate::Run& run : checks) {
    if (run.job.experiment != "heap" || !run.failure.empty()) continue;
    const auto copy_to = [&](const fs::path& name) {
      return context.folder.copy_state(context.simulator.spec(run.job), run.job.seed,
                                       name.string());
    };
    make_folder(plan.out_folder / calibrate::kHeapsFolder);
    const std::string name = fmt::format("heap_seed_{}.vtp", run.job.seed);
    if (!copy_to(fs::path(calibrate::kHeapsFolder) / name)) continue;
    if (is_first) copy_to(calibrate::kHeapFile);
    is_first = false;
  }
}

}  // namespace repose::cli
