#include "calibrate/study/run_folder.h"

#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/whole_file.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path file_of(const fs::path& runs, const std::string& key) { return runs / (key + ".json"); }

}  // namespace

RunFolder::RunFolder(fs::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  fs::create_directories(runs(), error);
  if (error) {
    throw std::invalid_argument(
        fmt::format("{}: the folder cannot be made ({}). Fix: choose a place you may write to.",
                    runs().string(), error.message()));
  }
  base::check_can_write(runs() / "run.json");
}

std::optional<Run> RunFolder::find(const StudySimulator& simulator, const Job& job) const {
  const auto text = base::read_file_if_there(file_of(runs(), simulator.key(job)));
  if (!text) return std::nullopt;
  const Json json = Json::parse(*text, nullptr, false);
  try {
    if (json.at("simulated") != Json::parse(simulator.description(job))) return std::nullopt;
    return Run{.job = job, .readings = json.at("readings"), .failure = json.at("failure")};
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

void RunFolder::keep(const StudySimulator& simulator, const SimulatedJob& done) const {
  const Job& job = done.run.job;
  const Json json{{"simulated", Json::parse(simulator.description(job))},
                  {"readings", done.run.readings},
                  {"failure", done.run.failure},
                  {"wall_s", done.wall_s}};
  base::write_whole_file(file_of(runs(), simulator.key(job)), json.dump(2) + '\n');
}

bool RunFolder::copy_state(const StudySimulator& simulator, const Job& job,
                           const std::string& name) const {
  std::error_code error;
  return fs::copy_file(runs() / (simulator.key(job) + ".vtp"), folder_ / name,
                       fs::copy_options::overwrite_existing, error);
}

}  // namespace repose::calibrate
