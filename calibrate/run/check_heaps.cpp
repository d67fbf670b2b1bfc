#include "calibrate/run/check_heaps.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <system_error>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "calibrate/experiment/run_store.h"
#include "calibrate/study/study_record.h"
#include "dem/experiment/experiment_table.h"
#include "dem/state/state_file.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;

/// Removes it only if repose wrote it.
void remove_heap(const fs::path& file) {
  std::error_code ignored;
  if (dem::is_as_written(file)) fs::remove(file, ignored);
}

void remove_earlier_heaps(const fs::path& folder) {
  remove_heap(folder / kHeapFile);
  std::error_code error;
  std::vector<fs::path> files;
  for (fs::directory_iterator entry(folder / kHeapsFolder, error), end; !error && entry != end;
       entry.increment(error)) {
    files.push_back(entry->path());
  }
  for (const fs::path& file : files) remove_heap(file);
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return;
  base::refuse(folder, fmt::format("cannot be created ({})", error.message()),
               "get permission to write there, or move away what has that name.");
}

}  // namespace

std::size_t most_typical(const std::vector<double>& values) {
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / std::ssize(values);
  const auto nearest = std::min_element(values.begin(), values.end(), [mean](double a, double b) {
    return std::abs(a - mean) < std::abs(b - mean);
  });
  return static_cast<std::size_t>(nearest - values.begin());
}

void save_check_heaps(const fs::path& folder, const StudyContext& context,
                      const std::vector<Run>& checks) {
  remove_earlier_heaps(folder);
  const auto copy_to = [&](const Job& job, const fs::path& name) {
    return context.folder.copy_state(context.simulator.spec(job), job.seed, name.string());
  };
  std::vector<Job> saved;
  std::vector<double> angles;
  for (const Run& run : checks) {
    if (run.job.experiment != dem::pictured_experiment().name || !run.failure.empty()) continue;
    make_folder(folder / kHeapsFolder);
    const std::string name = fmt::format("heap_seed_{}.vtp", run.job.seed);
    if (!copy_to(run.job, fs::path(kHeapsFolder) / name)) continue;
    saved.push_back(run.job);
    angles.push_back(run.readings.at("value"));
  }
  if (!saved.empty()) copy_to(saved[most_typical(angles)], kHeapFile);
}

}  // namespace repose::calibrate
