#include "calibrate/experiment/stored_run.h"

#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/fingerprint.h"
#include "base/input_error.h"

namespace repose::calibrate {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kSimulated = "simulated";
constexpr const char* kFingerprint = "fingerprint";

std::string fingerprint_of(const Json& json) { return base::fingerprint({json.dump()}); }

}  // namespace

std::string text_of(const StoredRun& stored) {
  Json json{{kSimulated, Json::parse(stored.description)}};
  json.update(Json::parse(run_text(stored.run)));
  json[kFingerprint] = fingerprint_of(json);
  constexpr int kIndent = 2;
  return json.dump(kIndent) + '\n';
}

StoredRun stored_run_in(const std::string& text) {
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) throw base::InputError({.value = "it is cut short or was changed"});
  const Json fingerprint = json.value(kFingerprint, Json());
  if (fingerprint.is_null()) {
    throw base::InputError({.value = "it has no fingerprint, as of an earlier version"});
  }
  json.erase(kFingerprint);
  std::optional<SimulatedRun> run;
  if (fingerprint == fingerprint_of(json)) run = run_in(text);
  if (!run || !json.contains(kSimulated)) {
    throw base::InputError({.value = "it was changed since it was written"});
  }
  return {.description = json.at(kSimulated).dump(), .run = *std::move(run)};
}

}  // namespace repose::calibrate
