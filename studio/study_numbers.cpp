#include <algorithm>
#include <filesystem>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/atomic_file.h"
#include "base/fingerprint.h"
#include "base/input_error.h"
#include "base/text.h"
#include "calibrate/statistics/table/table.h"
#include "dem/study/study_edit.h"
#include "studio/study_folder.h"

namespace repose::studio {
namespace {

namespace fs = std::filesystem;

/// Changes to a study's numbers, and their errors.
struct Numbers {
  std::vector<dem::NumberEdit> edits;
  Json faults = Json::array();
};

/// Whether a protocol or a free coefficient has the key.
bool has_key(const dem::Study& study, const std::string& table, const std::string& key) {
  const Json sought = sought_json(study);
  const auto is_sought = [&](const Json& one) {
    return one.at("name") == table && one.contains(key) && key != "name" && !one.at(key).is_null();
  };
  if (std::ranges::any_of(sought, is_sought)) return true;
  return std::ranges::any_of(study.experiments, [&](const auto& described) {
    const auto& [experiment, how] = described;
    if (fmt::format("experiment.{}", experiment->name) != table) return false;
    dem::Protocol protocol = how.protocol;
    return std::ranges::any_of(experiment->keys(protocol),
                               [&](const dem::ProtocolKey& one) { return one.name == key; });
  });
}

/// Accepts only numbers, and keys that the study has.
Numbers numbers_in(const Json& json, const dem::Study& study) {
  Numbers numbers;
  const auto tables = json.find("numbers");
  if (tables == json.end() || !tables->is_object()) {
    throw base::InputError({.value = "what was sent has no numbers"});
  }
  for (const auto& [table, keys] : tables->items()) {
    for (const auto& [key, text] : keys.items()) {
      const std::string full = fmt::format("{}.{}", table, key);
      if (!text.is_string() || !has_key(study, table, key)) {
        throw base::InputError({.where = base::printable(full), .value = "is no key of the study"});
      }
      const std::string typed = text.get<std::string>();
      const auto number = calibrate::number_of(typed);
      const bool is_empty = typed.find_first_not_of(' ') == std::string::npos;
      if (number || is_empty) {
        numbers.edits.push_back({table, key, is_empty ? "" : fmt::format("{}", *number)});
      } else {
        numbers.faults.push_back(
            {{"key", full}, {"text", fmt::format("{} is \"{}\". Rule: a number.", full, typed)}});
      }
    }
  }
  return numbers;
}

/// The key that an error concerns; null if none of them.
Json key_of(const base::Fault& fault, const std::vector<dem::NumberEdit>& edits) {
  const std::string text = fault.subject + ' ' + fault.value;
  for (const dem::NumberEdit& edit : edits) {
    const std::string full = fmt::format("{}.{}", edit.table, edit.key);
    const std::size_t at = text.find(full);
    if (at == std::string::npos) continue;
    const char next = at + full.size() < text.size() ? text[at + full.size()] : ' ';
    if (next == ' ') return full;
  }
  return nullptr;
}

/// A changed study before it is put in place: written beside it, where relative file names resolve.
struct Changed {
  explicit Changed(const fs::path& file) : part(base::part_of(file)) {}

  std::unique_ptr<base::TemporaryFile> part;
  std::string text;
  Json faults = Json::array();
};

Changed changed_study(const fs::path& file, const std::string& before, const Json& json) {
  Changed changed(file);
  const Numbers numbers = numbers_in(json, dem::read_study(file));
  changed.faults = numbers.faults;
  changed.text = dem::with_numbers(before, numbers.edits);
  changed.part->write(std::as_bytes(std::span(changed.text)));
  try {
    dem::read_study(changed.part->path());
  } catch (const base::InputError& error) {
    const std::string own = changed.part->path().string();
    for (const base::Fault& fault : error.faults()) {
      std::string text = base::with_names(fault.text());
      const std::size_t at = text.find(own);
      if (at != std::string::npos) text.replace(at, own.size(), file.filename().string());
      changed.faults.push_back({{"key", key_of(fault, numbers.edits)}, {"text", text}});
    }
  }
  return changed;
}

}  // namespace

Json StudyFolder::checked_numbers(const std::string& name, const Json& numbers) const {
  const fs::path file = path_of(name);
  return {{"faults", changed_study(file, base::read_whole_file(file), numbers).faults}};
}

Json StudyFolder::save_numbers(const std::string& name, const Json& numbers) {
  const fs::path file = path_of(name);
  const std::lock_guard lock(saving_);
  const std::string before = base::read_whole_file(file);
  require_version(numbers, before, name);
  const Changed changed = changed_study(file, before, numbers);
  // An unreadable study could no longer be shown or corrected here.
  if (changed.faults.empty()) base::put_in_place(*changed.part, file);
  return {{"faults", changed.faults}, {"saved", changed.faults.empty()}};
}

}  // namespace repose::studio
