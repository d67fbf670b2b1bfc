#include "calibrate/study/job_text.h"

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

}  // namespace repose::calibrate
