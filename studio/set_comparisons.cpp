#include "studio/set_comparisons.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/units.h"
#include "calibrate/compared/compared_json.h"
#include "calibrate/measured/measured_command.h"
#include "studio/told_json.h"
#include "vision/hints/hint_file.h"

namespace repose::studio {

namespace fs = std::filesystem;

namespace {

using calibrate::HeapSource;

/// The heaps in a folder; std::nullopt if there are none.
std::optional<HeapSource> heaps_in(const fs::path& folder) {
  std::vector<std::string> errors;
  HeapSource source = calibrate::heap_sources({folder.string(), folder.string()}, errors).front();
  if (!errors.empty()) return std::nullopt;
  return source;
}

std::vector<fs::path> folders_in(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code ignored;
    const bool is_hidden = entry->path().filename().string().starts_with('.');
    if (!is_hidden && entry->is_directory(ignored)) found.push_back(entry->path());
  }
  std::ranges::sort(found);
  return found;
}

double margin_of(const Json& asked) {
  const vision::CompareOptions usual;
  if (!asked.contains("margin_deg")) return usual.margin_rad;
  const Json& margin = asked.at("margin_deg");
  if (margin.is_number()) return margin.get<double>() * kDegree;
  throw base::InputError(
      {.where = "margin_deg", .value = "is " + margin.dump(), .rule = "a number of degrees"});
}

/// A command that copies the chosen files and their hints into a folder for the set.
std::string copying(const HeapSource& source) {
  std::string command = fmt::format("mkdir -p {0} && cp", source.name);
  for (const fs::path& file : source.files) {
    std::error_code ignored;
    command += ' ' + base::shell_word(file.string());
    const fs::path hints = vision::hint_file_of(file);
    if (fs::exists(hints, ignored)) command += ' ' + base::shell_word(hints.string());
  }
  return command + ' ' + source.name + " && ";
}

std::string command_of(const std::array<HeapSource, 2>& sources, double margin_rad) {
  std::string before, command = "repose compare";
  for (const HeapSource& source : sources) {
    const bool is_chosen = !fs::path(source.name).has_parent_path();
    if (is_chosen) before += copying(source);
    command += ' ' + base::shell_word(source.name);
  }
  if (margin_rad != vision::CompareOptions().margin_rad) {
    command += fmt::format(" --margin-deg {:g}", to_degrees(margin_rad));
  }
  return before + command + " --overlay sets.png";
}

}  // namespace

Json SetComparisons::folders() const {
  Json folders = Json::array();
  for (const fs::path& folder : folders_in(pictures_.folder())) {
    const auto source = heaps_in(folder);
    if (!source) continue;
    folders.push_back({{"folder", folder.filename().string()},
                       {"kind", name_of(source->kind)},
                       {"heaps", source->files.size()}});
  }
  return {{"folders", folders}, {"margin_deg", to_degrees(vision::CompareOptions().margin_rad)}};
}

HeapSource SetComparisons::source_of(const Json& asked, const char* set) const {
  const Json* one = asked.is_object() && asked.contains(set) ? &asked.at(set) : nullptr;
  if (one && one->is_object() && one->contains("folder") && one->at("folder").is_string()) {
    const auto name = one->at("folder").get<std::string>();
    for (const fs::path& folder : folders_in(pictures_.folder())) {
      if (folder.filename().string() != name) continue;
      if (auto source = heaps_in(folder)) return *std::move(source);
    }
    throw base::InputError({.where = base::printable(name),
                            .value = "there is no such folder with heaps in it",
                            .fix = "load the page again."});
  }
  HeapSource source{.name = set, .files = {}, .is_file = false};
  const bool has_files = one && one->is_object() && one->contains("files") &&
                         one->at("files").is_array() && !one->at("files").empty();
  for (const Json& file : has_files ? one->at("files") : Json::array()) {
    source.files.push_back(pictures_.path_of(file.is_string() ? file.get<std::string>() : ""));
  }
  if (source.files.empty()) {
    throw base::InputError({.where = fmt::format("the {} set", set),
                            .value = "nothing is in it",
                            .fix = "tick pictures for it in the table, or choose a folder."});
  }
  source.kind = calibrate::kind_of_heap(source.files.front());
  for (const fs::path& file : source.files) {
    if (calibrate::kind_of_heap(file) == source.kind) continue;
    throw base::InputError({.where = file.filename().string(),
                            .value = "it is of another kind than the set's first",
                            .rule = "pictures and films, scans, or particles in one set",
                            .fix = "leave it out."});
  }
  return source;
}

Json SetComparisons::compare(const Json& asked) {
  const std::array<HeapSource, 2> sources{source_of(asked, "first"), source_of(asked, "second")};
  calibrate::SetsPlan plan{.sources = sources};
  plan.comparing.margin_rad = margin_of(asked);
  if (auto problems = plan.comparing.problems(); !problems.empty()) {
    throw base::InputError(std::move(problems));
  }
  auto kept = std::make_shared<Kept>();
  kept->compared = calibrate::compare_sets_of(std::move(plan), {});
  const calibrate::ComparedSets& compared = kept->compared;
  if (!compared.errors.empty()) {
    throw base::InputError({.value = fmt::format("{}", fmt::join(compared.errors, "\n"))});
  }
  constexpr std::size_t kMost = 4;
  const std::lock_guard lock(mutex_);
  kept->number = ++last_number_;
  kept_.push_front(kept);
  if (kept_.size() > kMost) kept_.pop_back();
  return {{"number", kept->number},
          {"comparison", Json::parse(calibrate::sets_json(compared))},
          {"has_figure", compared.has_figure()},
          {"notes", compared.notes},
          {"command", command_of(sources, compared.plan.comparing.margin_rad)}};
}

std::shared_ptr<const SetComparisons::Kept> SetComparisons::kept(int number) const {
  const std::lock_guard lock(mutex_);
  for (const auto& kept : kept_) {
    if (kept->number == number) return kept;
  }
  throw base::InputError({.where = "comparison",
                          .value = "it is not kept any more",
                          .fix = "compare the sets again."});
}

PictureFolder::Bytes SetComparisons::figure(int number, int width_px) const {
  const auto shown = kept(number);
  if (!shown->compared.has_figure()) {
    throw base::InputError({.where = "comparison", .value = "there is nothing to draw"});
  }
  return vision::png_of(calibrate::figure_of(shown->compared, width_px));
}

std::string SetComparisons::json(int number) const {
  return calibrate::sets_json(kept(number)->compared);
}

}  // namespace repose::studio
