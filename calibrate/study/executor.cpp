#include "calibrate/study/executor.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <mutex>
#include <string_view>

#include <nlohmann/json.hpp>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace repose::calibrate {
namespace {

using PlainJson = nlohmann::json;

PlainJson json_of(const Job& job) {
  return {{"experiment", job.experiment},
          {"values", job.values},
          {"seed", job.seed},
          {"stiffness", job.inputs.stiffness},
          {"spheres", job.inputs.spheres},
          {"step", {job.inputs.step.input, job.inputs.step.change, job.inputs.step.work}},
          {"size", job.inputs.size}};
}

Job job_in(const PlainJson& json) {
  return {.experiment = json.at("experiment"),
          .values = json.at("values"),
          .seed = json.at("seed"),
          .inputs = {.stiffness = json.at("stiffness"),
                     .spheres = json.at("spheres"),
                     .step = {.input = json.at("step").at(0),
                              .change = json.at("step").at(1),
                              .work = json.at("step").at(2)},
                     .size = json.at("size")}};
}

}  // namespace

void ThreadExecutor::run(const std::vector<Job>& jobs, const JobDone& done,
                         const std::atomic<bool>& is_interrupted) {
  std::atomic<std::size_t> next{0};
  std::atomic<bool> is_broken_off{false};
  std::mutex telling;
  const auto work = [&] {
    for (std::size_t k = next++; k < jobs.size() && !is_interrupted && !is_broken_off; k = next++) {
      const RunResult result = simulator_.simulate(jobs[k], is_interrupted);
      const std::scoped_lock lock(telling);
      done(k, result);
    }
  };
  const auto guarded = [&](int) {
    try {
      work();
    } catch (const dem::Interrupted&) {
      return;
    } catch (...) {
      is_broken_off = true;
      throw;
    }
  };
  const int workers = std::min(threads_, static_cast<int>(jobs.size()));
  tbb::task_arena arena(std::max(1, workers));
  // One task per worker, each taking jobs in order.
  arena.execute([&] { tbb::parallel_for(0, workers, 1, guarded, tbb::simple_partitioner()); });
}

bool is_launched_as_rank() {
  // Open MPI; MPICH and Intel MPI; Slurm, whose srun sets the last for every step.
  constexpr std::array kSizes = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"};
  for (const char* name : kSizes) {
    const char* text = std::getenv(name);
    if (text == nullptr) continue;
    const std::string_view size = text;
    int ranks = 0;
    std::from_chars(size.data(), size.data() + size.size(), ranks);
    if (ranks > 1) return true;
  }
  return false;
}

std::string text_of(const Job& job) { return json_of(job).dump(); }

Job job_in(const std::string& text) { return job_in(PlainJson::parse(text)); }

}  // namespace repose::calibrate
