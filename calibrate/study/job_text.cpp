#include "calibrate/study/job_text.h"

#include <nlohmann/json.hpp>

namespace repose::calibrate {
namespace {

using Json = nlohmann::json;

Json json_of(const Job& job) {
  return {{"experiment", job.experiment}, {"values", job.values}, {"seed", job.seed}};
}

Job job_in(const Json& json) {
  return {
      .experiment = json.at("experiment"), .values = json.at("values"), .seed = json.at("seed")};
}

}  // namespace

std::string text_of(const Job& job) { return json_of(job).dump(); }

Job job_in(const std::string& text) { return job_in(Json::parse(text)); }

std::string text_of(const SimulatedJob& done) {
  return Json{{"job", json_of(done.run.job)},
              {"readings", done.run.readings},
              {"failure", done.run.failure},
              {"wall_s", done.wall_s}}
      .dump();
}

SimulatedJob simulated_job_in(const std::string& text) {
  const Json json = Json::parse(text);
  return {.run = {.job = job_in(json.at("job")),
                  .readings = json.at("readings"),
                  .failure = json.at("failure")},
          .wall_s = json.at("wall_s")};
}

}  // namespace repose::calibrate
