#include "calibrate/run/progress_file.h"

#include <system_error>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/input_error.h"

namespace repose::calibrate {
namespace {

constexpr std::chrono::seconds kEvery{1};
constexpr std::chrono::seconds kAfterFailure{10};
constexpr double kEnoughToTell = .01;  // of the work: less is not enough to predict a time

}  // namespace

ProgressFile::ProgressFile(std::filesystem::path file, std::vector<Parameter> parameters)
    : file_(std::move(file)), parameters_(std::move(parameters)) {}

void ProgressFile::report(const StudyProgress& progress) {
  progress_ = progress;
  work_.add(progress);
  if (!work_.is_new_stage() && Clock::now() < next_written_) return;
  write();
}

void ProgressFile::note(const std::string& text) {
  notes_.push_back(text);
  write();
}

void ProgressFile::write() {
  if (file_.empty()) return;
  using Json = nlohmann::ordered_json;
  const std::chrono::duration<double> spent = Clock::now() - start_;
  const double fraction = work_.fraction();
  Json json{{"stage", progress_.stage},    {"done", progress_.done},   {"of", progress_.of},
            {"fraction", fraction},        {"seconds", spent.count()}, {"seconds_left", nullptr},
            {"parameters", Json::array()}, {"rounds", Json::array()},  {"notes", notes_}};
  if (fraction >= kEnoughToTell) {
    json["seconds_left"] = spent.count() * (1 - fraction) / fraction;
  }
  for (const Parameter& parameter : parameters_) {
    json["parameters"].push_back(
        {{"name", parameter.name}, {"bounds", {parameter.min, parameter.max}}});
  }
  for (const RoundSummary& round : progress_.rounds) {
    Json intervals = Json::array();
    for (const Interval& interval : round.intervals) {
      intervals.push_back({interval.low, interval.high});
    }
    json["rounds"].push_back({{"round", round.round},
                              {"jobs", round.jobs},
                              {"values", round.values},
                              {"sd", round.sd},
                              {"intervals", intervals}});
  }
  try {
    base::write_whole_file(file_, json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n');
    next_written_ = Clock::now() + kEvery;
  } catch (const base::InputError&) {
    // If this matters, the study will report it, as its runs are larger.
    next_written_ = Clock::now() + kAfterFailure;
  }
}

}  // namespace repose::calibrate
