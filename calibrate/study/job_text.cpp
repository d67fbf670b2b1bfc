#include "calibrate/study/job_text.h"

#include <stdexcept>

#include <nlohmann/json.hpp>

namespace repose::calibrate {
namespace {

using PlainJson = nlohmann::json;

PlainJson json_of(const Job& job) {
  return {{"experiment", job.experiment},
          {"values", job.values},
          {"seed", job.seed},
          {"stiffness", job.inputs.stiffness},
          {"spheres", job.inputs.spheres},
          {"step", {job.inputs.step.input, job.inputs.step.change, job.inputs.step.work}}};
}

Job job_in(const PlainJson& json) {
  return {.experiment = json.at("experiment"),
          .values = json.at("values"),
          .seed = json.at("seed"),
          .inputs = {.stiffness = json.at("stiffness"),
                     .spheres = json.at("spheres"),
                     .step = {.input = json.at("step").at(0),
                              .change = json.at("step").at(1),
                              .work = json.at("step").at(2)}}};
}

}  // namespace

std::string text_of(const Job& job) { return json_of(job).dump(); }

Job job_in(const std::string& text) { return job_in(PlainJson::parse(text)); }

std::string text_of(const SimulatedJob& done) {
  return PlainJson{{"job", json_of(done.job)}, {"run", run_text(done.run)}}.dump();
}

SimulatedJob simulated_job_in(const std::string& text) {
  const PlainJson json = PlainJson::parse(text);
  std::optional<SimulatedRun> run = run_in(json.at("run").get<std::string>());
  if (!run)
    throw std::runtime_error(
        "another process sent a run that cannot be read. Fix: start the same version everywhere.");
  return {.job = job_in(json.at("job")), .run = *std::move(run)};
}

}  // namespace repose::calibrate
