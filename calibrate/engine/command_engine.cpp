#include <algorithm>
#include <cmath>
#include <optional>
#include <regex>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <wordexp.h>

#include "base/atomic_file.h"
#include "base/fingerprint.h"
#include "base/input_error.h"
#include "base/text.h"
#include "calibrate/engine/engine.h"
#include "calibrate/runs/table_columns.h"

namespace repose::calibrate {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr int kSchema = 1;
constexpr std::uintmax_t kLargestReading_bytes = 1 << 20;

Json json_of(const dem::ConfigValue& value) {
  using Kind = dem::ConfigValue::Kind;
  switch (value.kind) {
    case Kind::text:
      return value.text;
    case Kind::integer:
      return value.integer;
    case Kind::number:
      return value.number;
    case Kind::boolean:
      return value.shown == "true";
    case Kind::time:
      return value.shown;
    case Kind::array: {
      Json items = Json::array();
      for (const dem::ConfigValue& item : value.items) items.push_back(json_of(item));
      return items;
    }
    case Kind::table: {
      Json items = Json::object();
      for (const dem::ConfigValue& item : value.items) items[item.name] = json_of(item);
      return items;
    }
  }
  return nullptr;
}

/// The words of a command as the shell splits them, with their quotes: at unquoted blanks and
/// operators (POSIX.1-2017, XCU 2.2 and 2.3).
std::vector<std::string> quoted_words_of(const std::string& command) {
  std::vector<std::string> words(1);
  char quote = 0;
  for (std::size_t k = 0; k < command.size(); ++k) {
    const char letter = command[k];
    if (letter == '\\' && quote != '\'' && k + 1 < command.size()) {
      words.back() += letter;
      words.back() += command[++k];
      continue;
    }
    if (quote == 0 && std::string_view(" \t\n;&|<>()").find(letter) != std::string_view::npos) {
      words.emplace_back();
      continue;
    }
    if (letter == quote) {
      quote = 0;
    } else if (quote == 0 && (letter == '\'' || letter == '"')) {
      quote = letter;
    }
    words.back() += letter;
  }
  return words;
}

/// Such a word as the shell expands it: variables and patterns expanded, quotes removed. Commands
/// in it are not run.
std::vector<std::string> expanded(const std::string& word) {
  wordexp_t found{};
  std::vector<std::string> words;
  if (::wordexp(word.c_str(), &found, WRDE_NOCMD) == 0) {
    words.assign(found.we_wordv, found.we_wordv + found.we_wordc);
    ::wordfree(&found);
  }
  return words;
}

/// Files in the study's folder that the command names, with fingerprints of their content: a
/// changed script makes different runs.
Json files_of(const std::string& command, const fs::path& folder) {
  Json files = Json::object();
  for (const std::string& quoted : quoted_words_of(command)) {
    for (const std::string& word : expanded(quoted)) {
      std::error_code ignored;
      if (word.empty() || !fs::is_regular_file(folder / word, ignored)) continue;
      try {
        files[word] = base::fingerprint({base::read_whole_file(folder / word)});
      } catch (const base::InputError&) {
        continue;  // unreadable; the command will report it if that matters
      }
    }
  }
  return files;
}

std::string text_of(const Json& json) {
  constexpr int kIndent = 2;
  return json.dump(kIndent, ' ', false, Json::error_handler_t::replace) + '\n';
}

/// Unambiguous: commas only separate cells, points never separate thousands.
std::string cell_of(double number) { return fmt::format("{}", number); }

class CommandEngine : public Engine {
 public:
  explicit CommandEngine(const TableStudy& study)
      : study_(study), file_(fs::absolute(study.file)), folder_(file_.parent_path()) {
    model_ = {{"command", study.engine->command},
              {"files", files_of(study.engine->command, folder_)},
              {"settings", json_of(study.engine->settings)}};
  }

  std::string identity() const override { return identity_of(model_); }

  std::string identity_in(const fs::path& folder) const override {
    const auto text = base::read_file_if_there(folder / kRunFile);
    if (!text) return {};
    const Json run = Json::parse(*text, nullptr, false);
    return run.is_object() && run.contains("engine") ? identity_of(run["engine"]) : "";
  }

  void prepare(const EngineRun& run, const fs::path& folder) const override {
    Json parameters = Json::object();
    for (std::size_t j = 0; j < run.values.size(); ++j) {
      parameters[study_.parameters[j].name] = run.values[j];
    }
    Json readings = Json::object();
    for (const auto* observables : {&study_.measured, &study_.held_out}) {
      for (const Observable& one : *observables) readings[one.name] = {{"unit", one.unit}};
    }
    const Json text = {{"schema", kSchema},
                       {"run", run.name},
                       {"seed", run.seed},
                       {"parameters", std::move(parameters)},
                       {"readings", std::move(readings)},
                       {"settings", model_["settings"]},
                       {"study", file_.string()},
                       {"study_folder", folder_.string()},
                       {"run_folder", fs::absolute(folder).string()},
                       {"engine", model_}};
    base::write_whole_file(folder / kRunFile, text_of(text));
  }

  base::ProcessStart start(const fs::path& folder) const override {
    // The folder is the command's last argument, whatever characters it contains.
    return {.words = {"sh", "-c", study_.engine->command + " \"$@\"", "sh",
                      fs::absolute(folder).string()},
            .folder = folder_,
            .output = {}};
  }

  EngineOutcome read_back(const fs::path& folder) const override {
    std::optional<std::string> text;
    try {
      text = base::read_file_if_there(folder / kReadingFile, kLargestReading_bytes);
    } catch (const base::InputError& error) {
      return {.readings = {}, .failure = error.what()};
    }
    if (!text) return failed("left no reading.json");
    std::string twice;
    const Json json = parsed(*text, twice);
    if (json.is_discarded()) return failed("its reading.json is no JSON" + slip_in(*text));
    if (!twice.empty()) {
      return failed(fmt::format("its reading.json has {} twice: leave one out", twice));
    }
    if (!json.is_object()) return failed("its reading.json is no object, as in {\"aor\": 27.3}");
    if (std::string why = failure_in(json); !why.empty()) return failed(std::move(why));
    EngineOutcome outcome;
    for (const auto& [name, value] : json.items()) {
      // The table gets these in other ways.
      if (name == "status" || name == "reason" || name == "run" || name == "seed") continue;
      if (std::string why = take(name, value, folder, outcome); !why.empty()) {
        return failed(std::move(why));
      }
    }
    for (const std::string& reading : readings_of(study_)) {
      if (!json.contains(reading)) return failed(missing_text(reading, json));
    }
    return outcome;
  }

 private:
  /// @param twice  a duplicate name in the object
  static Json parsed(const std::string& text, std::string& twice) {
    std::set<std::string> names;
    const auto note = [&](int depth, Json::parse_event_t event, const Json& key) {
      if (depth == 1 && event == Json::parse_event_t::key &&
          !names.insert(key.get<std::string>()).second) {
        twice = key.get<std::string>();
      }
      return true;
    };
    return Json::parse(text, note, false);
  }

  /// A common mistake that makes a text invalid JSON.
  static std::string slip_in(const std::string& text) {
    if (text.find("NaN") != std::string::npos) {
      return ", which has no NaN: write null, or \"failed\"";
    }
    static const std::regex kDecimalComma(":\\s*(-?[0-9]+),([0-9]+)");
    std::smatch found;
    if (!std::regex_search(text, found, kDecimalComma)) return {};
    return fmt::format(", whose numbers have a decimal point: write {}.{}", found[1].str(),
                       found[2].str());
  }

  static EngineOutcome failed(std::string why) {
    return {.readings = {}, .failure = std::move(why)};
  }

  static std::string identity_of(const Json& model) {
    return model.dump(-1, ' ', false, Json::error_handler_t::replace);
  }

  static std::string missing_text(const std::string& reading, const Json& json) {
    std::vector<std::string> names;
    for (const auto& [name, value] : json.items()) names.push_back(name);
    const std::string guess = base::closest_word(reading, names);
    return fmt::format("its reading.json has no {}{}: a number, a file's name or null", reading,
                       guess.empty() ? "" : fmt::format(" (but {})", guess));
  }

  /// A failure that the command itself reports for the run.
  static std::string failure_in(const Json& json) {
    if (!json.contains("status")) return {};
    const std::string status =
        json["status"].is_string() ? json["status"].get<std::string>() : json["status"].dump();
    const std::string small = in_small_letters(status);
    if (says_done(small)) return {};
    const bool has_reason = json.contains("reason") && json["reason"].is_string();
    const std::string reason = has_reason ? ": " + json["reason"].get<std::string>() : "";
    if (says_failed(small)) return status + reason;
    return fmt::format("its status is \"{}\", which is neither ok nor failed{}", status, reason);
  }

  /// @return  what is wrong with it
  std::string take(const std::string& name, const Json& value, const fs::path& folder,
                   EngineOutcome& outcome) const {
    const std::vector<std::string> readings = readings_of(study_);
    const bool is_asked_for = std::ranges::find(readings, name) != readings.end();
    if (std::ranges::find(study_.parameters, name, &Parameter::name) != study_.parameters.end()) {
      return fmt::format("its reading.json has {}, which is a parameter", name);
    }
    if (value.is_null()) return {};
    if (value.is_number()) {
      const auto number = value.get<double>();
      if (!std::isfinite(number)) return fmt::format("{} is not finite", name);
      outcome.readings.push_back({.column = name, .cell = cell_of(number)});
      return {};
    }
    // Text in other columns is ignored.
    if (!is_asked_for) return {};
    if (!value.is_string()) {
      return fmt::format("{} is {}: a number, a file's name or null is read", name,
                         value.dump().substr(0, 80));
    }
    const auto word = value.get<std::string>();
    if (says_failed(in_small_letters(word))) {
      outcome.readings.push_back({.column = name, .cell = word});
      return {};
    }
    if (std::string why = fault_of_file(name, word, folder); !why.empty()) return why;
    outcome.readings.push_back({.column = name, .cell = word, .is_file = true});
    return {};
  }

  /// @return  why a reading cannot be the file that it names
  std::string fault_of_file(const std::string& name, const std::string& word,
                            const fs::path& folder) const {
    if (const auto number = number_of(word)) {
      return fmt::format("{} is \"{}\", a number as text{}: write {}", name, word,
                         word.find(',') == std::string::npos ? "" : " with a decimal comma",
                         cell_of(*number));
    }
    const fs::path inside = fs::path(word).lexically_normal();
    if (inside.is_absolute() || (!inside.empty() && *inside.begin() == "..")) {
      return fmt::format("{} names {}, which is not in the run's folder: put a copy there", name,
                         word);
    }
    std::error_code ignored;
    if (word.empty() || !fs::is_regular_file(folder / word, ignored)) {
      return fmt::format("{} names {}, which is no file in the run's folder", name,
                         word.empty() ? "nothing" : word);
    }
    if (fs::file_size(folder / word, ignored) == 0) {
      return fmt::format("{} names {}, which is empty", name, word);
    }
    if (!study_.pictured.contains(name)) {
      return fmt::format(
          "{} names a file, {}, and is no angle: what is measured in pictures and particles is a "
          "heap's angle, unit = \"deg\" in the study",
          name, word);
    }
    return {};
  }

  const TableStudy& study_;
  fs::path file_;
  fs::path folder_;
  Json model_;
};

}  // namespace

std::unique_ptr<Engine> command_engine(const TableStudy& study) {
  return std::make_unique<CommandEngine>(study);
}

}  // namespace repose::calibrate
